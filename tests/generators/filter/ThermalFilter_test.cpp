#include "generators/filter/ThermalFilter.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "generators/fault/FaultFormation.h"
#include "generators/filter/ThermalReference.h"
#include "tests/generators/filter/FilterMaps.h"
#include "tests/support/AllocationCount.h"
#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

using test::faults;
using test::finish;
using test::rubble;
using test::sameBits;

HeightMap filtered(const ThermalFilter& filter, double spacing, HeightMap map,
                   const Slice& slice = Slice::unlimited()) {
  finish(*filter.begin(spacing, map.view()), slice);
  return map;
}

double volume(const HeightMap& map) {
  double sum = 0.0;
  for (float height : map.samples()) sum += height;
  return sum;
}

/// The steepest slope between neighbours, as a tangent.
double steepest(const HeightMap& map, double spacing) {
  double slope = 0.0;
  for (int y = 0; y < map.rows(); ++y) {
    for (int x = 0; x < map.columns(); ++x) {
      for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(0, 1), std::pair(1, 1), std::pair(-1, 1)}) {
        if (x + dx < 0 || x + dx >= map.columns() || y + dy >= map.rows()) continue;
        const double difference = std::fabs(static_cast<double>(map(x + dx, y + dy)) - map(x, y));
        slope = std::max(slope, difference / (spacing * std::hypot(dx, dy)));
      }
    }
  }
  return slope;
}

TEST(ThermalFilter, EqualsThePlainVersionBitForBitWhateverTheSides) {
  const int sides[][2] = {{0, 0}, {1, 1}, {1, 9}, {9, 1}, {2, 3}, {8, 8}, {65, 65}, {33, 100}, {257, 31}};
  for (const auto& [columns, rows] : sides) {
    for (const ThermalFilter& filter :
         {ThermalFilter(33.0, 3), ThermalFilter(0.0, 2), ThermalFilter(89.0, 1)}) {
      const HeightMap map = rubble(columns, rows, 31);
      HeightMap plain = map;
      thermalReference(filter, 10.0, plain.view());
      EXPECT_TRUE(sameBits(filtered(filter, 10.0, map).view(), plain.view())) << columns << " x " << rows;
    }
  }
}

TEST(ThermalFilter, DoesNotDependOnSlicing) {
  for (int side : {1, 3, 65, 257}) {
    const HeightMap map = rubble(side, side, 32);
    const ThermalFilter filter(33.0, 3);
    EXPECT_TRUE(
        sameBits(filtered(filter, 2.0, map, test::shortestSlice()).view(), filtered(filter, 2.0, map).view()))
        << side;
  }
}

TEST(ThermalFilter, StopsAfterEveryRowWhenTheSliceIsOver) {
  HeightMap map = rubble(65, 33, 33);
  EXPECT_EQ(finish(*ThermalFilter(33.0, 4).begin(2.0, map.view()), test::shortestSlice()), 4 * 33);
}

TEST(ThermalFilter, DoesNotAllocateOnceBegun) {
  HeightMap map = rubble(65, 65, 34);
  const auto task = ThermalFilter(33.0, 4).begin(2.0, map.view());
  const long before = test::allocationCount();
  finish(*task);
  EXPECT_EQ(test::allocationCount(), before);
}

TEST(ThermalFilter, ChangesNothingOutsideAView) {
  HeightMap map = rubble(40, 30, 35);
  const HeightMap before = map;
  finish(*ThermalFilter(10.0, 3).begin(1.0, map.view().part(5, 7, 17, 19)));
  for (int row = 0; row < 30; ++row) {
    for (int column = 0; column < 40; ++column) {
      const bool inside = 5 <= column && column < 22 && 7 <= row && row < 26;
      if (inside) continue;
      EXPECT_EQ(map(column, row), before(column, row)) << column << ", " << row;
    }
  }
}

TEST(ThermalFilter, LeavesWhatIsNotSteeperThanTheTalusAngle) {
  // At 45 degrees and 4 m, 4 m may stay beside a sample and 5.65 m on its diagonal.
  HeightMap map(9, 9);
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) map(x, y) = static_cast<float>(4 * x);
  }
  EXPECT_TRUE(sameBits(filtered(ThermalFilter(45.0, 50), 4.0, map).view(), map.view()));
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) map(x, y) = static_cast<float>(2.8 * (x + y));
  }
  EXPECT_TRUE(sameBits(filtered(ThermalFilter(45.0, 50), 4.0, map).view(), map.view()));
  EXPECT_FALSE(sameBits(filtered(ThermalFilter(44.0, 1), 4.0, map).view(), map.view()));
  EXPECT_FALSE(sameBits(filtered(ThermalFilter(45.0, 1), 3.9, map).view(), map.view()));
}

TEST(ThermalFilter, MovesAnEighthOfTheExcessToEachOfEightNeighbours) {
  HeightMap map(5, 5);
  map(2, 2) = 100.0f;
  const HeightMap result = filtered(ThermalFilter(45.0, 1), 10.0, map);
  const float straight = 90.0f / 8, diagonal = (100.0f - static_cast<float>(10.0 * std::sqrt(2.0))) / 8;
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) {
      const int squared = dx * dx + dy * dy;
      const float expected = squared == 0   ? 100.0f - 4 * straight - 4 * diagonal
                             : squared == 1 ? straight
                             : squared == 2 ? diagonal
                                            : 0.0f;
      EXPECT_FLOAT_EQ(result(2 + dx, 2 + dy), expected) << dx << ", " << dy;
    }
  }
}

