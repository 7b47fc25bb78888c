// Has no version.
#include "Broken.h"

TEREN_BROKEN_ENTRY {
  static teren::PluginDescription description = broken::flatDescription("null-texts");
  description.version = nullptr;
  return &description;
}
