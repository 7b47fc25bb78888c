#include "coin/WaterCells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

/// [low, high)
double uniform(RandomSequence& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.nextBits(53)) * 0x1p-53;
}

/// Whether a point lies in the disc's cell as it is drawn, with straight sides.
bool covers(int ring, int sector, double x, double y) {
  const auto corner = [](int circle, int spoke) {
    const auto radius = static_cast<double>(WaterCells::radius(circle));
    const double angle = 2.0 * std::numbers::pi * spoke / WaterCells::kSectors;
    return std::array{radius * std::cos(angle), radius * std::sin(angle)};
  };
  const std::array<std::array<double, 2>, 4> corners{corner(ring, sector), corner(ring + 1, sector),
                                                     corner(ring + 1, sector + 1), corner(ring, sector + 1)};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto &a = corners[k], &b = corners[(k + 1) % 4];
    if ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) < 0.0) return false;
  }
  return true;
}

TEST(WaterCells, MarkAllThatHaveAPartOverTheRectangle) {
  constexpr std::uint64_t kSeed = 81;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  int inside = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const double size = std::exp2(uniform(random, -10.0, 0.5));
    const double west = uniform(random, -1.1, 1.1), south = uniform(random, -1.1, 1.1);
    WaterCells cells;
    cells.mark(west, south, west + size, south + size * uniform(random, 0.1, 1.0));
    const double x = west + size * uniform(random, 0.0, 1.0),
                 y = south + 0.1 * size * uniform(random, 0.0, 1.0);
    for (int ring = 0; ring < WaterCells::kRings; ++ring) {
      for (int sector = 0; sector < WaterCells::kSectors; ++sector) {
        if (!covers(ring, sector, x, y)) continue;
        ++inside;
        EXPECT_TRUE(cells.has(ring, sector)) << "trial " << trial << ": " << x << ", " << y;
      }
    }
  }
  EXPECT_GT(inside, 1500);
}

TEST(WaterCells, MarkLittleMoreThanTheRectangle) {
  WaterCells cells;
  cells.mark(0.5, 0.5, 0.52, 0.52);
  int marked = 0;
  for (int ring = 0; ring < WaterCells::kRings; ++ring) {
    for (int sector = 0; sector < WaterCells::kSectors; ++sector) marked += cells.has(ring, sector) ? 1 : 0;
  }
  EXPECT_LE(marked, 12);
  EXPECT_GE(marked, 1);
  cells.clear();
  EXPECT_FALSE(cells.has(26, 8));
}

TEST(WaterCells, MarkNoneBeyondTheDisc) {
  WaterCells cells;
  cells.mark(0.9, 0.9, 2.0, 2.0);
  for (int ring = 0; ring < WaterCells::kRings; ++ring) {
    for (int sector = 0; sector < WaterCells::kSectors; ++sector) EXPECT_FALSE(cells.has(ring, sector));
  }
}

}  // namespace
}  // namespace teren
