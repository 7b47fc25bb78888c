#include "generators/filter/MatrixFilter.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "generators/fault/FaultFormation.h"
#include "generators/filter/BandFilter.h"
#include "generators/filter/MatrixReference.h"
#include "tests/generators/filter/FilterMaps.h"
#include "tests/support/AllocationCount.h"
#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

using test::faults;
using test::finish;
using test::rubble;
using test::sameBits;

constexpr const char* kSmooth = "1 2 1; 2 4 2; 1 2 1";
constexpr const char* kSharp = "0 -1 0; -1 5 -1; 0 -1 0";
constexpr const char* kWide = "1 4 6 4 1; 4 16 24 16 4; 6 24 36 24 6; 4 16 24 16 4; 1 4 6 4 1";
constexpr const char* kSlanted = "0 0 1; 0 2 0; 0.25 0 0";

MatrixFilter filterOf(const std::string& matrix, int passes = 1) {
  return MatrixFilter::make(FilterMatrix::parse(matrix).value(), passes).value();
}

/// All ones.
std::string box(int side) {
  std::string rows;
  for (int n = 0; n < side * side; ++n) rows += n % side == 0 && n > 0 ? "; 1" : " 1";
  return rows;
}

/// Weights that fall off from the middle and are never the same, some of them negative.
MatrixFilter oddFilter(int side, int passes) {
  std::vector<double> elements;
  RandomSequence random(static_cast<std::uint64_t>(side));
  for (int n = 0; n < side * side; ++n)
    elements.push_back(static_cast<double>(random.nextBits(16)) / 65536.0 - 0.1);
  elements[elements.size() / 2] += side;
  return MatrixFilter::make(FilterMatrix::make(side, elements).value(), passes).value();
}

HeightMap filtered(const MatrixFilter& filter, HeightMap map, const Slice& slice = Slice::unlimited()) {
  finish(*filter.begin(map.view()), slice);
  return map;
}

TEST(MatrixFilter, EqualsThePlainVersionBitForBitWhateverTheSides) {
  const int sides[][2] = {{0, 0}, {1, 1},   {1, 9},    {9, 1},   {2, 3},
                          {8, 8}, {65, 65}, {33, 100}, {600, 5}, {257, 31}};
  for (const auto& [columns, rows] : sides) {
    for (const MatrixFilter& filter : {filterOf(kSmooth, 3), filterOf(kSharp, 2), filterOf(kWide),
                                       oddFilter(1, 1), oddFilter(5, 2), oddFilter(7, 2), oddFilter(31, 1)}) {
      const HeightMap map = rubble(columns, rows, 21);
      HeightMap plain = map;
      matrixReference(filter, plain.view());
      EXPECT_TRUE(sameBits(filtered(filter, map).view(), plain.view()))
          << columns << " x " << rows << ", matrix of side " << filter.matrix().side();
    }
  }
}

TEST(MatrixFilter, DoesNotDependOnSlicing) {
  for (const MatrixFilter& filter : {filterOf(kSmooth, 2), oddFilter(31, 1)}) {
    for (int side : {1, 3, 65, 300}) {
      const HeightMap map = rubble(side, side, 22);
      const HeightMap whole = filtered(filter, map);
      EXPECT_TRUE(sameBits(filtered(filter, map, test::shortestSlice()).view(), whole.view())) << side;
    }
  }
}

