#include "generators/steps/Staircase.h"

#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "tests/support/AllocationCount.h"
#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

using test::finish;
using test::sameBits;

HeightMap made(const Staircase& staircase, std::uint64_t seed, int samples) {
  HeightMap map(samples, samples);
  finish(*staircase.begin({.seed = seed, .samples = samples}, map.view()));
  return map;
}

TEST(Staircase, ClimbsAndFallsByOneStepAtTheEndOfEveryTerrace) {
  const Staircase staircase(2.0, 3, 8);
  std::set<float> heights;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const HeightMap map = made(staircase, seed, 257);  // a terrace is 32 intervals wide
    int edge = 1;
    while (map(edge, 0) == map(edge - 1, 0)) ++edge;
    for (int column = 1; column < 257; ++column) {
      const float step = std::fabs(map(column, 9) - map(column - 1, 9));
      EXPECT_TRUE(step == 0.0f || (step == 2.0f && (column - edge) % 32 == 0)) << step << " at " << column;
      EXPECT_EQ(map(column, 0), map(column, 256));
    }
    heights.insert(map.samples().begin(), map.samples().end());
  }
  EXPECT_EQ(heights, (std::set<float>{-3.0f, -1.0f, 1.0f, 3.0f}));
}

TEST(Staircase, EveryLevelIsTheSubsampledFinestMap) {
  for (const Staircase& staircase : {Staircase(2.0, 3, 12), Staircase(0.1, 63, 4096), Staircase(1.0, 1, 7)}) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const HeightMap finest = made(staircase, seed, 257);
      for (int level = 1; level <= 9; ++level) {
        const HeightMap coarse = test::subsampled(finest, level);
        EXPECT_TRUE(sameBits(made(staircase, seed, coarse.columns()).view(), coarse.view())) << level;
      }
    }
  }
}

TEST(Staircase, HasItsMeanAndDeviationAtEverySample) {
  constexpr int seeds = 8000;
  for (const Staircase& staircase : {Staircase(2.0, 3, 12), Staircase(5.0, 1, 1), Staircase(1.0, 10, 33)}) {
    const HeightRange range = staircase.range();
    std::vector<double> sums(17), squares(17);
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const HeightMap map = made(staircase, mixBits(seed), 17);
      for (int column = 0; column < 17; ++column) {
        const double height = map(column, 5);
        ASSERT_LE(range.min, height);
        ASSERT_LE(height, range.max);
        sums[static_cast<std::size_t>(column)] += height;
        squares[static_cast<std::size_t>(column)] += height * height;
      }
    }
    for (std::size_t column = 0; column < 17; ++column) {
      EXPECT_LT(std::fabs(sums[column] / seeds), 4.0 * range.deviation / std::sqrt(seeds)) << column;
      EXPECT_NEAR(std::sqrt(squares[column] / seeds), range.deviation, 0.03 * range.deviation) << column;
    }
  }
}

TEST(Staircase, ResidualIsWhatLevelsGetWrong) {
  constexpr int seeds = 400, samples = 65;
  for (const Staircase& staircase : {Staircase(2.0, 3, 12), Staircase(5.0, 1, 1), Staircase(1.0, 10, 33)}) {
    EXPECT_EQ(staircase.residual(0, samples), 0.0);
    for (int level = 1; level <= 6; ++level) {
      double square = 0.0;
      for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        const HeightMap finest = made(staircase, mixBits(seed), samples);
        if (level < 6) {
          square += test::squaredError(finest, test::subsampled(finest, level), level);
          continue;
        }
        for (int column = 0; column < samples; ++column) {
          const double error = finest(column, 0) - finest(samples / 2, 0);
          square += error * error / samples;
        }
      }
      const double measured = std::sqrt(square / seeds);
      EXPECT_NEAR(staircase.residual(level, samples), measured, 0.08 * measured) << "level " << level;
    }
  }
}

TEST(Staircase, ResidualIsExactWhereEveryShiftIsTried) {
  // One step up, one terrace a map, so half of all maps have an edge; wherever it is, one sample of five lies
  // between the level's, and half a step off the segment.
  EXPECT_NEAR(Staircase(8.0, 1, 1).residual(1, 5), std::sqrt(0.5 * 16.0 / 5.0), 1e-12);
}

TEST(Staircase, DoesNotAllocateOnceBegun) {
  HeightMap map(65, 65);
  const auto task = Staircase(2.0, 3, 12).begin({.samples = 65}, map.view());
  const long before = test::allocationCount();
  finish(*task, test::shortestSlice());
  EXPECT_EQ(test::allocationCount(), before);
}

}  // namespace
}  // namespace teren
