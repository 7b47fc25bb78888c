// The point of the world that the scene graph counts from: Open Inventor knows only floats, so it stays near
// the eye.
#pragma once

#include <cmath>

#include "teren/Position.h"

namespace teren {

/// A place of the world's lattice that follows the eye, so that what is added to it stays exact: a corner of
/// the eye's patch, or of the piece of it that the eye is in where patches are larger than kFarthest; and a
/// whole multiple of kFarthest in height. It depends on where the eye is alone, so the same flight elsewhere
/// has the same numbers.
class SceneZero {
 public:
  /// [m] The eye is never farther from the zero than this in any direction after follow(), at the world's end
  /// than a patch. A camera there is placed by floats to 2e-6 m.
  static constexpr double kFarthest = 64.0;

  /// Moves the zero to where an eye at this height [m] wants it; returns whether it moved.
  bool follow(const Position& eye, double height, double pitch) noexcept {
    double pieces = 1.0;
    while (pieces * kFarthest < pitch) pieces *= 2.0;
    const Position place{eye.i, eye.j, corner(eye.i, eye.u, pieces), corner(eye.j, eye.v, pieces)};
    const double up = std::round(height / kFarthest) * kFarthest;
    if (place == place_ && up == height_) return false;
    place_ = place;
    height_ = up;
    return true;
  }

  const Position& position() const noexcept { return place_; }
  double height() const noexcept { return height_; }  ///< [m]

 private:
  /// Where the piece begins, if a double can tell it from the patch's own corner.
  static double corner(std::int64_t patch, double inPatch, double pieces) noexcept {
    const double begin = std::floor(inPatch * pieces) / pieces;
    const auto whole = static_cast<double>(patch);
    return (whole + begin) - whole == begin ? begin : 0.0;
  }

  Position place_;
  double height_ = 0.0;
};

}  // namespace teren
