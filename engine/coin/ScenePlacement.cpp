#include "coin/ScenePlacement.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace teren {

ScenePlacement::ScenePlacement(const SbVec3d& origin, double spacing) noexcept : spacing_(spacing) {
  assert(spacing > 0.0);
  const auto place = [spacing](double metres, std::int64_t& sample) {
    constexpr auto kLimit = static_cast<double>(kFarthest);
    const double nearest = std::round(metres / spacing);
    const double whole = nearest * spacing == metres ? nearest : std::floor(metres / spacing);
    sample = static_cast<std::int64_t>(std::clamp(whole, -kLimit, kLimit));
    return std::fabs(whole) > kLimit || whole * spacing == metres ? 0.0 : std::fma(-whole, spacing, metres);
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

SbVec3d ScenePlacement::position(const Anchor& anchor) const noexcept {
  return position(anchor.sample) + SbVec3d(0.0, 0.0, static_cast<double>(anchor.height));
}

Anchor ScenePlacement::anchorNear(const SbVec3d& point, double step) const noexcept {
  assert(step > 0.0);
  std::int64_t cell = 1;
  while (static_cast<double>(2 * cell) * spacing_ <= step && cell < kFarthest) cell *= 2;
  // An eye beyond the world's width, or at no number, sees nothing: any anchor does.
  const auto nearest = [this, cell](double metres, double remainder, std::int64_t origin) {
    constexpr auto kLimit = static_cast<double>(kFarthest);
    const double away = (metres + remainder) / spacing_;
    const std::int64_t sample = origin + (std::fabs(away) < kLimit ? std::llround(away) : 0) + cell / 2;
    return sample - ((sample % cell) + cell) % cell;
  };
  const double up = std::round((point[2] + remainder_[2]) / step) * step;
  return {{nearest(point[0], remainder_[0], origin_.column), nearest(point[1], remainder_[1], origin_.row)},
          std::isfinite(up) ? static_cast<float>(up) : 0.0F};
}

SbBox3f ScenePlacement::box(const Mesh& mesh) const noexcept {
  const SbVec3d corner = position(Sample{mesh.originColumn, mesh.originRow});
  const double step = spacing_ * static_cast<double>(std::int64_t{1} << mesh.level);
  return {static_cast<float>(corner[0]),
          static_cast<float>(corner[1]),
          static_cast<float>(corner[2] + mesh.minHeight),
          static_cast<float>(corner[0] + step * mesh.columns),
          static_cast<float>(corner[1] + step * mesh.rows),
          static_cast<float>(corner[2] + mesh.maxHeight)};
}

}  // namespace teren
