// Differs from a good module in one word only.
#include "Broken.h"

TEREN_BROKEN_ENTRY {
  static std::array words = std::to_array(teren::kAbiWords);
  words[0].value += 1;
  static teren::PluginDescription description = broken::flatDescription("one-other-word");
  description.words = words.data();
  return &description;
}
