#include "apps/sandbox/SandPainter.h"

#include <array>

namespace teren {
namespace {

using Plane = std::array<float, 4>;

/// The six planes of the view; what is inside has a positive distance from each.
std::array<Plane, 6> planesOf(const SbMatrix& toClip) {
  std::array<Plane, 6> planes{};
  for (int side = 0; side < 6; ++side) {
    const float sign = side % 2 == 0 ? 1.0F : -1.0F;
    for (int row = 0; row < 4; ++row) {
      planes[static_cast<std::size_t>(side)][static_cast<std::size_t>(row)] =
          toClip[row][3] + sign * toClip[row][side / 2];
    }
  }
  return planes;
}

bool isOutside(const SandBounds& bounds, float step, const std::array<Plane, 6>& planes) {
  if (bounds.isEmpty()) return true;
  const float low[3] = {static_cast<float>(bounds.southWest.x) * step,
                        static_cast<float>(bounds.southWest.y) * step, bounds.low};
  const float high[3] = {static_cast<float>(bounds.northEast.x) * step,
                         static_cast<float>(bounds.northEast.y) * step, bounds.high};
  return std::any_of(planes.begin(), planes.end(), [&](const Plane& plane) {
    float distance = plane[3];  // of the corner that is farthest inside
    for (std::size_t axis = 0; axis < 3; ++axis) {
      distance += plane[axis] * (plane[axis] > 0.0F ? high[axis] : low[axis]);
    }
    return distance < 0.0F;
  });
}

}  // namespace

std::vector<PageRun> visibleRuns(const SandSnapshot& sand, const SbMatrix& toClip) {
  const std::array<Plane, 6> planes = planesOf(toClip);
  const auto step = static_cast<float>(sand.frame().step);
  std::vector<PageRun> runs;
  for (std::size_t page = 0; page < sand.trianglePages().size(); ++page) {
    if (isOutside(sand.bounds(page), step, planes)) continue;
    if (runs.empty() || runs.back().first + runs.back().count != page) runs.push_back({page, 0});
    ++runs.back().count;
  }
  return runs;
}

}  // namespace teren
