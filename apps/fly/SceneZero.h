// The point of the world that the scene graph counts from: Open Inventor knows only floats, so it stays near
// the eye.
#pragma once

#include <cmath>

#include "teren/Position.h"

namespace teren {

/// A corner of the world's lattice that follows the eye by whole patches, so that what is added to it stays
/// exact.
class SceneZero {
 public:
  /// [m] The eye is never farther from the zero than this in x or y after follow().
  static constexpr double kFarthest = 2000.0;

  /// Moves the zero to the eye's patch when the eye has strayed too far; returns whether it moved.
  bool follow(const Position& eye, double pitch) noexcept {
    const Offset away = offset(zero_, eye, pitch);
    if (std::abs(away.east) <= kFarthest && std::abs(away.north) <= kFarthest) return false;
    zero_ = {eye.i, eye.j, 0.0, 0.0};
    return true;
  }

  const Position& position() const noexcept { return zero_; }

 private:
  Position zero_;
};

}  // namespace teren
