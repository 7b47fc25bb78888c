// Operations on rectangles of heights: copying and statistics.
#pragma once

#include "teren/HeightMap.h"

namespace teren {

/// Copies `source` onto `target`, which has the same columns and rows (assert) and does not overlap it.
void copyHeights(ConstHeightView source, HeightView target) noexcept;

/// Statistics of a rectangle, in metres; all zero for an empty one. Mean and standard deviation are summed in
/// double, row by row (two passes), so they do not depend on the processor; with sides up to 4096 their
/// errors stay below 1e-12 times the largest size of a height. Heights must be finite.
struct HeightStatistics {
  double min = 0.0, max = 0.0, mean = 0.0, deviation = 0.0;
};
HeightStatistics statistics(ConstHeightView heights) noexcept;

}  // namespace teren
