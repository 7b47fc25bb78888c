#include "stream/View.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>
#include <unordered_map>

namespace teren {

namespace {

/// Inside the world, so that neighbours of a node never leave it either.
bool insideWorld(const NodeKey& key) noexcept {
  const std::int64_t most = (kMaxPatch >> key.level) - 1;
  return key.i >= -most && key.i < most && key.j >= -most && key.j < most;
}

/// The level-0 nodes of the square with sides of 2 `margin` around a place, its own first.
std::vector<NodeKey> nodesWithin(const Position& place, double margin, double pitch) {
  const NodeKey own = nodeAt(place, 0);
  std::vector<NodeKey> nodes;
  if (insideWorld(own)) nodes.push_back(own);
  const auto patches = [pitch](double offset) {
    return static_cast<std::int64_t>(std::floor(offset / pitch));
  };
  const double east = place.u * pitch, north = place.v * pitch;
  for (std::int64_t dj = patches(north - margin); dj <= patches(north + margin); ++dj) {
    for (std::int64_t di = patches(east - margin); di <= patches(east + margin); ++di) {
      const NodeKey key{0, own.i + di, own.j + dj};
      if (key != own && insideWorld(key)) nodes.push_back(key);
    }
  }
  return nodes;
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

GroundNodes groundNodes(const Motion& motion, const World& world) {
  const double pitch = world.pitch(), margin = std::max(kGroundMargin, motion.reach);
  const double speed = std::sqrt(motion.east * motion.east + motion.north * motion.north);
  constexpr double kStepsAPitch = 2.0;
  const double stepSeconds = speed > 0.0 ? pitch / (kStepsAPitch * speed) : kGroundSeconds;
  constexpr double kMostSteps = kStepsAPitch * kGroundPitches;
  const double ahead = speed > 0.0 && std::isfinite(speed) ? std::ceil(kGroundSeconds / stepSeconds) : 0.0;
  const double steps = std::min(ahead, kMostSteps);
  std::vector<NodeKey> nodes;
  std::unordered_map<NodeKey, double, NodeKeyHash> lastStep;
  for (double step = 0.0; step <= steps; step += 1.0) {
    const double seconds = std::min(step * stepSeconds, kGroundSeconds);
    const double east = step > 0.0 ? motion.east * seconds : 0.0;
    const double north = step > 0.0 ? motion.north * seconds : 0.0;
    const Result<Position> place = motion.position.movedBy(east, north, pitch);
    if (!place) break;  // beyond the world's end there is no ground
    for (const NodeKey& key : nodesWithin(*place, margin, pitch)) {
      if (lastStep.insert_or_assign(key, step).second) nodes.push_back(key);
    }
  }
  GroundNodes ground;
  for (const NodeKey& key : nodes) {
    const double last = lastStep.at(key);
    const bool isLeft = last < steps || ahead > steps;
    const bool passing = !std::isfinite(speed) || (isLeft && (last + 1.0) * stepSeconds < kGroundNotice);
    (passing ? ground.passing : ground.wanted).push_back(key);
  }
  return ground;
}

}  // namespace teren
