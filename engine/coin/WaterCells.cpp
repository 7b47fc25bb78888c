#include "coin/WaterCells.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace teren {
namespace {

/// The sectors between two angles [rad], 0 <= end - begin, and both of their neighbours.
std::uint64_t sectorsBetween(double begin, double end) {
  constexpr double kSector = 2.0 * std::numbers::pi / WaterCells::kSectors;
  const int first = static_cast<int>(std::floor(begin / kSector)) - 1;
  const int last = static_cast<int>(std::floor(end / kSector)) + 1;
  if (last - first >= WaterCells::kSectors) return ~std::uint64_t{0};
  std::uint64_t sectors = 0;
  for (int sector = first; sector <= last; ++sector) {
    sectors |= std::uint64_t{1} << static_cast<unsigned>(sector & (WaterCells::kSectors - 1));
  }
  return sectors;
}

}  // namespace

void WaterCells::mark(double west, double south, double east, double north) noexcept {
  const double nearest = std::hypot(std::max({west, -east, 0.0}), std::max({south, -north, 0.0}));
  const double farthest = std::hypot(std::max(-west, east), std::max(-south, north));
  if (!(nearest < 1.0)) return;
  // A ring's outline is straight from sector to sector and cuts off a little of its circle.
  constexpr double kStraight = 0.998;
  static_assert(kSectors >= 64);
  const auto ring = [](double distance) {
    return std::clamp(static_cast<int>(std::sqrt(distance) * kRings), 0, kRings - 1);
  };
  const int first = ring(nearest), last = ring(std::min(farthest / kStraight, 1.0));
  std::uint64_t sectors = ~std::uint64_t{0};
  if (nearest > 0.0) {  // seen from outside, all of it lies within half a turn of its middle
    const double x = 0.5 * (west + east), y = 0.5 * (south + north);
    double left = 0.0, right = 0.0;
    for (const double cornerX : {west, east}) {
      for (const double cornerY : {south, north}) {
        const double turn = std::atan2(x * cornerY - y * cornerX, x * cornerX + y * cornerY);
        left = std::max(left, turn);
        right = std::min(right, turn);
      }
    }
    const double middle = std::atan2(y, x);
    sectors = sectorsBetween(middle + right, middle + left);
  }
  for (int at = first; at <= last; ++at) cells_[static_cast<std::size_t>(at)] |= sectors;
}

}  // namespace teren
