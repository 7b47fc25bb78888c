// Returns no description.
#include "Broken.h"

TEREN_BROKEN_ENTRY {
  return nullptr;
}
