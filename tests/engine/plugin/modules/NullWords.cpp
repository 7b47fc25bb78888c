// Speaks of ABI words, but they lie nowhere.
#include "Broken.h"

TEREN_BROKEN_ENTRY {
  static teren::PluginDescription description = broken::flatDescription("null-words");
  description.words = nullptr;
  return &description;
}
