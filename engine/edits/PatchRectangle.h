// Rectangles of patches: which ground an edit needs, and which a live surface has.
#pragma once

#include <algorithm>
#include <cstdint>

namespace teren {

/// Patches (i, j) with west <= i < east and south <= j < north; never empty.
struct PatchRectangle {
  std::int64_t west = 0, south = 0, east = 1, north = 1;

  bool contains(const PatchRectangle& other) const noexcept {
    return west <= other.west && other.east <= east && south <= other.south && other.north <= north;
  }
  /// A common border is none: a surface changes nothing there.
  bool overlaps(const PatchRectangle& other) const noexcept {
    return west < other.east && other.west < east && south < other.north && other.south < north;
  }
  PatchRectangle joinedWith(const PatchRectangle& other) const noexcept {
    return {std::min(west, other.west), std::min(south, other.south), std::max(east, other.east),
            std::max(north, other.north)};
  }
  /// With `intervals` along a patch's side; a side of more than 2^30 samples counts as that.
  std::int64_t samples(int intervals) const noexcept {
    const auto along = [intervals](std::int64_t patches) {
      return std::min(patches, (std::int64_t{1} << 30) / intervals) * intervals + 1;
    };
    return along(east - west) * along(north - south);
  }
};

}  // namespace teren