TEST(ThermalFilter, MirrorsWithTheMap) {
  const HeightMap map = rubble(31, 17, 36);
  HeightMap mirrored(31, 17), negative(31, 17);
  for (int y = 0; y < 17; ++y) {
    for (int x = 0; x < 31; ++x) {
      mirrored(30 - x, 16 - y) = map(x, y);
      negative(x, y) = -map(x, y);
    }
  }
  const ThermalFilter filter(33.0, 10);
  const HeightMap result = filtered(filter, 2.0, map), other = filtered(filter, 2.0, mirrored);
  const HeightMap below = filtered(filter, 2.0, negative);
  for (int y = 0; y < 17; ++y) {
    for (int x = 0; x < 31; ++x) {
      ASSERT_EQ(result(x, y), other(30 - x, 16 - y));
      ASSERT_EQ(result(x, y), -below(x, y));
    }
  }
}

TEST(ThermalFilter, KeepsTheVolumeToRounding) {
  for (const ThermalFilter& filter :
       {ThermalFilter(33.0, 1), ThermalFilter(33.0, 200), ThermalFilter(0.0, 50)}) {
    for (const auto& [columns, rows] : {std::pair(257, 257), std::pair(65, 1), std::pair(30, 40)}) {
      const HeightMap map = rubble(columns, rows, 37);
      const double change = std::fabs(volume(filtered(filter, 2.0, map)) - volume(map));
      const double samples = columns * rows;
      EXPECT_LE(change, samples * 1000.0 * filter.roundingBound());
      EXPECT_LE(change, std::sqrt(samples) * 1000.0 * filter.roundingBound()) << "roundings go one way";
    }
  }
}

TEST(ThermalFilter, LeavesNoHeightOutsideItsRange) {
  const HeightRange before{.mean = 300.0, .deviation = 500.0, .min = -1000.0, .max = 1000.0};
  for (const ThermalFilter& filter : {ThermalFilter(33.0, 30), ThermalFilter(0.0, 200)}) {
    const HeightRange range = filter.range(before);
    EXPECT_EQ(range.mean, before.mean);
    EXPECT_EQ(range.deviation, before.deviation);
    EXPECT_LT(range.max, 1000.2);
    HeightMap map(65, 65);
    for (int y = 0; y < 65; ++y) {
      for (int x = 0; x < 65; ++x) map(x, y) = ((x + y) & 1) == 0 ? 1000.0f : -1000.0f;
    }
    for (const HeightMap& result : {filtered(filter, 0.1, map), filtered(filter, 0.1, rubble(65, 65, 38))}) {
      for (float height : result.samples()) {
        ASSERT_GE(height, range.min);
        ASSERT_LE(height, range.max);
      }
    }
  }
}

TEST(ThermalFilter, BringsSlopesToTheTalusAngle) {
  const HeightMap map = faults(3, 65, 10.0);
  ASSERT_GT(steepest(map, 2.0), 1.5);
  double last = steepest(map, 2.0);
  for (int passes : {10, 100, 1000}) {
    const double slope = steepest(filtered(ThermalFilter(30.0, passes), 2.0, map), 2.0);
    EXPECT_LT(slope, last) << passes << " passes";
    last = slope;
  }
  EXPECT_LT(last, 1.1 * std::sqrt(1.0 / 3.0));
}

TEST(ThermalFilter, SquaredHeightsOnlyShrink) {
  HeightMap map = faults(4, 65, 40.0);
  const auto squares = [](const HeightMap& heights) {
    double sum = 0.0;
    for (float height : heights.samples()) sum += static_cast<double>(height) * height;
    return sum;
  };
  for (int pass = 0; pass < 20; ++pass) {
    const HeightMap next = filtered(ThermalFilter(20.0, 1), 2.0, map);
    ASSERT_LT(squares(next), squares(map)) << pass;
    map = next;
  }
}

TEST(ThermalFilter, ResidualBoundsWhatTheFilteredCoarseMapDrawsOfFaults) {
  const FaultFormation formation(150, 40.0);
  for (const ThermalFilter& filter :
       {ThermalFilter(33.0, 1), ThermalFilter(33.0, 20), ThermalFilter(10.0, 20), ThermalFilter(0.0, 5)}) {
    for (int level = 1; level <= 3; ++level) {
      double square = 0.0;
      for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const HeightMap raw = faults(mixBits(seed), 257, 40.0);
        square +=
            test::squaredError(filtered(filter, 2.0, raw),
                               filtered(filter, 2.0 * (1 << level), test::subsampled(raw, level)), level);
      }
      const double measured = std::sqrt(square / 20.0);
      const double promised = filter.residual(formation.residual(level, 257), level);
      EXPECT_LE(measured, promised) << filter.passes() << " passes, level " << level;
      EXPECT_GE(measured, promised / 4.5) << filter.passes() << " passes, level " << level;
    }
  }
  EXPECT_EQ(ThermalFilter(33.0, 20).residual(0.0, 0), 0.0);
}

}  // namespace
}  // namespace teren
