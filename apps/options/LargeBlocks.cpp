#include "apps/options/LargeBlocks.h"

#include <malloc.h>

namespace teren {

void keepLargeBlocksApart() noexcept {
  constexpr int kLarge = 16 << 10;  // [byte] a base map of 65 samples a side has 16.9 KB
  mallopt(M_MMAP_THRESHOLD, kLarge);
}

}  // namespace teren