TEST(MatrixFilter, ChangesNothingOutsideAView) {
  HeightMap map = rubble(40, 30, 23);
  const HeightMap before = map;
  HeightMap inside(17, 19);
  for (int row = 0; row < 19; ++row) {
    for (int column = 0; column < 17; ++column) inside(column, row) = map(column + 5, row + 7);
  }
  const MatrixFilter filter = oddFilter(5, 2);
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

TEST(MatrixFilter, StopsAfterASmallUnitWhenTheSliceIsOver) {
  HeightMap map = rubble(300, 300, 24);
  // A unit is a block of at most 256 columns of one row, as long as it has fewer than 8192 products or so.
  EXPECT_EQ(finish(*filterOf(kSmooth, 2).begin(map.view()), test::shortestSlice()), 2 * 300 * 2);
  // Rows of a matrix of side 31 have 31 * 256 products, so two make a unit of the first block: 16 units,
  // fewer at the rims; 31 * 44 products in the second block, so seven make a unit: 5.
  const int steps = finish(*oddFilter(31, 1).begin(map.view()), test::shortestSlice());
  EXPECT_LE(steps, 300 * (16 + 5));
  EXPECT_GE(steps, 270 * (16 + 5));
}

TEST(MatrixFilter, DoesNotAllocateOnceBegun) {
  HeightMap map = rubble(65, 65, 25);
  const auto task = filterOf(kWide, 5).begin(map.view());
  const long before = test::allocationCount();
  finish(*task);
  EXPECT_EQ(test::allocationCount(), before);
}

TEST(MatrixFilter, LeavesAFlatMapAndWithASingleElementAnyMapAsItIs) {
  for (float height : {0.0f, 1.0f / 3.0f, -8848.86f, 3e38f}) {
    HeightMap flat(65, 65);
    for (int row = 0; row < 65; ++row) std::fill_n(flat.view().row(row), 65, height);
    for (const MatrixFilter& filter :
         {filterOf(kSmooth, 5), filterOf(kSharp, 2), filterOf(box(7)), oddFilter(9, 3)}) {
      EXPECT_TRUE(sameBits(filtered(filter, flat).view(), flat.view()))
          << height << ", matrix of side " << filter.matrix().side();
    }
  }
  const HeightMap map = rubble(65, 65, 26);
  EXPECT_TRUE(sameBits(filtered(filterOf("-0.3", 100), map).view(), map.view()));
  EXPECT_TRUE(sameBits(filtered(filterOf("0 0 0; 0 7 0; 0 0 0", 3), map).view(), map.view()));
}

TEST(MatrixFilter, WeighsEachNeighbourAsItsElementIsWritten) {
  HeightMap map(5, 5);
  map(2, 2) = 120.0f;
  // Row 1 is the northern one: what its element weighs is taken from the sample to the north, so the impulse
  // appears south of it.
  const HeightMap result = filtered(filterOf("1 2 3; 4 5 6; 7 8 1"), map);  // the sum is 37
  const double elements[3][3] = {{1, 2, 3}, {4, 5, 6}, {7, 8, 1}};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const float expected = static_cast<float>(120.0 * elements[row][column] * (1.0 / 37.0));
      EXPECT_EQ(result(2 - (column - 1), 2 + (row - 1)), expected) << row << ", " << column;
    }
  }
}

TEST(MatrixFilter, DividesAtTheRimsByTheSumOfTheElementsThatAreThere) {
  HeightMap map(4, 3);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) map(x, y) = static_cast<float>(1 + x + 10 * y);
  }
  const HeightMap result = filtered(filterOf("1 2 1; 2 4 2; 1 2 1"), map);
  const auto near = [&](int x, int y, double expected) {
    EXPECT_FLOAT_EQ(result(x, y), static_cast<float>(expected));
  };
  near(0, 0, (4 * 1 + 2 * 2 + 2 * 11 + 1 * 12) / 9.0);
  near(3, 2, (4 * 24 + 2 * 23 + 2 * 14 + 1 * 13) / 9.0);
  near(1, 0, (4 * 2 + 2 * 1 + 2 * 3 + 2 * 12 + 1 * 11 + 1 * 13) / 12.0);
  near(0, 1, (4 * 11 + 2 * 1 + 2 * 21 + 2 * 12 + 1 * 2 + 1 * 22) / 12.0);
  near(1, 1, 12.0);
}

/// The filter in long double, from the definition.
std::vector<long double> exactly(const HeightMap& map, const MatrixFilter& filter) {
  const FilterMatrix& matrix = filter.matrix();
  const int columns = map.columns(), rows = map.rows(), r = matrix.radius();
  std::vector<long double> heights(map.samples().begin(), map.samples().end());
  for (int pass = 0; pass < filter.passes(); ++pass) {
    const std::vector<long double> before = heights;
    for (int n = 0; n < columns * rows; ++n) {
      long double sum = 0.0L, weights = 0.0L;
      for (int dy = -r; dy <= r; ++dy) {
        for (int dx = -r; dx <= r; ++dx) {
          const int x = n % columns + dx, y = n / columns + dy;
          if (x < 0 || y < 0 || x >= columns || y >= rows) continue;
          sum += matrix(r - dy, r + dx) * before[static_cast<std::size_t>(y * columns + x)];
          weights += matrix(r - dy, r + dx);
        }
      }
      heights[static_cast<std::size_t>(n)] = sum / weights;
    }
  }
  return heights;
}

TEST(MatrixFilter, StaysWithinItsRoundingBoundOfExactArithmetic) {
  for (const MatrixFilter& filter :
       {filterOf(kSmooth), filterOf(kSmooth, 20), filterOf(kSharp, 5), filterOf(kWide, 2), oddFilter(7, 4),
        oddFilter(31, 1), filterOf(kSlanted, 7)}) {
    const HeightMap map = rubble(65, 40, 27);
    const HeightMap result = filtered(filter, map);
    const std::vector<long double> exact = exactly(map, filter);
    for (std::size_t n = 0; n < exact.size(); ++n) {
      ASSERT_LE(std::fabs(static_cast<double>(result.samples()[n] - exact[n])),
                filter.roundingBound() * 1000.0)
          << "side " << filter.matrix().side() << ", " << filter.passes() << " passes, sample " << n;
    }
  }
}

