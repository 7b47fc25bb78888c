// A camera that nobody carries: for looking at the land from outside while everything else stands still.
#pragma once

#include "apps/fly/CameraRig.h"

namespace teren {

/// Begins where another camera is and goes where the keys and the mouse send it, as fast as it is high.
class FreeCamera {
 public:
  static constexpr double kSlowest = 40.0;   // [m/s]
  static constexpr double kHighest = 60e3;   // [m] above or below zero
  static constexpr double kClearance = 2.0;  // [m] above known ground or water, at least

  explicit FreeCamera(const Viewpoint& begin) noexcept : view_(begin) {}

  /// Moves on for dt [s] (>= 0): forward is where it looks. At the world's end it stands still.
  void update(double dt, const CameraMoves& moves, const Ground& ground, double waterLevel);
  /// As CameraRig's.
  void look(double right, double up);
  void zoom(double steps);

  const Viewpoint& viewpoint() const noexcept { return view_; }

 private:
  Viewpoint view_;
};

}  // namespace teren
