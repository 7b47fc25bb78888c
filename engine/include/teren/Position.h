// Where a point of the world is, without ever losing precision: integer lattice indices plus an offset.
#pragma once

#include <cstdint>

#include "teren/Result.h"

namespace teren {

/// Patches are numbered from -kMaxPatch to kMaxPatch in both directions; beyond lies no world.
inline constexpr std::int64_t kMaxPatch = std::int64_t{1} << 52;

/// A point on the ground plane: patch (i, j) of the world's lattice, and how far east (u) and north (v) of
/// the patch's south-west corner it lies, in pitches. 0 <= u, v < 1 always; the grid's samples have u =
/// column / n, which is exact because n is a power of two.
struct Position {
  std::int64_t i = 0, j = 0;
  double u = 0.0, v = 0.0;

  /// Whether the rules above hold (false for NaN). fromMetres and movedBy give valid positions only; others
  /// may be asked of nothing but this, movedBy, x and y.
  bool valid() const noexcept;

  /// The point (x, y) [m]; exact but for the rounding of the offsets. Refuses NaN, infinity and points beyond
  /// kMaxPatch. `pitch` is the world's, > 0 and finite, here and below.
  static Result<Position> fromMetres(double x, double y, double pitch);

  /// The point (dx, dy) metres away. Refuses like fromMetres, and where this position is not valid.
  Result<Position> movedBy(double dx, double dy, double pitch) const;

  /// Metres east and north of the world's zero; loses precision far from it (for display).
  double x(double pitch) const noexcept { return (static_cast<double>(i) + u) * pitch; }
  double y(double pitch) const noexcept { return (static_cast<double>(j) + v) * pitch; }

  friend bool operator==(const Position&, const Position&) = default;
};

/// Metres east and north.
struct Offset {
  double east = 0.0, north = 0.0;
};

/// How far `to` lies from `from`; as precise as a double can hold the distance, wherever both are.
Offset offset(const Position& from, const Position& to, double pitch) noexcept;

}  // namespace teren
