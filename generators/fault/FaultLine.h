// One fault: a random line across a base map's square, and the step by which its two sides move apart.
#pragma once

#include <cstdint>

namespace teren {

/// Fault formation measures the square of a base map in units, kFaultUnits from side to side, whatever the
/// number of samples. So a map with more samples shows the same landscape, finer, and every side test is
/// exact: a product of two differences stays below 2^41.
inline constexpr int kFaultUnitBits = 20;
inline constexpr std::int64_t kFaultUnits = std::int64_t{1} << kFaultUnitBits;

/// A line through two different points of the square, directed from a to b. The ground on its left moves by
/// `left`, all other ground (the line itself included) by -left.
struct FaultLine {
  std::int64_t ax = 0, ay = 0, bx = 1, by = 0;  ///< [units] 0 ... kFaultUnits - 1
  std::int32_t left = 0;

  /// By how much the ground moves at (x, y) [units, 0 ... kFaultUnits].
  constexpr std::int32_t move(std::int64_t x, std::int64_t y) const noexcept {
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0 ? left : -left;
  }
};

/// Draws the line of a fault whose sides move by `size` (> 0). Each end is the upper bits of one word (east
/// first); which side rises is a bit of its own, so that at every point of the square both are equally
/// likely and the mean is exactly 0. Two equal ends make no line: then both words are drawn again.
template <class Words>
constexpr FaultLine drawFaultLine(Words& words, std::int32_t size) noexcept {
  constexpr std::uint64_t mask = kFaultUnits - 1;
  constexpr int yShift = 64 - 2 * kFaultUnitBits;
  for (;;) {
    const std::uint64_t a = words.next();
    const std::uint64_t b = words.next();
    if (a >> yShift == b >> yShift) continue;
    return {.ax = static_cast<std::int64_t>(a >> (yShift + kFaultUnitBits)),
            .ay = static_cast<std::int64_t>((a >> yShift) & mask),
            .bx = static_cast<std::int64_t>(b >> (yShift + kFaultUnitBits)),
            .by = static_cast<std::int64_t>((b >> yShift) & mask),
            .left = (a & 1) != 0 ? size : -size};
  }
}

}  // namespace teren
