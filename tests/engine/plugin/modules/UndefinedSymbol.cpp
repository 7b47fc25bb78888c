// Needs a function that nobody has.
#include "Broken.h"

extern "C" int terenTestNobodyHasThis();

TEREN_BROKEN_ENTRY {
  static teren::PluginDescription description = broken::flatDescription("undefined-symbol");
  description.wordCount += static_cast<std::uint64_t>(terenTestNobodyHasThis());
  return &description;
}
