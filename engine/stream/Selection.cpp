#include "stream/Selection.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <tuple>

namespace teren {

namespace {

constexpr double kStaysSplit = 0.8;  // of the error at which a node is split
constexpr double kNearest = 0.1;     // [m] no eye is nearer to what it sees

bool insideWorld(const NodeKey& key) noexcept {
  const std::int64_t most = (kMaxPatch >> key.level) - 1;
  return key.i >= -most && key.i < most && key.j >= -most && key.j < most;
}

/// How far a coordinate lies from an interval.
double away(double low, double high) noexcept {
  return std::max({low, -high, 0.0});
}

}  // namespace

double pixelsPerMetre(const DetailSettings& detail) noexcept {
  return detail.lines / (2.0 * std::tan(0.5 * detail.fieldOfView));
}

int Selection::rootLevelFor(double distance, double pitch, int topLevel) noexcept {
  int level = 0;
  while (level < topLevel && pitch * std::exp2(level + 1) <= 0.5 * distance) ++level;
  return level;
}

void Selection::choose(std::span<const Viewer> viewers, double tolerance) {
  assert(tolerance >= 1.0);
  viewers_.assign(viewers.begin(), viewers.end());
  const int top = static_cast<int>(ground_.errors.size()) - 1;
  double farthest = 0.0;
  for (const Viewer& viewer : viewers_) farthest = std::max(farthest, viewer.detail.distance);
  rootLevel_ = std::max(rootLevel_, rootLevelFor(farthest, ground_.pitch, top));
  for (Splits& level : splits_) level.clear();
  splits_.resize(static_cast<std::size_t>(top) + 1);
  findRoots();
  for (const auto& [root, urgency] : roots_) split(root, tolerance);
  balance();
  nodes_.clear();
  leaves_ = 0;
  for (const auto& [root, urgency] : roots_) list(root, std::numeric_limits<double>::infinity());
  std::sort(nodes_.begin(), nodes_.end(), [](const SelectedNode& a, const SelectedNode& b) {
    return std::tuple(-a.urgency, -a.key.level, a.key.j, a.key.i) <
           std::tuple(-b.urgency, -b.key.level, b.key.j, b.key.i);
  });
}

void Selection::keep() {
  before_.clear();
  for (const Splits& level : splits_) before_.insert(level.begin(), level.end());
}

void Selection::findRoots() {
  roots_.clear();
  const double side = ground_.pitch * std::exp2(rootLevel_);
  for (const Viewer& viewer : viewers_) {
    const NodeKey centre = nodeAt(viewer.position, rootLevel_);
    const auto most = static_cast<std::int64_t>(std::ceil(viewer.detail.distance / side));
    for (std::int64_t dj = -most; dj <= most; ++dj) {
      for (std::int64_t di = -most; di <= most; ++di) {
        const NodeKey key{rootLevel_, centre.i + di, centre.j + dj};
        if (insideWorld(key) && distance(viewer, key) <= viewer.detail.distance) roots_.emplace(key, 0.0);
      }
    }
  }
}

// Across the ground only: what is far below is in sight too.
double Selection::distance(const Viewer& viewer, const NodeKey& key) const {
  const double side = ground_.pitch * std::exp2(key.level);
  const Position corner{key.i << key.level, key.j << key.level, 0.0, 0.0};
  const Offset low = offset(viewer.position, corner, ground_.pitch);
  const double east = away(low.east, low.east + side), north = away(low.north, low.north + side);
  return std::sqrt(east * east + north * north);
}

double Selection::seen(const NodeKey& key) const {
  double most = 0.0;
  for (const Viewer& viewer : viewers_) {
    const double across = distance(viewer, key);
    if (across > viewer.detail.distance) continue;
    const double up = away(viewer.height - ground_.high, viewer.height - ground_.low);
    const double pixels = ground_.errors[static_cast<std::size_t>(key.level)] *
                          pixelsPerMetre(viewer.detail) /
                          std::max(std::sqrt(across * across + up * up), kNearest);
    most = std::max(most, pixels / viewer.detail.pixelError);
  }
  return most;
}

void Selection::split(const NodeKey& key, double tolerance) {
  if (key.level == 0) return;
  const double error = seen(key);
  if (!(error > tolerance * (before_.contains(key) ? kStaysSplit : 1.0))) return;
  splits_[static_cast<std::size_t>(key.level)].emplace(key, error);
  for (int child = 0; child < 4; ++child) {
    split({key.level - 1, key.i * 2 + (child & 1), key.j * 2 + (child >> 1)}, tolerance);
  }
}

/// Where a node is split, all that touch it must be there or finer, so what is above them is split too, and
/// no less urgently.
void Selection::balance() {
  for (int level = 0; level < rootLevel_; ++level) {
    Splits& above = splits_[static_cast<std::size_t>(level) + 1];
    for (const auto& [key, urgency] : splits_[static_cast<std::size_t>(level)]) {
      for (std::int64_t dj = -1; dj <= 1; ++dj) {
        for (std::int64_t di = -1; di <= 1; ++di) {
          const NodeKey parent = key.neighbour(static_cast<int>(di), static_cast<int>(dj)).parent();
          if (!roots_.contains(parent.ancestor(rootLevel_))) continue;
          const auto [place, isNew] = above.emplace(parent, urgency);
          place->second = std::max(place->second, urgency);
        }
      }
    }
  }
}

void Selection::list(const NodeKey& key, double urgency) {
  const Splits& level = splits_[static_cast<std::size_t>(key.level)];
  const auto found = level.find(key);
  const bool isLeaf = found == level.end();
  nodes_.push_back({key, isLeaf, urgency});
  if (isLeaf) {
    ++leaves_;
    return;
  }
  for (int child = 0; child < 4; ++child) {
    list({key.level - 1, key.i * 2 + (child & 1), key.j * 2 + (child >> 1)}, found->second);
  }
}

bool Selection::contains(const NodeKey& key) const {
  if (key.level > rootLevel_ || !roots_.contains(key.ancestor(rootLevel_))) return false;
  return key.level == rootLevel_ || splits_[static_cast<std::size_t>(key.level) + 1].contains(key.parent());
}

bool Selection::isLeaf(const NodeKey& key) const {
  return contains(key) && !splits_[static_cast<std::size_t>(key.level)].contains(key);
}

}  // namespace teren
