// Names of nodes: level and indices.
#pragma once

#include <cstddef>
#include <cstdint>

#include "teren/Hash.h"
#include "teren/Position.h"

namespace teren {

/// The node that covers patches [i 2^level, (i + 1) 2^level) x [j 2^level, (j + 1) 2^level).
struct NodeKey {
  int level = 0;
  std::int64_t i = 0, j = 0;

  NodeKey parent() const noexcept { return {level + 1, i >> 1, j >> 1}; }
  NodeKey neighbour(int di, int dj) const noexcept { return {level, i + di, j + dj}; }
  /// The 0 ... 3rd of the four nodes of the next finer level inside: south-west, south-east, north-west,
  /// north-east.
  NodeKey child(int which) const noexcept { return {level - 1, i * 2 + (which & 1), j * 2 + (which >> 1)}; }
  /// The node of a coarser or equal level that contains this one.
  NodeKey ancestor(int atLevel) const noexcept {
    return {atLevel, i >> (atLevel - level), j >> (atLevel - level)};
  }
  friend bool operator==(const NodeKey&, const NodeKey&) = default;
};

/// Whether a node lies in another, or is it.
inline bool isIn(const NodeKey& inner, const NodeKey& outer) noexcept {
  return inner.level <= outer.level && inner.ancestor(outer.level) == outer;
}

/// Whether the squares of two nodes have a point in common, be it only a corner.
inline bool touch(const NodeKey& a, const NodeKey& b) noexcept {
  const auto meet = [&](std::int64_t low, std::int64_t other) {
    return low << a.level <= (other + 1) << b.level && other << b.level <= (low + 1) << a.level;
  };
  return meet(a.i, b.i) && meet(a.j, b.j);
}

/// The node of a level that a position lies in.
inline NodeKey nodeAt(const Position& position, int level) noexcept {
  return NodeKey{0, position.i, position.j}.ancestor(level);
}

struct NodeKeyHash {
  std::size_t operator()(const NodeKey& key) const noexcept {
    return hashWith(hashWith(static_cast<std::uint64_t>(key.level), static_cast<std::uint64_t>(key.i)),
                    static_cast<std::uint64_t>(key.j));
  }
};

}  // namespace teren
