// Which parts of the disc of water around the eye there is any need to draw.
#pragma once

#include <array>
#include <cstdint>

namespace teren {

/// The disc is made of rings, denser inside, and sectors: ring r reaches from radius(r) to radius(r + 1),
/// shares of the disc's; sector s from angle 2 pi s / kSectors to the next, counted from the east to the
/// north. Where land is seen there is mostly no water at all, and what the land hides costs as much as what
/// it does not: its depth is known only when its fragments have been computed.
class WaterCells {
 public:
  static constexpr int kRings = 32, kSectors = 64;
  static constexpr float radius(int ring) noexcept {
    const float share = static_cast<float>(ring) / kRings;
    return share * share;
  }

  void clear() noexcept { cells_ = {}; }
  /// Marks at least the cells that have a part over the rectangle; east and north of the disc's middle, in
  /// its radius.
  void mark(double west, double south, double east, double north) noexcept;
  bool has(int ring, int sector) const noexcept {
    return (cells_[static_cast<std::size_t>(ring)] >> sector & 1U) != 0;
  }

 private:
  std::array<std::uint64_t, kRings> cells_{};  // a bit for each sector
};
static_assert(WaterCells::kSectors == 64);

}  // namespace teren