TEST(MatrixFilter, LeavesNoHeightOutsideItsRangeWhichASteppedMapReaches) {
  const HeightRange before{.mean = 300.0, .deviation = 500.0, .min = -1000.0, .max = 1000.0};
  for (const MatrixFilter& filter :
       {filterOf(kSmooth, 5), filterOf(kSharp), filterOf(kSharp, 4), oddFilter(5, 3)}) {
    const HeightRange range = filter.range(before);
    EXPECT_EQ(range.mean, before.mean);
    HeightMap map = rubble(65, 65, 28);
    for (int y = 0; y < 33; ++y) {
      for (int x = 0; x < 65; ++x) map(x, y) = (x + y) % 2 == 0 ? 1000.0f : -1000.0f;
    }
    const HeightMap result = filtered(filter, map);
    for (float height : result.samples()) {
      ASSERT_GE(height, range.min);
      ASSERT_LE(height, range.max);
    }
  }
  HeightMap chequered(9, 9);
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) chequered(x, y) = (x + y) % 2 == 0 ? 1000.0f : -1000.0f;
  }
  const HeightMap sharpest = filtered(filterOf(kSharp), chequered);
  EXPECT_EQ(sharpest(4, 4), 9000.0f);
  EXPECT_NEAR(filterOf(kSharp).range(before).max, 9000.0, 0.1) << "the range is not sharp";
}

TEST(MatrixFilter, KeepsTheMeanAndRaisesTheDeviationAtMostAsItSays) {
  constexpr int seeds = 3000;
  for (const MatrixFilter& filter : {filterOf(kSmooth, 2), filterOf(kSharp), filterOf(kSlanted)}) {
    double sum = 0.0, square = 0.0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const float height = filtered(filter, faults(seed, 9))(3, 0);
      sum += height;
      square += static_cast<double>(height) * height;
    }
    const double promised = filter.range({.mean = 0.0, .deviation = 1.0, .min = -5.0, .max = 5.0}).deviation;
    const double measured = std::sqrt(square / seeds);
    EXPECT_LT(std::fabs(sum / seeds), 4.0 * measured / std::sqrt(seeds));
    EXPECT_LT(measured, 1.05 * promised);
  }
  EXPECT_EQ(filterOf(kSmooth, 9).range({.mean = 0.0, .deviation = 3.0, .min = -5.0, .max = 5.0}).deviation,
            3.0);
}

TEST(MatrixFilter, ResidualBoundsWhatTheFilteredCoarseMapDrawsOfFaults) {
  const FaultFormation formation(150, 1.0);
  for (const MatrixFilter& filter :
       {filterOf(kSmooth), filterOf(kSmooth, 5), filterOf(kWide), filterOf(box(3), 2), filterOf(box(7)),
        filterOf(kSlanted), filterOf(kSharp)}) {
    for (int level = 1; level <= 3; ++level) {
      double square = 0.0;
      for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const HeightMap raw = faults(mixBits(seed), 257);
        square +=
            test::squaredError(filtered(filter, raw), filtered(filter, test::subsampled(raw, level)), level);
      }
      const double measured = std::sqrt(square / 20.0);
      const double promised = filter.residual(formation.residual(level, 257), level);
      EXPECT_LE(measured, promised) << "side " << filter.matrix().side() << ", " << filter.passes()
                                    << " passes, level " << level;
      EXPECT_GE(measured, promised / 3.5)
          << "side " << filter.matrix().side() << ", " << filter.passes() << " passes, level " << level;
    }
  }
  EXPECT_EQ(filterOf(kSmooth).residual(0.0, 0), 0.0);
  EXPECT_EQ(filterOf("1", 5).residual(2.5, 3), 2.5);
}

TEST(MatrixFilter, ResidualBoundsAlsoWhatFollowsAnotherFilter) {
  const FaultFormation formation(150, 1.0);
  const MatrixFilter first = filterOf(kWide, 3);
  const BandFilter band(0.9, 5);
  const auto both = [&](HeightMap map) {
    finish(*band.begin(map.view()));
    return filtered(first, std::move(map));
  };
  for (int level = 1; level <= 3; ++level) {
    double square = 0.0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const HeightMap raw = faults(mixBits(seed), 257);
      square += test::squaredError(both(raw), both(test::subsampled(raw, level)), level);
    }
    const double before = band.residual(formation.residual(level, 257), level);
    EXPECT_LE(std::sqrt(square / 20.0), first.residual(before, level)) << "level " << level;
  }
}

TEST(MatrixFilter, RefusesPassesThatMagnifyWithoutEnd) {
  const FilterMatrix sharp = FilterMatrix::parse(kSharp).value();  // gain 9
  EXPECT_TRUE(MatrixFilter::make(sharp, 6).ok());
  EXPECT_EQ(MatrixFilter::make(sharp, 7).error().message,
            "its matrix would magnify heights more than a million times in 7 passes");
  EXPECT_EQ(MatrixFilter::make(sharp, 0).error().message, "passes is 0, expected 1 to 100");
  EXPECT_FALSE(MatrixFilter::make(sharp, 101).ok());
}

}  // namespace
}  // namespace teren
