#include "generators/fault/FaultFormation.h"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "generators/fault/FaultLine.h"
#include "generators/fault/FaultReference.h"
#include "tests/support/AllocationCount.h"
#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

using test::finish;
using test::sameBits;

MapRequest requestOf(std::uint64_t seed, int samples) {
  return {.seed = seed, .samples = samples};
}

HeightMap made(const FaultFormation& formation, std::uint64_t seed, int samples,
               const Slice& slice = Slice::unlimited()) {
  HeightMap map(samples, samples);
  finish(*formation.begin(requestOf(seed, samples), map.view()), slice);
  return map;
}

HeightMap plain(const FaultFormation& formation, std::uint64_t seed, int samples) {
  HeightMap map(samples, samples);
  faultReference(formation, requestOf(seed, samples), map.view());
  return map;
}

void expectPlainBits(const FaultFormation& formation, std::uint64_t seed, int samples) {
  EXPECT_TRUE(sameBits(made(formation, seed, samples).view(), plain(formation, seed, samples).view()))
      << formation.faults() << " faults, seed " << seed << ", " << samples << " samples";
}

/// The first `count` seeds whose first line is as wanted.
std::vector<std::uint64_t> seedsWhere(const std::function<bool(const FaultLine&)>& wanted, int count) {
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t seed = 0; seeds.size() < static_cast<std::size_t>(count); ++seed) {
    RandomSequence random(seed);
    if (wanted(drawFaultLine(random, 1))) seeds.push_back(seed);
  }
  return seeds;
}

TEST(FaultFormation, EqualsThePlainVersionBitForBitAtEverySide) {
  const FaultFormation formation(150, 4.0);
  for (int samples : {1, 2, 3, 5, 9, 17, 33, 65, 129}) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) expectPlainBits(formation, seed, samples);
  }
  expectPlainBits(formation, 42, 257);
  expectPlainBits(formation, 43, 1025);
}

TEST(FaultFormation, EqualsThePlainVersionForAnyNumberOfFaults) {
  for (int faults : {1, 2, 31, 32, 33, 64, 255, 256, 257, 1000}) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) expectPlainBits(FaultFormation(faults, 1.0), seed, 65);
  }
  expectPlainBits(FaultFormation(FaultFormation::kMaxFaults, 1.0), 7, 33);
}

TEST(FaultFormation, EqualsThePlainVersionForHostileSeeds) {
  for (std::uint64_t seed : {0ULL, ~0ULL, 1ULL << 63, 0x9e3779b97f4a7c15ULL, 0x61c8864680b583ebULL}) {
    for (int samples : {1, 3, 65}) expectPlainBits(FaultFormation(150, 4.0), seed, samples);
  }
}

TEST(FaultFormation, EqualsThePlainVersionForLinesAlongTheAxes) {
  const std::function<bool(const FaultLine&)> directions[] = {
      [](const FaultLine& line) { return line.ay == line.by && line.ax < line.bx; },
      [](const FaultLine& line) { return line.ay == line.by && line.ax > line.bx; },
      [](const FaultLine& line) { return line.ax == line.bx && line.ay < line.by; },
      [](const FaultLine& line) { return line.ax == line.bx && line.ay > line.by; },
  };
  for (const auto& direction : directions) {
    for (std::uint64_t seed : seedsWhere(direction, 2)) {
      for (int samples : {1, 2, 3, 33, 257}) expectPlainBits(FaultFormation(1, 1.0), seed, samples);
    }
  }
}

TEST(FaultFormation, EqualsThePlainVersionForSteepAndForShortLines) {
  const auto steep = [](const FaultLine& line) { return std::abs(line.bx - line.ax) == 1; };
  const auto flat = [](const FaultLine& line) { return std::abs(line.by - line.ay) == 1; };
  const auto shortLine = [](const FaultLine& line) {
    return std::abs(line.by - line.ay) < 1024 && std::abs(line.bx - line.ax) < 1024;
  };
  for (const auto wanted : {+steep, +flat, +shortLine}) {
    for (std::uint64_t seed : seedsWhere(wanted, 4)) {
      for (int samples : {3, 33, 257}) expectPlainBits(FaultFormation(1, 1.0), seed, samples);
    }
  }
}

// A sample exactly on a line decides whether stepping is exact: a row too early or too late shows there only.
TEST(FaultFormation, EqualsThePlainVersionWhereLinesEndOnSamples) {
  constexpr int samples = 2049;
  constexpr std::int64_t step = kFaultUnits / (samples - 1);
  for (int east : {-1, 1}) {
    for (int north : {-1, 1}) {
      const auto wanted = [&](const FaultLine& line) {
        const bool direction = (line.bx - line.ax) * east > 0 && (line.by - line.ay) * north > 0;
        return direction && line.ax % step == 0 && line.ay % step == 0;
      };
      for (std::uint64_t seed : seedsWhere(wanted, 2)) {
        const FaultFormation formation(1, 1.0);
        RandomSequence random(seed);
        const FaultLine line = drawFaultLine(random, 1);
        const HeightMap map = made(formation, seed, samples);
        EXPECT_EQ(map(static_cast<int>(line.ax / step), static_cast<int>(line.ay / step)), -line.left);
        EXPECT_TRUE(sameBits(map.view(), plain(formation, seed, samples).view())) << "seed " << seed;
      }
    }
  }
}

