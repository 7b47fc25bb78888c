// What edits have made of the ground: level-0 samples that are no longer the world's own, patch by patch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "teren/GroundEdits.h"
#include "teren/HeightMap.h"

namespace teren {

/// Samples are numbered through the world, column n i being the west line of the patches (i, j); a patch owns
/// its south and its west line. A patch without any takes no memory, one with some twice as much as all its
/// samples: what they were is kept, too, also where they are that again. Those that share patches (share)
/// copy one before they take something there.
class GroundOverrides {
 public:
  /// n x n: what samples are now, NaN where that is the world's own height; and what the world's own is, NaN
  /// where nothing was ever taken.
  struct Patch {
    HeightMap now, own;
  };
  struct Held {
    std::shared_ptr<Patch> patch;
    bool isShared = false;
  };
  using Key = std::pair<std::int64_t, std::int64_t>;  ///< (j, i)

  /// `intervals`: n, a power of two.
  explicit GroundOverrides(int intervals);
  GroundOverrides(GroundOverrides&&) noexcept = default;
  GroundOverrides& operator=(GroundOverrides&&) noexcept = default;

  /// Another one of the same samples. O(patches).
  GroundOverrides share();
  /// The same of one that was made by `share`, and took nothing since (assert).
  GroundOverrides shared() const;

  int intervals() const noexcept { return 1 << bits_; }

  /// A patch of which nothing was taken yet, behind all others, to be filled in.
  Patch& add(const Key& key);

  /// Sample (x, y) of the views is number (column + x, row + y). Takes those of `heights` that differ from
  /// `before` or stand where something was taken before. Views of one size (assert), heights finite.
  void take(std::int64_t column, std::int64_t row, ConstHeightView heights, ConstHeightView before);

  /// Boxes with all samples that are not as in `before`, of which this one then also knows what was ever
  /// taken there. O(patches + samples of those that are not shared).
  std::vector<SampleBox> follow(const GroundOverrides& before);

  /// Nothing where the ground is the world's own. O(log patches).
  std::optional<float> sample(std::int64_t column, std::int64_t row) const;

  /// Which samples are written over others: those that are not the world's own, or, over what may have
  /// earlier ones, all that ever were not.
  enum class Over { world, earlier };
  /// Writes samples over a grid of the ground at a level: (x, y) of `grid` is the level-0 sample ((column +
  /// x) 2^level, (row + y) 2^level). O(grid's samples in patches with any, and log patches for each row of
  /// such).
  void overlay(Over over, int level, std::int64_t column, std::int64_t row, HeightView grid) const;

  /// FNV-1a of where the ground is not the world's own, and what it is there, -0 as 0.
  std::uint64_t hash() const;

  std::size_t bytes() const noexcept;

  const std::map<Key, Held>& patches() const noexcept { return patches_; }

 private:
  Key keyOf(std::int64_t column, std::int64_t row) const noexcept { return {row >> bits_, column >> bits_}; }
  void overlayPatch(const Key& key, const Patch& patch, Over over, int level, std::int64_t column,
                    std::int64_t row, HeightView grid) const;
  static Patch& changeable(Held& held);
  static void remember(Held& held, const Patch& before);

  int bits_;
  std::map<Key, Held> patches_;
};

}  // namespace teren
