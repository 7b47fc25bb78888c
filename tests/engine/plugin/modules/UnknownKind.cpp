// Is of a kind that nobody knows.
#include "Broken.h"

TEREN_BROKEN_ENTRY {
  static teren::PluginDescription description = broken::flatDescription("unknown-kind");
  description.kind = teren::PluginKind{4};
  return &description;
}
