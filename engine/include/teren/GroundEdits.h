// What edits have made of the ground at one moment, as those see it who draw.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "teren/HeightMap.h"

namespace teren {

/// Level-0 samples west ... east and south ... north, all of them included, numbered through the world: the
/// patches (i, j) begin with sample n i and n j.
struct SampleBox {
  std::int64_t west = 0, south = 0, east = 0, north = 0;

  bool touches(const SampleBox& other) const noexcept {
    return west <= other.east && other.west <= east && south <= other.north && other.south <= north;
  }
  SampleBox joinedWith(const SampleBox& other) const noexcept {
    return {std::min(west, other.west), std::min(south, other.south), std::max(east, other.east),
            std::max(north, other.north)};
  }
  friend bool operator==(const SampleBox&, const SampleBox&) = default;
};

/// Level-0 samples that are no longer the world's own. Immutable; any thread may ask.
class GroundEdits {
 public:
  virtual ~GroundEdits() = default;

  /// Writes the changed samples over a grid of a level: its sample (x, y) is number (column + x, row + y) of
  /// that level, counted from the world's zero, and level-0 sample ((column + x) 2^level, (row + y) 2^level).
  virtual void overlay(int level, std::int64_t column, std::int64_t row, HeightView grid) const = 0;

  /// [m] At most so much more than before the triangles of a level above 0 may miss the ground of a node,
  /// patches [i, i + 1) 2^level by [j, j + 1) 2^level, also where the vertices of others on its borders are
  /// joined to its own. 0 only where nothing is changed in it, its borders included. O(1).
  virtual double moved(int level, std::int64_t i, std::int64_t j) const = 0;

  virtual std::size_t bytes() const noexcept = 0;
};

}  // namespace teren
