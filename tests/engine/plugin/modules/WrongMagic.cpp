// Something that happens to export the same name.
#include "Broken.h"

TEREN_BROKEN_ENTRY {
  static teren::PluginDescription description = broken::flatDescription("wrong-magic");
  description.magic = 7;
  description.words = nullptr;
  return &description;
}
