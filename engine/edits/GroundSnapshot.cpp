#include "edits/GroundSnapshot.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace teren {

namespace {

/// How far samples were moved, n + 1 of them a row, and the largest height among those that were.
struct Moves {
  std::vector<float> metres;
  float highest = 0.0F;
  bool any = false;
};

/// The east line, the north line and the corner are the neighbours'.
Moves movesOf(const std::array<const GroundOverrides::Patch*, 4>& patches, int n) {
  Moves moves{std::vector<float>(static_cast<std::size_t>(n + 1) * static_cast<std::size_t>(n + 1), 0.0F)};
  for (std::size_t which = 0; which < patches.size(); ++which) {
    const GroundOverrides::Patch* patch = patches[which];
    if (patch == nullptr) continue;
    const bool isEast = (which & 1) != 0, isNorth = (which & 2) != 0;
    for (int y = 0; y < (isNorth ? 1 : n); ++y) {
      for (int x = 0; x < (isEast ? 1 : n); ++x) {
        const float own = patch->own(x, y);
        if (std::isnan(own)) continue;
        const float now = std::isnan(patch->now(x, y)) ? own : patch->now(x, y);
        const int column = isEast ? n : x, row = isNorth ? n : y;
        moves.metres[static_cast<std::size_t>(row * (n + 1) + column)] = now - own;
        moves.highest = std::max({moves.highest, std::fabs(now), std::fabs(own)});
        moves.any = true;
      }
    }
  }
  return moves;
}

/// How far samples of a square were moved, and how far its triangles say, split from south-west to north-east
/// and the other way.
class Square {
 public:
  Square(float southWest, float southEast, float northWest, float northEast)
      : sw_(southWest), se_(southEast), nw_(northWest), ne_(northEast) {}

  float off(float moved, float u, float v) const noexcept {
    const float rising =
        u >= v ? sw_ + u * (se_ - sw_) + v * (ne_ - se_) : sw_ + u * (ne_ - nw_) + v * (nw_ - sw_);
    const float falling = u + v <= 1.0F ? sw_ + u * (se_ - sw_) + v * (nw_ - sw_)
                                        : ne_ + (1.0F - u) * (nw_ - ne_) + (1.0F - v) * (se_ - ne_);
    return std::max(std::fabs(moved - rising), std::fabs(moved - falling));
  }

 private:
  float sw_, se_, nw_, ne_;
};

/// [m] By how much triangles over squares of so many samples miss how far samples were moved.
float errorOf(const std::vector<float>& moves, int n, int samples) {
  const auto at = [&](int column, int row) {
    return moves[static_cast<std::size_t>(row * (n + 1) + column)];
  };
  const float step = 1.0F / static_cast<float>(samples);
  float largest = 0.0F, ring = 0.0F, sides = 0.0F;
  for (int row = 0; row < n; row += samples) {
    for (int column = 0; column < n; column += samples) {
      const Square square(at(column, row), at(column + samples, row), at(column, row + samples),
                          at(column + samples, row + samples));
      float own = 0.0F;
      for (int y = 0; y <= samples; ++y) {
        const bool isSide = row + y == 0 || row + y == n;
        for (int x = 0; x <= samples; ++x) {
          const float off =
              square.off(at(column + x, row + y), static_cast<float>(x) * step, static_cast<float>(y) * step);
          own = std::max(own, off);
          if (isSide || column + x == 0 || column + x == n) sides = std::max(sides, off);
        }
      }
      largest = std::max(largest, own);
      const bool isInRing = row == 0 || column == 0 || row + samples == n || column + samples == n;
      if (isInRing) ring = std::max(ring, own);
    }
  }
  return std::max(largest, ring + sides);
}

}  // namespace

GroundSnapshot::GroundSnapshot(GroundOverrides overrides, int topLevel, const GroundSnapshot* before)
    : overrides_(std::move(overrides)),
      measuredLevels_(std::min(
          {std::countr_zero(static_cast<unsigned>(overrides_.intervals())), topLevel, kMostMeasured})) {
  const auto measure = [&](std::int64_t i, std::int64_t j) {
    const GroundOverrides::Key key{j, i};
    if (measures_.contains(key)) return;
    const std::array<const Patch*, 4> of{patchAt(i, j), patchAt(i + 1, j), patchAt(i, j + 1),
                                         patchAt(i + 1, j + 1)};
    if (before != nullptr) {
      const auto found = before->measures_.find(key);
      if (found != before->measures_.end() && found->second.of == of) {
        measures_.emplace(key, found->second);
        return;
      }
    }
    measures_.emplace(key, measured(of));
  };
  for (const auto& [key, held] : overrides_.patches()) {
    const auto& [j, i] = key;
    measure(i, j);
    measure(i - 1, j);
    measure(i, j - 1);
    measure(i - 1, j - 1);
  }
  for (const auto& [key, patch] : measures_) {
    if (patch.low == patch.high) continue;
    for (NodeKey node = NodeKey{0, key.second, key.first}.parent(); node.level <= topLevel;
         node = node.parent()) {
      Range& range = errors_[node];
      if (node.level <= measuredLevels_) {
        range.high = std::max(range.high, patch.errors[static_cast<std::size_t>(node.level - 1)]);
      } else {
        range = {std::min(range.low, patch.low), std::max(range.high, patch.high)};
      }
    }
  }
  constexpr std::size_t kInMap = 32;  // links and a hash, as allocated (estimated)
  bytes_ = overrides_.bytes() + errors_.size() * (sizeof(NodeKey) + sizeof(Range) + kInMap) +
           measures_.size() * (sizeof(GroundOverrides::Key) + sizeof(Measure) + kInMap);
}

const GroundOverrides::Patch* GroundSnapshot::patchAt(std::int64_t i, std::int64_t j) const {
  const auto found = overrides_.patches().find({j, i});
  return found == overrides_.patches().end() ? nullptr : found->second.patch.get();
}

GroundSnapshot::Measure GroundSnapshot::measured(const std::array<const Patch*, 4>& patches) const {
  const int n = overrides_.intervals();
  Measure measure{patches};
  const Moves moves = movesOf(patches, n);
  if (!moves.any) return measure;
  const auto [low, high] = std::minmax_element(moves.metres.begin(), moves.metres.end());
  measure.low = std::min(*low, 0.0F);
  // Taken and given back is no reason to be left alone: what is drawn may still be what was taken.
  measure.high = std::max(*high, std::numeric_limits<float>::denorm_min());
  const float rounding = 0x1p-22F * moves.highest;
  for (int level = 1; level <= measuredLevels_; ++level) {
    measure.errors[static_cast<std::size_t>(level - 1)] = errorOf(moves.metres, n, 1 << level) + rounding;
  }
  return measure;
}

double GroundSnapshot::moved(int level, std::int64_t i, std::int64_t j) const {
  const auto found = errors_.find({level, i, j});
  if (found == errors_.end()) return 0.0;
  return static_cast<double>(found->second.high) - static_cast<double>(found->second.low);
}

}  // namespace teren
