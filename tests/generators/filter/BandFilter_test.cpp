#include "generators/filter/BandFilter.h"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "generators/fault/FaultFormation.h"
#include "generators/filter/BandReference.h"
#include "tests/generators/filter/FilterMaps.h"
#include "tests/support/AllocationCount.h"
#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

using test::faults;
using test::finish;
using test::rubble;
using test::sameBits;

HeightMap filtered(const BandFilter& filter, HeightMap map, const Slice& slice = Slice::unlimited()) {
  finish(*filter.begin(map.view()), slice);
  return map;
}

TEST(BandFilter, EqualsThePlainVersionBitForBitWhateverTheSides) {
  const int sides[][2] = {{0, 0}, {1, 1}, {1, 9}, {9, 1}, {2, 3}, {8, 8}, {65, 65}, {33, 100}, {257, 31}};
  for (const auto& [columns, rows] : sides) {
    for (const BandFilter& filter : {BandFilter(0.9, 5), BandFilter(0.01, 1), BandFilter(0.5, 3)}) {
      const HeightMap map = rubble(columns, rows, 11);
      HeightMap plain = map;
      bandReference(filter, plain.view());
      EXPECT_TRUE(sameBits(filtered(filter, map).view(), plain.view())) << columns << " x " << rows;
    }
  }
}

TEST(BandFilter, DoesNotDependOnSlicing) {
  const BandFilter filter(0.9, 2);
  for (int side : {1, 3, 65, 257}) {
    const HeightMap map = rubble(side, side, 12);
    const HeightMap whole = filtered(filter, map);
    EXPECT_TRUE(sameBits(filtered(filter, map, test::shortestSlice()).view(), whole.view())) << side;
  }
}

TEST(BandFilter, ChangesNothingOutsideAView) {
  HeightMap map = rubble(40, 30, 13);
  const HeightMap before = map;
  HeightMap inside(17, 19);
  for (int row = 0; row < 19; ++row) {
    for (int column = 0; column < 17; ++column) inside(column, row) = map(column + 5, row + 7);
  }
  const BandFilter filter(0.7, 2);
  finish(*filter.begin(map.view().part(5, 7, 17, 19)));
  EXPECT_TRUE(sameBits(map.view().part(5, 7, 17, 19), filtered(filter, inside).view()));
  for (int row = 0; row < 30; ++row) {
    for (int column = 0; column < 40; ++column) {
      const bool changed = 5 <= column && column < 22 && 7 <= row && row < 26;
      if (changed) continue;
      EXPECT_EQ(map(column, row), before(column, row)) << column << ", " << row;
    }
  }
}

TEST(BandFilter, StopsAfterASmallUnitWhenTheSliceIsOver) {
  HeightMap map = rubble(257, 257, 14);
  // In a pass, 32 units of eight rows and one of a single row, and twice 9 of at most 31 rows of all columns.
  EXPECT_EQ(finish(*BandFilter(0.9, 5).begin(map.view()), test::shortestSlice()), 5 * (33 + 2 * 9));
}

TEST(BandFilter, DoesNotAllocateOnceBegun) {
  HeightMap map = rubble(65, 65, 15);
  const auto task = BandFilter(0.9, 5).begin(map.view());
  const long before = test::allocationCount();
  finish(*task);
  EXPECT_EQ(test::allocationCount(), before);
}

TEST(BandFilter, LeavesAFlatMapAndWithKOneAnyMapAsItIs) {
  for (float height : {0.0f, 1.0f / 3.0f, -8848.86f, 3e38f}) {
    HeightMap flat(65, 65);
    for (int row = 0; row < 65; ++row) std::fill_n(flat.view().row(row), 65, height);
    EXPECT_TRUE(sameBits(filtered(BandFilter(0.9, 5), flat).view(), flat.view())) << height;
  }
  const HeightMap map = rubble(65, 65, 16);
  EXPECT_TRUE(sameBits(filtered(BandFilter(1.0, 100), map).view(), map.view()));
}

TEST(BandFilter, SpreadsAnImpulseAsThePublishedRecursionDoes) {
  HeightMap row(5, 1);
  row(2, 0) = 1.0f;
  const HeightMap result = filtered(BandFilter(0.5, 1), row);
  const float expected[] = {0.0859375f, 0.171875f, 0.34375f, 0.1875f, 0.125f};
  for (int column = 0; column < 5; ++column) EXPECT_EQ(result(column, 0), expected[column]) << column;
  HeightMap upright(1, 5);
  upright(0, 2) = 1.0f;
  const HeightMap turned = filtered(BandFilter(0.5, 1), upright);
  for (int n = 0; n < 5; ++n) EXPECT_EQ(turned(0, n), expected[n]) << n;
}

