// Its id has capital letters and a space.
#include "Broken.h"

TEREN_BROKEN_ENTRY {
  static const teren::PluginDescription description = broken::flatDescription("Bad Id");
  return &description;
}
