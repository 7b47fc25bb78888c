#include "apps/fly/FreeCamera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace teren {

void FreeCamera::update(double dt, const CameraMoves& moves, const Ground& ground, double waterLevel) {
  Pose& eye = view_.pose;
  const auto floor = [&] {
    const std::optional<double> height = ground.height(eye.position);
    return height ? std::max(*height, waterLevel) : waterLevel;
  };
  const double low = floor();
  const double way = dt * std::max(kSlowest, std::isfinite(low) ? eye.height - low : kSlowest);
  const double level = moves.forward * std::cos(eye.pitch);
  const double east = level * std::sin(eye.heading) + moves.right * std::cos(eye.heading);
  const double north = level * std::cos(eye.heading) - moves.right * std::sin(eye.heading);
  const Result<Position> next = eye.position.movedBy(way * east, way * north, ground.pitch());
  if (next) eye.position = *next;
  const double height = eye.height + way * (moves.up + moves.forward * std::sin(eye.pitch));
  eye.height = std::clamp(std::max(height, floor() + kClearance), -kHighest, kHighest);
  eye.roll *= std::exp(-4.0 * dt);
}

void FreeCamera::look(double right, double up) {
  Pose& eye = view_.pose;
  eye.heading = std::remainder(eye.heading + right, 2.0 * std::numbers::pi);
  eye.pitch = std::clamp(eye.pitch + up, -CameraRig::kMaxPitch, CameraRig::kMaxPitch);
}

void FreeCamera::zoom(double steps) {
  view_.fieldOfView = CameraRig::zoomed(view_.fieldOfView, steps);
}

}  // namespace teren
