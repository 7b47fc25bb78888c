// Depths of loose ground, patch by patch.
#include "edits/LooseLayer.h"

#include <utility>

#include <gtest/gtest.h>

#include "teren/HeightMap.h"

#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

constexpr int kIntervals = 8;

HeightMap filled(int columns, int rows, float depth) {
  HeightMap map(columns, rows);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) map(x, y) = depth;
  }
  return map;
}

/// [m] Different for every sample near 0, and never 0.
float depthAt(std::int64_t column, std::int64_t row) {
  return static_cast<float>(1 + ((column + 64) & 127) + 128 * ((row + 64) & 127)) / 64.0F;
}

HeightMap depths(std::int64_t column, std::int64_t row, int columns, int rows) {
  HeightMap map(columns, rows);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) map(x, y) = depthAt(column + x, row + y);
  }
  return map;
}

TEST(LooseLayer, KeepsDepthsAcrossPatchesOnBothSidesOfZero) {
  LooseLayer loose(kIntervals);
  EXPECT_TRUE(loose.empty());
  loose.take(-11, -3, depths(-11, -3, 21, 9).view());
  EXPECT_EQ(loose.patches().size(), 4U * 2U);
  HeightMap all = filled(40, 30, -1.0F);
  EXPECT_TRUE(loose.overlay(-20, -10, all.view()));
  for (int y = 0; y < all.rows(); ++y) {
    for (int x = 0; x < all.columns(); ++x) {
      const int column = x - 20, row = y - 10;
      const bool isTaken = column >= -11 && column < 10 && row >= -3 && row < 6;
      const bool isInPatch = column >= -16 && column < 16 && row >= -8 && row < 8;
      ASSERT_EQ(all(x, y), isTaken     ? depthAt(column, row)
                           : isInPatch ? 0.0F
                                       : -1.0F)
          << column << ", " << row;
    }
  }
  HeightMap part(5, 4);
  EXPECT_TRUE(loose.overlay(-2, 1, part.view()));
  EXPECT_TRUE(test::sameBits(part.view(), depths(-2, 1, 5, 4).view()));
}

TEST(LooseLayer, SaysWhereNothingIsLoose) {
  LooseLayer loose(kIntervals);
  HeightMap map = filled(6, 6, 3.0F);
  EXPECT_FALSE(loose.overlay(0, 0, map.view()));
  loose.take(0, 0, filled(8, 8, 0.0F).view());
  EXPECT_TRUE(loose.empty()) << "nothing is kept of nothing";
  loose.take(100, 100, filled(1, 1, 2.0F).view());
  EXPECT_FALSE(loose.overlay(0, 0, map.view()));
  EXPECT_TRUE(test::sameBits(map.view(), filled(6, 6, 3.0F).view()));
}

TEST(LooseLayer, ForgetsAPatchInWhichAllIsSolidAgain) {
  LooseLayer loose(kIntervals);
  loose.take(2, 2, filled(3, 3, 1.5F).view());
  loose.take(20, 2, filled(1, 1, 1.5F).view());
  loose.take(3, 2, filled(2, 3, 0.0F).view());
  EXPECT_EQ(loose.patches().size(), 2U);
  const std::size_t bytes = loose.bytes();
  loose.take(2, 2, filled(1, 3, 0.0F).view());
  EXPECT_EQ(loose.patches().size(), 1U);
  EXPECT_EQ(loose.bytes(), bytes / 2);
  EXPECT_GE(loose.bytes(), kIntervals * kIntervals * sizeof(float));
}

TEST(LooseLayer, SharesWithCopiesWhatNeitherChanges) {
  LooseLayer loose(kIntervals);
  loose.take(0, 0, filled(16, 8, 1.0F).view());
  const LooseLayer copy = loose;
  loose.take(9, 1, filled(1, 1, 2.0F).view());
  EXPECT_EQ(loose.patches().at({0, 0}), copy.patches().at({0, 0}));
  EXPECT_NE(loose.patches().at({0, 1}), copy.patches().at({0, 1}));
  HeightMap one(1, 1);
  EXPECT_TRUE(copy.overlay(9, 1, one.view()));
  EXPECT_EQ(one(0, 0), 1.0F);
  EXPECT_TRUE(loose.overlay(9, 1, one.view()));
  EXPECT_EQ(one(0, 0), 2.0F);
}

}  // namespace
}  // namespace teren
