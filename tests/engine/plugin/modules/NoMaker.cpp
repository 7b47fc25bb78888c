// Says it is a filter, but can make only generators.
#include "Broken.h"

TEREN_BROKEN_ENTRY {
  static teren::PluginDescription description = broken::flatDescription("no-maker");
  description.kind = teren::PluginKind::filter;
  return &description;
}
