// What of the ground is loose where a live surface has ended: how deep, at level-0 samples, patch by patch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>

#include "teren/HeightMap.h"

namespace teren {

/// Samples are numbered as in GroundOverrides. A patch without any takes no memory, one with some as much as
/// all its samples. Copies share patches, which nobody changes: a patch in which something changes is another
/// one.
class LooseLayer {
 public:
  using Key = std::pair<std::int64_t, std::int64_t>;  ///< (j, i)
  using Patches = std::map<Key, std::shared_ptr<const HeightMap>>;

  /// `intervals`: n, a power of two.
  explicit LooseLayer(int intervals);

  int intervals() const noexcept { return 1 << bits_; }
  bool empty() const noexcept { return patches_.empty(); }

  /// Sample (x, y) of the view is number (column + x, row + y). From now on it is as in `depths`, all of
  /// which are finite and not negative (assert).
  void take(std::int64_t column, std::int64_t row, ConstHeightView depths);
  /// Writes what is loose over a grid, whose other samples stay. False: nothing is. O(grid's patches log
  /// patches, and its samples in those that have some).
  bool overlay(std::int64_t column, std::int64_t row, HeightView grid) const;
  /// A patch behind all others, with at least one sample that is loose.
  void add(const Key& key, HeightMap depths);

  const Patches& patches() const noexcept { return patches_; }
  std::size_t bytes() const noexcept;

 private:
  template <class Visitor>
  void forEachPart(std::int64_t column, std::int64_t row, int columns, int rows, Visitor&& visit) const;

  int bits_;
  Patches patches_;
};

}  // namespace teren