TEST(FaultFormation, EveryLevelIsTheSubsampledFinestMap) {
  for (int faults : {1, 150}) {
    const FaultFormation formation(faults, 4.0);
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const HeightMap finest = made(formation, seed, 257);
      for (int level = 1; level <= 9; ++level) {
        const HeightMap coarse = test::subsampled(finest, level);
        const HeightMap direct = made(formation, seed, coarse.columns());
        EXPECT_TRUE(sameBits(direct.view(), coarse.view())) << "level " << level << ", seed " << seed;
      }
    }
  }
}

TEST(FaultFormation, DoesNotDependOnSlicing) {
  for (int faults : {1, 33, 600}) {
    const FaultFormation formation(faults, 4.0);
    for (int samples : {1, 3, 65}) {
      const HeightMap whole = made(formation, 5, samples);
      EXPECT_TRUE(sameBits(made(formation, 5, samples, test::shortestSlice()).view(), whole.view()))
          << faults << " faults, " << samples << " samples";
    }
  }
}

TEST(FaultFormation, StopsAfterASmallUnitWhenTheSliceIsOver) {
  const FaultFormation formation(600, 4.0);
  HeightMap map(257, 257);
  // 19 units of lines and, in each of 9 tiles, 3 of crossings and 1 of sums.
  EXPECT_EQ(finish(*formation.begin(requestOf(1, 257), map.view()), test::shortestSlice()), 19 + 9 * 4);
}

TEST(FaultFormation, DoesNotAllocateOnceBegun) {
  const FaultFormation formation(600, 4.0);
  for (int samples : {1, 65}) {
    HeightMap map(samples, samples);
    const auto task = formation.begin(requestOf(1, samples), map.view());
    const long before = test::allocationCount();
    finish(*task, test::shortestSlice());
    EXPECT_EQ(test::allocationCount(), before);
  }
}

TEST(FaultFormation, HasMeanZeroAndItsDeviationAtEveryPoint) {
  constexpr int seeds = 8000;
  constexpr double deviation = 4.0;
  for (int faults : {1, 5, 150}) {
    const FaultFormation formation(faults, deviation);
    std::vector<double> sums(25), squares(25);
    HeightMap map(5, 5);
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      finish(*formation.begin(requestOf(mixBits(seed), 5), map.view()));
      for (std::size_t n = 0; n < 25; ++n) {
        const double height = map.samples()[n];
        sums[n] += height;
        squares[n] += height * height;
      }
    }
    for (std::size_t n = 0; n < 25; ++n) {
      EXPECT_LT(std::fabs(sums[n] / seeds), 4.0 * deviation / std::sqrt(seeds)) << "sample " << n;
      EXPECT_NEAR(std::sqrt(squares[n] / seeds), deviation, 0.03 * deviation) << "sample " << n;
    }
  }
}

TEST(FaultFormation, OneFaultMovesItsSidesByTheDeviation) {
  const HeightMap map = made(FaultFormation(1, 2.5), 3, 65);
  for (float height : map.samples()) EXPECT_EQ(std::fabs(height), 2.5f);
}

TEST(FaultFormation, PromisesARangeThatNoSumLeavesAndOneFaultReaches) {
  const HeightRange one = FaultFormation(1, 2.5).range();
  EXPECT_EQ(one.max, 2.5);
  for (int faults : {3, 150, FaultFormation::kMaxFaults}) {
    const FaultFormation formation(faults, 2.5);
    const HeightRange range = formation.range();
    EXPECT_EQ(range.mean, 0.0);
    EXPECT_EQ(range.deviation, 2.5);
    EXPECT_EQ(range.min, -range.max);
    const std::int64_t n = faults;
    const double all = formation.metresPerStep() * static_cast<double>(n * (n + 1) / 2);
    EXPECT_EQ(range.max, static_cast<float>(all));
  }
}

TEST(FaultFormation, ResidualIsWithinAFactorOfWhatIsMeasured) {
  const FaultFormation formation(150, 3.0);
  EXPECT_EQ(formation.residual(0, 257), 0.0);
  for (int samples : {17, 65, 257}) {
    constexpr int seeds = 40;
    std::vector<double> squares(10);
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const HeightMap finest = made(formation, mixBits(seed), samples);
      test::addSquaredErrors(finest, seeds, squares);
    }
    for (int level = 1; (samples - 1) >> level >= 2; ++level) {
      const double ratio = formation.residual(level, samples) / std::sqrt(squares[level]);
      EXPECT_GT(ratio, 1.0 / 1.5) << samples << " samples, level " << level;
      EXPECT_LT(ratio, 1.5) << samples << " samples, level " << level;
      RecordProperty("residual_" + std::to_string(samples) + "_" + std::to_string(level),
                     std::to_string(ratio));
    }
    EXPECT_NEAR(formation.residual(40, samples) / std::sqrt(squares[0]), 1.0, 0.25) << "the centre alone";
  }
}

}  // namespace
}  // namespace teren
