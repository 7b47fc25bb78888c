#include "stream/Selection.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <tuple>

#include "teren/DetailThreshold.h"

#include "stream/View.h"

namespace teren {

namespace {

constexpr double kNearest = 0.1;  // [m] no eye is nearer to what it sees

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

bool Selection::choose(std::span<const Viewer> viewers, double tolerance, std::size_t most) {
  assert(tolerance >= 1.0);
  viewers_.assign(viewers.begin(), viewers.end());
  const int top = static_cast<int>(ground_.errors.size()) - 1;
  double farthest = 0.0;
  for (const Viewer& viewer : viewers_) farthest = std::max(farthest, viewer.detail.distance);
  rootLevel_ = std::max(rootLevel_, rootLevelFor(farthest, ground_.pitch, std::min(top, ground_.coarsest)));
  for (Splits& level : splits_) level.clear();
  splits_.resize(static_cast<std::size_t>(top) + 1);
  findRoots();
  nodes_.clear();
  leaves_ = 0;
  left_ = most / 3;  // a node that is split makes three leaves more
  const auto splitAsWanted = [&](const auto& root) { return split(root.first, tolerance); };
  if (!std::all_of(roots_.begin(), roots_.end(), splitAsWanted) || !balance()) return false;
  for (const auto& [root, urgency] : roots_) list(root, rootUrgency(root));
  std::sort(nodes_.begin(), nodes_.end(), [](const SelectedNode& a, const SelectedNode& b) {
    return std::tuple(-a.urgency, -a.key.level, a.key.j, a.key.i) <
           std::tuple(-b.urgency, -b.key.level, b.key.j, b.key.i);
  });
  return true;
}

double Selection::rootUrgency(const NodeKey& root) const {
  constexpr double kBeforeAllElse = 1e18;  // no error is seen as large
  double nearest = std::numeric_limits<double>::infinity();
  for (const Viewer& viewer : viewers_) nearest = std::min(nearest, distance(viewer, root));
  return kBeforeAllElse / (1.0 + nearest);
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

bool Selection::split(const NodeKey& key, double tolerance) {
  if (key.level == 0) return true;
  const double error = seen(key);
  if (!(error > tolerance * exchangeAt(before_.contains(key)))) return true;
  if (left_-- == 0) return false;
  splits_[static_cast<std::size_t>(key.level)].emplace(key, error);
  for (int child = 0; child < 4; ++child) {
    if (!split(key.child(child), tolerance)) return false;
  }
  return true;
}

/// Where a node is split, all that touch it must be there or finer, so what is above them is split too, and
/// no less urgently.
bool Selection::balance() {
  for (int level = 0; level < rootLevel_; ++level) {
    Splits& above = splits_[static_cast<std::size_t>(level) + 1];
    for (const auto& [key, urgency] : splits_[static_cast<std::size_t>(level)]) {
      for (std::int64_t dj = -1; dj <= 1; ++dj) {
        for (std::int64_t di = -1; di <= 1; ++di) {
          const NodeKey parent = key.neighbour(static_cast<int>(di), static_cast<int>(dj)).parent();
          if (!roots_.contains(parent.ancestor(rootLevel_))) continue;
          const auto [place, isNew] = above.emplace(parent, urgency);
          place->second = std::max(place->second, urgency);
          if (isNew && left_-- == 0) return false;
        }
      }
    }
  }
  return true;
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
    list(key.child(child), found->second);
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
