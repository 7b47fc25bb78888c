#include "coin/ScenePlacement.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace teren {

ScenePlacement::ScenePlacement(const SbVec3d& origin, double spacing) noexcept : spacing_(spacing) {
  assert(spacing > 0.0);
  const auto place = [spacing](double metres, std::int64_t& sample) {
    constexpr auto kLimit = static_cast<double>(kFarthest);
    const double whole = std::floor(metres / spacing);
    sample = static_cast<std::int64_t>(std::clamp(whole, -kLimit, kLimit));
    return std::fabs(whole) > kLimit ? 0.0 : std::fma(-whole, spacing, metres);
  };
  const double east = place(origin[0], origin_.column);
  const double north = place(origin[1], origin_.row);
  remainder_.setValue(east, north, origin[2]);
}

SbVec3d ScenePlacement::position(const Sample& sample) const noexcept {
  const auto east = static_cast<double>(sample.column - origin_.column);
  const auto north = static_cast<double>(sample.row - origin_.row);
  return {east * spacing_ - remainder_[0], north * spacing_ - remainder_[1], -remainder_[2]};
}

// An eye beyond the world's width, or at no number, sees nothing: any reference does. Samples lie within
// 2^61.
constexpr double kFarthest = 0x1p61;

Sample ScenePlacement::referenceNear(const SbVec3f& point) const noexcept {
  const auto nearest = [this](double metres, double remainder, std::int64_t origin) {
    const double away = (metres + remainder) / spacing_;
    const std::int64_t sample = origin + (std::fabs(away) < kFarthest ? std::llround(away) : 0);
    const std::int64_t shifted = sample + kReferenceStep / 2;
    return shifted - ((shifted % kReferenceStep) + kReferenceStep) % kReferenceStep;
  };
  return {nearest(point[0], remainder_[0], origin_.column), nearest(point[1], remainder_[1], origin_.row)};
}

SbBox3f ScenePlacement::box(const Mesh& mesh) const noexcept {
  const SbVec3d corner = position({mesh.originColumn, mesh.originRow});
  const double step = spacing_ * static_cast<double>(std::int64_t{1} << mesh.level);
  return {static_cast<float>(corner[0]),
          static_cast<float>(corner[1]),
          static_cast<float>(corner[2] + mesh.minHeight),
          static_cast<float>(corner[0] + step * mesh.columns),
          static_cast<float>(corner[1] + step * mesh.rows),
          static_cast<float>(corner[2] + mesh.maxHeight)};
}

}  // namespace teren
