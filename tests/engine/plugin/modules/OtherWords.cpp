// Built for another interface: two words differ, one is missing, one is unknown to the engine.
#include "Broken.h"

TEREN_BROKEN_ENTRY {
  static std::array words = std::to_array(teren::kAbiWords);
  words[0].value = 42;
  words[2].value = 4;
  words[words.size() - 1] = {"phase of the moon", 3};
  static teren::PluginDescription description = broken::flatDescription("other-words");
  description.words = words.data();
  // What comes after the words must not be read: another interface may have anything there.
  description.id = nullptr;
  description.parameters = nullptr;
  return &description;
}
