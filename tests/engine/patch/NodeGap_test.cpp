#include "patch/NodeGap.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "teren/HeightMap.h"
#include "teren/HeightSampling.h"

#include "tests/engine/world/RandomDraws.h"

namespace teren {
namespace {

HeightMap randomHeights(int side, RandomSequence& random) {
  HeightMap heights(side, side);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) heights(x, y) = static_cast<float>(100.0 * uniform(random));
  }
  return heights;
}

ConstHeightView viewOf(const HeightMap& heights) {
  return heights.view();
}

TEST(LargestGap, IsTheLargestDistanceAnywhereBetweenTheTwoSurfaces) {
  RandomSequence random(11);
  constexpr int kSide = 9, kBetween = 12;
  for (int trial = 0; trial < 40; ++trial) {
    const int down = trial % 4;
    const HeightMap coarse = randomHeights(kSide, random), fine = randomHeights(kSide, random);
    const NodePart part{down, trial % (1 << down), (trial / 3) % (1 << down)};
    const double gap = largestGap(viewOf(coarse), viewOf(fine), part);
    double reference = 0.0;
    for (int y = 0; y <= (kSide - 1) * kBetween; ++y) {
      for (int x = 0; x <= (kSide - 1) * kBetween; ++x) {
        const double u = x / double{kBetween}, v = y / double{kBetween};
        const double parts = 1 << down;
        const double below = triangleHeight(viewOf(coarse), (part.column * (kSide - 1) + u) / parts,
                                            (part.row * (kSide - 1) + v) / parts);
        reference = std::max(reference, std::fabs(triangleHeight(viewOf(fine), u, v) - below));
      }
    }
    EXPECT_NEAR(gap, reference, 1e-10) << "trial " << trial;
  }
}

TEST(LargestGap, IsNothingWhereTheFinerNodeLiesOnTheCoarserOnesTriangles) {
  RandomSequence random(12);
  HeightMap coarse = randomHeights(5, random), fine(5, 5);
  for (float& height : std::span(coarse.view().data(), 25)) height = std::floor(height);  // halves are exact
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x) {
      fine(x, y) = static_cast<float>(triangleHeight(viewOf(coarse), 2.0 + 0.5 * x, 0.5 * y));
    }
  }
  EXPECT_EQ(largestGap(viewOf(coarse), viewOf(fine), {1, 1, 0}), 0.0);
  EXPECT_GT(largestGap(viewOf(coarse), viewOf(fine), {1, 0, 1}), 0.0);
}

TEST(LargestBend, SeesRowsColumnsAndTheDiagonalOfSquares) {
  const auto bendOf = [](auto&& height) {
    HeightMap heights(5, 5);
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 5; ++x) heights(x, y) = static_cast<float>(height(x, y));
    }
    return largestBend(viewOf(heights));
  };
  EXPECT_EQ(bendOf([](int x, int y) { return 3 * x - 7 * y; }), 0.0);
  EXPECT_EQ(bendOf([](int x, int) { return x * x; }), 2.0);
  EXPECT_EQ(bendOf([](int, int y) { return -2 * y * y; }), 4.0);
  EXPECT_EQ(bendOf([](int x, int y) { return x * y; }), 2.0);  // along the diagonal alone
  EXPECT_EQ(bendOf([](int x, int y) { return x == 4 && y == 3 ? 1.0 : 0.0; }), 2.0);  // down the rim
  EXPECT_EQ(largestBend(viewOf(HeightMap(2, 2))), 0.0);
}

}  // namespace
}  // namespace teren
