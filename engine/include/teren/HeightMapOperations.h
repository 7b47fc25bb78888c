// Operations on rectangles of heights: copying, arithmetic and statistics.
//
// A rectangle is a view. The two of one operation have the same columns and rows: other sizes are refused
// (assert), nothing is clipped silently; `matchedParts` clips beforehand where a rectangle sticks out. Source
// and target may lie in one map and overlap in any way: the result is as if the source had been read first.
// (Overlapping views of different strides are refused, assert.) Empty rectangles are left alone. All cost
// O(samples) and allocate nothing: copying, adding and the like as much as moving the memory, what is
// weighted in double about three times that, statistics, which wait for one sum after the other, twelve times
// (tests/bench, HeightMaps). Any thread may call them; what one writes, no other may touch.
//
// Heights may be anything a float can be: where an operand is NaN the result is NaN, minHeights and
// maxHeights included, and what is too large for a float becomes infinite. All else is as exact as a float
// can hold:
#pragma once

#include <cstddef>
#include <span>

#include "teren/HeightMap.h"

namespace teren {

/// copyHeights, minHeights and maxHeights are exact. Every other result r of finite heights lies within
///   kHeightRounding |r| + kTermRounding (sum over its terms of |weight * height|) + kSmallestHeight
/// of exact arithmetic; a term's weight is 1, `factor`, t, 1 - t ... as the formula of the operation says.
inline constexpr double kHeightRounding = 0x1p-24;   ///< half a unit in a float's last place
inline constexpr double kTermRounding = 0x1p-49;     ///< up to kMostTerms terms, weighted in double
inline constexpr double kSmallestHeight = 0x1p-149;  ///< below 2^-126 a float has fewer digits
inline constexpr std::size_t kMostTerms = 8;

/// A rectangle of a map by its south-west sample and size in samples. It may lie partly or wholly outside the
/// map; a negative size is an empty rectangle.
struct HeightRectangle {
  int column = 0, row = 0;
  int columns = 0, rows = 0;
};

/// Parts of two maps, of equal size.
struct MatchedParts {
  ConstHeightView source;
  HeightView target;
};

/// Clips a pair of rectangles: what remains of `from` in `source` when its south-west sample is laid on
/// sample (column, row) of `target` and all that lies outside either map is cut off; both empty where nothing
/// remains. Any numbers are allowed.
MatchedParts matchedParts(ConstHeightView source, const HeightRectangle& from, HeightView target, int column,
                          int row) noexcept;
/// The same for the whole of `source`.
MatchedParts matchedParts(ConstHeightView source, HeightView target, int column, int row) noexcept;

void copyHeights(ConstHeightView source, HeightView target) noexcept;      ///< target = source
void addHeights(ConstHeightView source, HeightView target) noexcept;       ///< target = target + source
void subtractHeights(ConstHeightView source, HeightView target) noexcept;  ///< target = target - source
void multiplyHeights(ConstHeightView source, HeightView target) noexcept;  ///< target = target * source
void minHeights(ConstHeightView source, HeightView target) noexcept;       ///< the lower of the two
void maxHeights(ConstHeightView source, HeightView target) noexcept;       ///< the higher of the two
/// target = (1 - t) * target + t * source: exactly the target at t = 0 and the source at t = 1. For t in
/// [0, 1] it lies between both, and where they are equal it is exactly that height; beyond, it extrapolates.
void lerpHeights(ConstHeightView source, double t, HeightView target) noexcept;

void fillHeights(HeightView target, float height) noexcept;    ///< target = height
void shiftHeights(HeightView target, double metres) noexcept;  ///< target = target + metres
void scaleHeights(HeightView target, double factor) noexcept;  ///< target = factor * target

/// One term of a weighted sum.
struct WeightedHeights {
  ConstHeightView heights;
  double weight = 1.0;
};

/// target = sum of weight * heights, added in the order of the terms; at most kMostTerms (assert), 0 without
/// any. The target may be one of the terms; a term that overlaps it otherwise is refused (assert).
void weightedSum(std::span<const WeightedHeights> terms, HeightView target) noexcept;

/// Statistics of a rectangle, in metres; all zero for an empty one. Mean and standard deviation are summed in
/// double, row by row (two passes), so they do not depend on the processor; with sides up to 4096 they lie
/// within kStatisticsError times the largest size of a height. All four are NaN where any height is NaN;
/// where one is infinite, min and max are right and mean and deviation are not finite.
struct HeightStatistics {
  double min = 0.0, max = 0.0, mean = 0.0, deviation = 0.0;
};
inline constexpr double kStatisticsError = 1e-12;
HeightStatistics statistics(ConstHeightView heights) noexcept;

}  // namespace teren
