#include "stream/View.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>

namespace teren {

namespace {

/// Inside the world, so that neighbours of a node never leave it either.
bool insideWorld(const NodeKey& key) noexcept {
  const std::int64_t most = (kMaxPatch >> key.level) - 1;
  return key.i >= -most && key.i < most && key.j >= -most && key.j < most;
}

}  // namespace

std::vector<NodeKey> viewNodes(const Position& position, const ViewSettings& view, const World& world) {
  const NodeKey centre = nodeAt(position, view.level);
  const double side = world.pitch() * static_cast<double>(std::int64_t{1} << view.level);
  const Position corner{centre.i << view.level, centre.j << view.level, 0.0, 0.0};
  const Offset inside = offset(corner, position, world.pitch());
  std::vector<std::tuple<double, NodeKey>> ranked;
  for (int dj = -view.radius; dj <= view.radius; ++dj) {
    for (int di = -view.radius; di <= view.radius; ++di) {
      const NodeKey key = centre.neighbour(di, dj);
      if (!insideWorld(key)) continue;
      const double east = (di + 0.5) * side - inside.east, north = (dj + 0.5) * side - inside.north;
      ranked.emplace_back(east * east + north * north, key);
    }
  }
  std::sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) {
    const auto& [distanceA, keyA] = a;
    const auto& [distanceB, keyB] = b;
    return std::tie(distanceA, keyA.j, keyA.i) < std::tie(distanceB, keyB.j, keyB.i);
  });
  std::vector<NodeKey> nodes;
  nodes.reserve(ranked.size());
  for (const auto& [distance, key] : ranked) nodes.push_back(key);
  return nodes;
}

bool mayStay(const NodeKey& key, const NodeKey& centre, const ViewSettings& view, int margin) noexcept {
  const int most = view.radius + margin;
  return key.level == view.level && std::abs(key.i - centre.i) <= most && std::abs(key.j - centre.j) <= most;
}

std::vector<NodeKey> groundNodes(const Motion& motion, const World& world) {
  std::vector<NodeKey> nodes;
  const auto want = [&](double east, double north) {
    const Result<Position> place = motion.position.movedBy(east, north, world.pitch());
    if (!place) return;  // beyond the world's end there is no ground
    const NodeKey key = nodeAt(*place, 0);
    if (insideWorld(key) && std::find(nodes.begin(), nodes.end(), key) == nodes.end()) nodes.push_back(key);
  };
  const auto wantAround = [&](double east, double north) {
    want(east, north);
    for (const double x : {-kGroundMargin, kGroundMargin}) {
      for (const double y : {-kGroundMargin, kGroundMargin}) want(east + x, north + y);
    }
  };
  const double distance = std::hypot(motion.east, motion.north) * kGroundSeconds;
  if (!std::isfinite(distance)) return nodes;
  constexpr double kMostSteps = 64.0;
  const double steps = std::min(kMostSteps, std::ceil(2.0 * distance / world.pitch()));
  wantAround(0.0, 0.0);
  for (double step = 1.0; step <= steps; step += 1.0) {
    const double seconds = kGroundSeconds * step / steps;
    wantAround(motion.east * seconds, motion.north * seconds);
  }
  return nodes;
}

}  // namespace teren
