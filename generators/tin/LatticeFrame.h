// Where a lattice lies in the world: turns metres into steps and back.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "generators/tin/LatticePoint.h"

namespace teren {

/// A box of lattice points: its south-west corner, its step and its sides. Meshes of one world use one step
/// (level-0 spacing / 1024) and corners that are patch corners, so points of two meshes differ by whole
/// steps.
struct LatticeFrame {
  double x = 0.0;                      // [m] of the south-west corner
  double y = 0.0;                      // [m]
  double step = 1.0 / 1024;            // [m], > 0; a power of two loses nothing on the way back
  std::int32_t width = kLatticeSide;   // [steps], 1 ... kLatticeSide
  std::int32_t height = kLatticeSide;  // [steps], 1 ... kLatticeSide

  friend bool operator==(const LatticeFrame&, const LatticeFrame&) = default;

  bool contains(LatticePoint p) const noexcept {
    return 0 <= p.x && p.x <= width && 0 <= p.y && p.y <= height;
  }
  bool isOnBorder(LatticePoint p) const noexcept {
    return p.x == 0 || p.y == 0 || p.x == width || p.y == height;
  }
  bool isCorner(LatticePoint p) const noexcept {
    return (p.x == 0 || p.x == width) && (p.y == 0 || p.y == height);
  }

  /// The lattice point nearest to a place [m], at most half a step away in each direction; nothing where the
  /// place is outside the box or not a number.
  std::optional<LatticePoint> snap(double placeX, double placeY) const noexcept {
    const double u = (placeX - x) / step;
    const double v = (placeY - y) / step;
    if (!(0.0 <= u && u <= width && 0.0 <= v && v <= height)) return std::nullopt;
    return LatticePoint{static_cast<std::int32_t>(std::floor(u + 0.5)),
                        static_cast<std::int32_t>(std::floor(v + 0.5))};
  }
  double placeX(LatticePoint p) const noexcept { return x + p.x * step; }  // [m]
  double placeY(LatticePoint p) const noexcept { return y + p.y * step; }  // [m]
};

}  // namespace teren
