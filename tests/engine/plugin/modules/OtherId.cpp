// Its id is not what its file's name says.
#include "Broken.h"

TEREN_BROKEN_ENTRY {
  static const teren::PluginDescription description = broken::flatDescription("something-else");
  return &description;
}
