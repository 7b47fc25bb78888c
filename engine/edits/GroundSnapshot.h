// The ground's changed samples at one moment, with what they add to the error of every level.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <unordered_map>

#include "teren/GroundEdits.h"

#include "edits/GroundOverrides.h"
#include "patch/NodeKey.h"

namespace teren {

/// How much worse a level's triangles are for the edits is measured: a sample was moved by so many metres,
/// the triangle over it by what its corners were moved by, linearly between them. Their difference is largest
/// at a sample, because a level's triangles are made of whole level-0 triangles, and `moved` is the largest
/// of a node's, whichever way squares are split. A square of the outermost ring whose side others join with
/// vertices of their own misses what it did and what its side did, at most. Measured up to the level whose
/// squares are patches; beyond that the bound is how differently two
/// samples of a node were moved, or one and the ground beside it.
class GroundSnapshot final : public GroundEdits {
 public:
  /// Of a world of so many levels above level 0. `before`, if there is one, is an older snapshot of the same
  /// ground: what has not changed since is not measured again. Measuring costs about 10 ns a sample and level
  /// of patches that changed and those beside them, all else about a microsecond a patch that ever changed.
  GroundSnapshot(GroundOverrides overrides, int topLevel, const GroundSnapshot* before = nullptr);

  const GroundOverrides& overrides() const noexcept { return overrides_; }

  void overlay(int level, std::int64_t column, std::int64_t row, HeightView grid) const override {
    overrides_.overlay(GroundOverrides::Over::earlier, level, column, row, grid);
  }
  double moved(int level, std::int64_t i, std::int64_t j) const override;
  /// The samples are those of the overrides too, while they share them.
  std::size_t bytes() const noexcept override { return bytes_; }

 private:
  static constexpr int kMostMeasured = 12;  // levels
  using Patch = GroundOverrides::Patch;
  /// What edits made of a patch with all four of its lines, and of which samples that was measured: its own,
  /// those to the east, to the north and to the north-east; null where nothing was taken.
  struct Measure {
    std::array<const Patch*, 4> of{};
    float low = 0.0F, high = 0.0F;              // [m] of how far samples were moved, and 0
    std::array<float, kMostMeasured> errors{};  // [m] at levels from 1 on
  };
  /// [m] Of how far samples were moved, and 0; where the error itself is known, from 0 to that.
  struct Range {
    float low = 0.0F, high = 0.0F;
  };
  const Patch* patchAt(std::int64_t i, std::int64_t j) const;
  Measure measured(const std::array<const Patch*, 4>& patches) const;

  GroundOverrides overrides_;
  int measuredLevels_;
  std::map<GroundOverrides::Key, Measure> measures_;
  std::unordered_map<NodeKey, Range, NodeKeyHash> errors_;  // of nodes above level 0
  std::size_t bytes_ = 0;
};

}  // namespace teren
