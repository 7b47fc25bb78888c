// Throws where a description is expected.
#include <stdexcept>

#include "Broken.h"

TEREN_BROKEN_ENTRY {
  throw std::runtime_error("the entry point\nis unwell");
}