TEST(BandFilter, SpreadsAnImpulseEvenlyAndKeepsItsVolume) {
  HeightMap map(129, 129);
  map(64, 64) = 1.0f;
  const HeightMap result = filtered(BandFilter(0.9, 5), map);
  double volume = 0.0;
  for (int row = 0; row < 129; ++row) {
    for (int column = 0; column < 129; ++column) {
      const float height = result(column, row);
      volume += height;
      EXPECT_GE(height, 0.0f);
      EXPECT_NEAR(height, result(128 - column, row), 1e-6f);
      EXPECT_NEAR(height, result(column, 128 - row), 1e-6f);
      EXPECT_NEAR(height, result(row, column), 1e-6f);
    }
  }
  EXPECT_NEAR(volume, 1.0, 1e-5);
}

/// The filter in long double, in the published form.
std::vector<long double> exactly(const HeightMap& map, double k, int passes) {
  const int columns = map.columns();
  const int rows = map.rows();
  std::vector<long double> heights(map.samples().begin(), map.samples().end());
  const auto sweep = [&](int first, int count, int stride) {
    for (int n = 1; n < count; ++n) {
      const long double previous = heights[first + (n - 1) * stride];
      heights[first + n * stride] = previous * (1.0L - k) + heights[first + n * stride] * k;
    }
  };
  for (int pass = 0; pass < passes; ++pass) {
    for (int row = 0; row < rows; ++row) {
      sweep(row * columns, columns, 1);
      sweep(row * columns + columns - 1, columns, -1);
    }
    for (int column = 0; column < columns; ++column) {
      sweep(column, rows, columns);
      sweep((rows - 1) * columns + column, rows, -columns);
    }
  }
  return heights;
}

TEST(BandFilter, StaysWithinItsRoundingBoundOfExactArithmetic) {
  for (double k : {0.0625, 0.5, 0.875}) {  // those whose remainder a float holds: the rest is rounding alone
    for (int passes : {1, 5, 20}) {
      const BandFilter filter(k, passes);
      const HeightMap map = rubble(65, 65, 17);
      const HeightMap result = filtered(filter, map);
      const std::vector<long double> exact = exactly(map, k, passes);
      for (std::size_t n = 0; n < exact.size(); ++n) {
        ASSERT_LE(std::fabs(static_cast<double>(result.samples()[n] - exact[n])),
                  filter.roundingBound() * 1000.0)
            << "k " << k << ", " << passes << " passes, sample " << n;
      }
    }
  }
}

TEST(BandFilter, LeavesNoHeightOutsideItsRange) {
  const HeightRange before{.mean = 0.0, .deviation = 500.0, .min = -1000.0, .max = 1000.0};
  for (double k : {0.01, 0.5, 0.999}) {
    const BandFilter filter(k, 5);
    const HeightRange range = filter.range(before);
    EXPECT_EQ(range.mean, before.mean);
    EXPECT_LT(range.max - before.max, 4.0);
    const HeightMap result = filtered(filter, rubble(65, 65, 18));
    for (float height : result.samples()) {
      ASSERT_GE(height, range.min);
      ASSERT_LE(height, range.max);
    }
  }
}

TEST(BandFilter, KeepsTheMeanAndNeverRaisesTheDeviation) {
  constexpr int seeds = 3000;
  const BandFilter filter(0.9, 5);
  double sum = 0.0, square = 0.0, squareBefore = 0.0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const HeightMap before = faults(seed, 9);
    const HeightMap after = filtered(filter, before);
    sum += after(3, 4);
    square += static_cast<double>(after(3, 4)) * after(3, 4);
    squareBefore += static_cast<double>(before(3, 4)) * before(3, 4);
  }
  EXPECT_LT(std::fabs(sum / seeds), 4.0 / std::sqrt(seeds));
  EXPECT_LT(square, squareBefore);
}

TEST(BandFilter, ResidualBoundsWhatTheFilteredCoarseMapDrawsOfFaults) {
  const FaultFormation formation(150, 1.0);
  const std::pair<double, int> settings[] = {{0.9, 5}, {0.9, 20}, {0.5, 1}, {0.5, 5}};
  for (const auto& [k, passes] : settings) {
    const BandFilter filter(k, passes);
    for (int level = 1; level <= 4; ++level) {
      double square = 0.0;
      for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const HeightMap raw = faults(mixBits(seed), 129);
        square +=
            test::squaredError(filtered(filter, raw), filtered(filter, test::subsampled(raw, level)), level);
      }
      const double measured = std::sqrt(square / 20.0);
      const double promised = filter.residual(formation.residual(level, 129), level);
      EXPECT_LE(measured, promised) << "k " << k << ", " << passes << " passes, level " << level;
      EXPECT_GE(measured, promised / 3.0) << "k " << k << ", " << passes << " passes, level " << level;
    }
  }
  EXPECT_EQ(BandFilter(0.5, 5).residual(0.0, 0), 0.0);
}

}  // namespace
}  // namespace teren
