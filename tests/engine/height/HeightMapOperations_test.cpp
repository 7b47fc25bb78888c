#include "teren/HeightMapOperations.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

HeightMap randomMap(std::uint64_t seed, int columns, int rows, double base, double amplitude) {
  RandomSequence random(seed);
  HeightMap map(columns, rows);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      map(x, y) = static_cast<float>(
          base + amplitude * (std::ldexp(static_cast<double>(random.nextBits(53)), -52) - 1.0));
    }
  }
  return map;
}

struct Exact {
  long double min = 0.0L, max = 0.0L, mean = 0.0L, deviation = 0.0L, largest = 0.0L;
};
Exact exactStatistics(ConstHeightView heights) {
  Exact exact{heights(0, 0), heights(0, 0)};
  const long double count = static_cast<long double>(heights.columns()) * heights.rows();
  for (int y = 0; y < heights.rows(); ++y) {
    for (int x = 0; x < heights.columns(); ++x) {
      const long double height = heights(x, y);
      exact.min = std::min(exact.min, height);
      exact.max = std::max(exact.max, height);
      exact.mean += height / count;
      exact.largest = std::max(exact.largest, std::fabs(height));
    }
  }
  for (int y = 0; y < heights.rows(); ++y) {
    for (int x = 0; x < heights.columns(); ++x) {
      exact.deviation += (heights(x, y) - exact.mean) * (heights(x, y) - exact.mean) / count;
    }
  }
  exact.deviation = std::sqrt(exact.deviation);
  return exact;
}

TEST(HeightMapOperations, StatisticsAgreeWithLongDouble) {
  struct Case {
    int columns, rows;
    double base, amplitude;
  };
  constexpr Case kCases[] = {{1, 1, 7.0, 3.0},        {1, 500, 0.0, 100.0},     {500, 1, -20.0, 1.0},
                             {1025, 513, 0.0, 500.0}, {257, 129, 8000.0, 0.01}, {65, 65, 1e30, 1e29}};
  std::uint64_t seed = 31;
  for (const Case& c : kCases) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << c.columns << " x " << c.rows);
    const HeightMap map = randomMap(seed++, c.columns, c.rows, c.base, c.amplitude);
    const HeightStatistics found = statistics(map.view());
    const Exact exact = exactStatistics(map.view());
    EXPECT_EQ(found.min, static_cast<double>(exact.min));
    EXPECT_EQ(found.max, static_cast<double>(exact.max));
    EXPECT_NEAR(found.mean, static_cast<double>(exact.mean), static_cast<double>(1e-12L * exact.largest));
    EXPECT_NEAR(found.deviation, static_cast<double>(exact.deviation),
                static_cast<double>(1e-12L * exact.largest));
  }
}

TEST(HeightMapOperations, StatisticsOfNothingAreZeroAndOfOneHeightHaveNoDeviation) {
  const HeightStatistics nothing = statistics(HeightMap(0, 5).view());
  EXPECT_EQ(nothing.min, 0.0);
  EXPECT_EQ(nothing.max, 0.0);
  EXPECT_EQ(nothing.mean, 0.0);
  EXPECT_EQ(nothing.deviation, 0.0);
  HeightMap flat(33, 33);
  for (int y = 0; y < 33; ++y) std::fill_n(flat.view().row(y), 33, 0.1F);
  const HeightStatistics one = statistics(flat.view());
  EXPECT_EQ(one.mean, static_cast<double>(0.1F));
  EXPECT_EQ(one.deviation, 0.0);
}

TEST(HeightMapOperations, StatisticsOfAPartSeeNothingAroundIt) {
  HeightMap map = randomMap(32, 20, 20, 0.0, 1.0);
  for (int k = 0; k < 20; ++k) map(k, 0) = map(0, k) = map(k, 19) = map(19, k) = 1e6F;
  const HeightStatistics inner = statistics(std::as_const(map).view().part(1, 1, 18, 18));
  EXPECT_LE(inner.max, 1.0);
  EXPECT_GE(inner.min, -1.0);
}

TEST(HeightMapOperations, CopiesARectangleAndNothingElse) {
  const HeightMap source = randomMap(33, 12, 10, 5.0, 1.0);
  HeightMap target(9, 9);
  copyHeights(source.view().part(3, 2, 4, 5), target.view().part(1, 4, 4, 5));
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) {
      const bool inside = x >= 1 && x < 5 && y >= 4;
      EXPECT_EQ(target(x, y), inside ? source(x + 2, y - 2) : 0.0F) << x << ", " << y;
    }
  }
}

TEST(HeightMapOperations, CopiesAnEmptyRectangle) {
  HeightMap target(3, 3);
  copyHeights(HeightMap(0, 3).view(), target.view().part(0, 0, 0, 3));
  EXPECT_EQ(statistics(target.view()).max, 0.0);
}

}  // namespace
}  // namespace teren
