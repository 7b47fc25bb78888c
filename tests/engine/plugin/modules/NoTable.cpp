// Has no parameter table.
#include "Broken.h"

TEREN_BROKEN_ENTRY {
  static teren::PluginDescription description = broken::flatDescription("no-table");
  description.parameters = nullptr;
  return &description;
}
