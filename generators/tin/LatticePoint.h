// Points on an integer lattice and the two questions a triangulation asks about them, always answered
// exactly.
#pragma once

#include <cstdint>

namespace teren {

/// A place in steps from the south-west corner of a box, 0 <= x, y <= kLatticeSide.
struct LatticePoint {
  std::int32_t x = 0;  // [steps] to the east
  std::int32_t y = 0;  // [steps] to the north

  friend constexpr bool operator==(const LatticePoint&, const LatticePoint&) = default;
};

/// The longest side of a box [steps]. With 28 bits a coordinate the orientation fits into 64 bits and the
/// in-circle determinant into 128, whatever the points.
inline constexpr std::int32_t kLatticeSide = std::int32_t{1} << 28;

/// A signed integer of 128 bits.
__extension__ typedef __int128 WideInteger;

/// Twice the signed area of the triangle a, b, c [steps^2]: positive where c lies to the left of the way from
/// a to b, 0 where the three are collinear. Exact: |result| <= 2^57.
constexpr std::int64_t orientation(LatticePoint a, LatticePoint b, LatticePoint c) noexcept {
  return static_cast<std::int64_t>(b.x - a.x) * (c.y - a.y) -
         static_cast<std::int64_t>(b.y - a.y) * (c.x - a.x);
}

/// The determinant whose sign says where d lies to the circle through a, b, c, which turn to the left:
/// positive inside, 0 on it, negative outside. Exact: every factor below is at most 2^57, the sum at most
/// 2^116.
constexpr WideInteger inCircleDeterminant(LatticePoint a, LatticePoint b, LatticePoint c,
                                          LatticePoint d) noexcept {
  const std::int64_t ax = a.x - d.x, ay = a.y - d.y;
  const std::int64_t bx = b.x - d.x, by = b.y - d.y;
  const std::int64_t cx = c.x - d.x, cy = c.y - d.y;
  return static_cast<WideInteger>(ax * ax + ay * ay) * (bx * cy - by * cx) +
         static_cast<WideInteger>(bx * bx + by * by) * (cx * ay - cy * ax) +
         static_cast<WideInteger>(cx * cx + cy * cy) * (ax * by - ay * bx);
}

/// True where d lies inside the circle, not on it.
constexpr bool inCircle(LatticePoint a, LatticePoint b, LatticePoint c, LatticePoint d) noexcept {
  return inCircleDeterminant(a, b, c, d) > 0;
}

/// The lattice point nearest to where the segments a b and c d cross (halves round to north and east). They
/// must cross in one point. Exact: the numerators are at most 2^87.
constexpr LatticePoint roundedCrossing(LatticePoint a, LatticePoint b, LatticePoint c,
                                       LatticePoint d) noexcept {
  WideInteger part = orientation(c, d, a);
  WideInteger whole = part - orientation(c, d, b);
  if (whole < 0) {
    part = -part;
    whole = -whole;
  }
  const auto along = [part, whole](std::int32_t from, std::int32_t to) {
    const WideInteger doubled = 2 * (from * whole + (to - from) * part) + whole;
    return static_cast<std::int32_t>(doubled / (2 * whole));  // no less than 0, so this rounds down
  };
  return {along(a.x, b.x), along(a.y, b.y)};
}

}  // namespace teren
