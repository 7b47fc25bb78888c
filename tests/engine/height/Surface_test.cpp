#include "height/Surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

double uniform(RandomSequence& random) {
  return std::ldexp(static_cast<double>(random.nextBits(53)), -53);
}
float height(RandomSequence& random) {
  return static_cast<float>(2000.0 * uniform(random) - 1000.0);
}

TEST(Surface, GoesThroughTheCornersOfASquare) {
  const SquareHeights corner{1.25, -7.5, 300.0, 12.0};
  EXPECT_EQ(sampleTriangle(corner, 0.0, 0.0).height, 1.25);
  EXPECT_EQ(sampleTriangle(corner, 1.0, 0.0).height, -7.5);
  EXPECT_EQ(sampleTriangle(corner, 0.0, 1.0).height, 300.0);
  EXPECT_EQ(sampleTriangle(corner, 1.0, 1.0).height, 12.0);
}

TEST(Surface, SplitsASquareFromSouthWestToNorthEast) {
  const SquareHeights ridge{0.0, -1.0, -1.0, 0.0};  // the diagonal is level, both other corners lie below
  EXPECT_EQ(sampleTriangle(ridge, 0.5, 0.5).height, 0.0);
  EXPECT_DOUBLE_EQ(sampleTriangle(ridge, 0.75, 0.25).height, -0.5);
  EXPECT_DOUBLE_EQ(sampleTriangle(ridge, 0.25, 0.75).height, -0.5);
}

TEST(Surface, IsTheSameFromBothTrianglesOnTheDiagonal) {
  constexpr std::uint64_t kSeed = 21;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  for (int trial = 0; trial < 10'000; ++trial) {
    const SquareHeights corner{height(random), height(random), height(random), height(random)};
    const double t = uniform(random);
    const double straight = corner.southWest + t * (corner.northEast - corner.southWest);
    ASSERT_NEAR(sampleTriangle(corner, t, t).height, straight, 1e-11);
    ASSERT_NEAR(sampleTriangle(corner, t, std::nextafter(t, 2.0)).height, straight, 1e-11);
  }
}

TEST(Surface, ReportsTheSlopesItIsDrawnWith) {
  constexpr std::uint64_t kSeed = 22;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  for (int trial = 0; trial < 1000; ++trial) {
    const SquareHeights corner{height(random), height(random), height(random), height(random)};
    const double x = 0.25 + 0.25 * uniform(random), y = trial % 2 == 0 ? x / 2.0 : x + 0.125;
    const TrianglePoint point = sampleTriangle(corner, x, y);
    constexpr double h = 0x1p-6;  // stays in the same triangle
    ASSERT_NEAR((sampleTriangle(corner, x + h, y).height - point.height) / h, point.slopeX, 1e-8);
    ASSERT_NEAR((sampleTriangle(corner, x, y + h).height - point.height) / h, point.slopeY, 1e-8);
  }
}

/// The angle [radian] between (x, y, z) and a packed normal, in long double.
long double angleTo(long double x, long double y, long double z, const PackedNormal& packed) {
  const long double px = packed.x / 32767.0L, py = packed.y / 32767.0L;
  const long double pz = std::sqrt(std::max(0.0L, 1.0L - px * px - py * py));
  const long double cx = y * pz - z * py, cy = z * px - x * pz, cz = x * py - y * px;
  return std::atan2(std::sqrt(cx * cx + cy * cy + cz * cz), x * px + y * py + z * pz);
}

TEST(Surface, PacksNormalsOfSlopesUpToTenWithinTheNamedError) {
  constexpr std::uint64_t kSeed = 25;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  long double worst = 0.0L;
  for (int trial = 0; trial < 200'000; ++trial) {
    const double spacing = std::ldexp(1.0, static_cast<int>(random.nextBits(4)) - 4);
    const double slope = trial % 2 == 0 ? 10.0 : 10.0 * uniform(random);
    const double direction = 2.0 * std::numbers::pi * uniform(random);
    const double base = 500.0 * uniform(random);
    const auto risen = [&](double share) { return static_cast<float>(base + slope * share * 2.0 * spacing); };
    const auto west = static_cast<float>(base), south = west;
    const float east = risen(0.9999 * std::cos(direction)), north = risen(0.9999 * std::sin(direction));
    const PackedNormal packed = vertexNormal(west, east, south, north, spacing);
    const long double nx = static_cast<long double>(west) - east,
                      ny = static_cast<long double>(south) - north, nz = 2.0L * spacing;
    worst = std::max(worst, angleTo(nx, ny, nz, packed));
  }
  RecordProperty("worst_microradian", static_cast<int>(worst * 1e6L));
  EXPECT_LE(worst, kPackedNormalError);
  EXPECT_GE(worst, 0.9 * kPackedNormalError) << "the named error is far from sharp";
}

TEST(Surface, HasNormalsThatPointUpAndAwayFromTheRise) {
  EXPECT_EQ(vertexNormal(5.0F, 5.0F, -3.0F, -3.0F, 2.0), (PackedNormal{0, 0}));
  const PackedNormal rising = vertexNormal(0.0F, 4.0F, 0.0F, 0.0F, 2.0);  // 45 degrees up towards the east
  EXPECT_EQ(rising.x, -23170);                                            // -32767 / sqrt 2
  EXPECT_EQ(rising.y, 0);
  const PackedNormal north = vertexNormal(0.0F, 0.0F, 0.0F, 4.0F, 2.0);
  EXPECT_EQ(north.x, 0);
  EXPECT_EQ(north.y, -23170);
}

TEST(Surface, PacksEvenAVerticalCliffInsideSixteenBits) {
  const PackedNormal cliff = vertexNormal(-3e38F, 3e38F, 0.0F, 0.0F, 1e-3);
  EXPECT_EQ(cliff.x, -32767);
  EXPECT_EQ(vertexNormal(3e38F, -3e38F, 0.0F, 0.0F, 1e-3).x, 32767);
}

TEST(Surface, HasFaceNormalsOfUnitLengthAtRightAnglesToTheTriangle) {
  constexpr std::uint64_t kSeed = 26;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  for (int trial = 0; trial < 1000; ++trial) {
    const SquareHeights corner{height(random), height(random), height(random), height(random)};
    const double side = 0.5 + 100.0 * uniform(random);
    const bool southEast = trial % 2 == 0;
    const std::array<double, 3> n =
        faceNormal(sampleTriangle(corner, southEast ? 0.75 : 0.25, southEast ? 0.25 : 0.75), side);
    ASSERT_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1.0, 1e-14);
    ASSERT_GT(n[2], 0.0);
    const double diagonal = n[0] * side + n[1] * side + n[2] * (corner.northEast - corner.southWest);
    const double edge = southEast ? n[0] * side + n[2] * (corner.southEast - corner.southWest)
                                  : n[1] * side + n[2] * (corner.northWest - corner.southWest);
    ASSERT_NEAR(diagonal, 0.0, 1e-9);
    ASSERT_NEAR(edge, 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace teren
