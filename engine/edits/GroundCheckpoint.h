// The ground after a number of edits, where nothing is live: what a later program may begin with instead of
// applying them again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "teren/Edit.h"
#include "teren/EditedGround.h"
#include "teren/Result.h"

#include "edits/GroundOverrides.h"
#include "edits/LooseLayer.h"

namespace teren {

/// Which edits, in which order, on which world, applied by which versions of deformers.
struct EditListMark {
  std::uint64_t edits = 0, checksum = 0;

  /// Before the first edit.
  static EditListMark ofNone(std::uint64_t worldHash) noexcept;
  EditListMark followedBy(const Edit& edit, std::string_view version) const noexcept;

  friend bool operator==(const EditListMark&, const EditListMark&) = default;
};

/// Immutable.
class GroundCheckpoint {
 public:
  GroundCheckpoint(const EditListMark& mark, const EndedSurfaces& ended, GroundOverrides overrides,
                   LooseLayer loose)
      : mark_(mark), ended_(ended), overrides_(std::move(overrides)), loose_(std::move(loose)) {}

  const EditListMark& mark() const noexcept { return mark_; }
  const EndedSurfaces& ended() const noexcept { return ended_; }
  int intervals() const noexcept { return overrides_.intervals(); }
  /// Shared with the checkpoint.
  GroundOverrides overrides() const { return overrides_.shared(); }
  const LooseLayer& loose() const noexcept { return loose_; }
  std::size_t bytes() const noexcept { return overrides_.bytes() + loose_.bytes(); }

  /// As bytes, little-endian, and back: 36, 20 a patch with samples that are not the world's own and 12 for
  /// each of those, then 20 a patch with loose ones and 8 for each. What was not written by `text` is
  /// refused, or read as some other ground: who stores it adds a checksum. Ground of more than kMostBytes is
  /// refused before it takes any.
  static constexpr std::size_t kMostBytes = std::size_t{1} << 31;
  std::string text() const;
  static Result<GroundCheckpoint> read(const EditListMark& mark, std::string_view text);

 private:
  EditListMark mark_;
  EndedSurfaces ended_;
  GroundOverrides overrides_;
  LooseLayer loose_;
};

}  // namespace teren
