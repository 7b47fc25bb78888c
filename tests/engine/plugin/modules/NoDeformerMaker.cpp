// Says it is a deformer, but can make only generators.
#include "Broken.h"

TEREN_BROKEN_ENTRY {
  static teren::PluginDescription description = broken::flatDescription("no-deformer-maker");
  description.kind = teren::PluginKind::deformer;
  return &description;
}
