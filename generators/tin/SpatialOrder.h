// An order of points in which neighbours follow each other, for inserting many of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "generators/tin/LatticePoint.h"

namespace teren {

/// The place of a point on a Hilbert curve of 2^16 x 2^16 cells over the square of side 2^bits from the
/// origin, 1 <= bits <= 29; points must lie in it.
std::uint32_t hilbertPlace(LatticePoint p, int bits) noexcept;

/// The indices of the points along that curve; points of one cell keep their order. Radix sort: O(n).
std::vector<std::uint32_t> hilbertOrder(std::span<const LatticePoint> points);

}  // namespace teren
