#include "generators/circles/Circles.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "generators/circles/CirclesReference.h"
#include "tests/support/AllocationCount.h"
#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

using test::finish;
using test::sameBits;

HeightMap made(const Circles& circles, std::uint64_t seed, int samples,
               const Slice& slice = Slice::unlimited()) {
  HeightMap map(samples, samples);
  finish(*circles.begin({.seed = seed, .samples = samples}, map.view()), slice);
  return map;
}

HeightMap plain(const Circles& circles, std::uint64_t seed, int samples) {
  HeightMap map(samples, samples);
  circlesReference(circles, {.seed = seed, .samples = samples}, map.view());
  return map;
}

/// Few and many, large and small, all alike and very different.
std::vector<Circles> variety() {
  return {Circles(1000, 4.0, 0.5, 0.1), Circles(1, 1.0, 1.0, 1.0), Circles(40, 2.0, 1.0, 0.01),
          Circles(200, 1e6, 0.01, 0.01), Circles(65, 0.5, 0.3, 0.9)};
}

TEST(DiscProfile, LiesWithinItsErrorOfTheCosine) {
  constexpr long double pi = 3.14159265358979323846L;
  double worst = 0.0;
  for (int n = -1000; n <= 1 << 20; ++n) {
    const float t = static_cast<float>(n) * 0x1p-20f;
    const long double distance = std::sqrt(1.0L - static_cast<long double>(t));
    const long double exact = t > 0.0f ? (1.0L + std::cos(pi * distance)) / 2.0L : 0.0L;
    worst = std::max(worst, static_cast<double>(std::fabs(discProfile(t) - exact)));
  }
  EXPECT_LT(worst, 0.7 * kDiscProfileError);  // the rest is for the rounding of t
  EXPECT_GT(worst, 0.1 * kDiscProfileError);
  EXPECT_EQ(discProfile(0.0f), 0.0f);
  EXPECT_EQ(discProfile(-1e30f), 0.0f);
}

TEST(Circles, EqualThePlainVersionBitForBitAtEverySide) {
  for (const Circles& circles : variety()) {
    for (int samples : {1, 2, 3, 5, 9, 17, 33, 65}) {
      for (std::uint64_t seed = 0; seed < 4; ++seed) {
        EXPECT_TRUE(sameBits(made(circles, seed, samples).view(), plain(circles, seed, samples).view()))
            << circles.discs() << " discs, seed " << seed << ", " << samples << " samples";
      }
    }
  }
  EXPECT_TRUE(sameBits(made(Circles(300, 4.0, 1.0, 0.01), 9, 1025).view(),
                       plain(Circles(300, 4.0, 1.0, 0.01), 9, 1025).view()));
}

// The rim of a disc that passes through samples decides whether any is left out.
TEST(Circles, EqualThePlainVersionWhereOneDiscIsAllThereIs) {
  for (double radius : {0.01, 0.03125, 0.2, 0.5, 1.0}) {
    const Circles circles(1, 1.0, radius, 1.0);
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      EXPECT_TRUE(sameBits(made(circles, seed, 129).view(), plain(circles, seed, 129).view()))
          << "radius " << radius << ", seed " << seed;
    }
  }
}

TEST(Circles, StayWithinTheirRoundingBoundOfExactSums) {
  constexpr long double pi = 3.14159265358979323846L;
  const Circles circles(1000, 4.0, 0.5, 0.1);
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const HeightMap map = made(circles, seed, 33);
    for (int row = 0; row < 33; row += 4) {
      for (int column = 0; column < 33; column += 4) {
        RandomSequence random(seed);
        long double sum = 0.0L;
        for (int n = 0; n < circles.discs(); ++n) {
          const Disc disc = circles.draw(random);
          const long double east = column * (kCircleUnits / 32) - disc.x;
          const long double north = row * (kCircleUnits / 32) - disc.y;
          const long double distance = std::sqrt(east * east + north * north) / disc.radius;
          if (distance < 1.0L) sum += disc.height * (1.0L + std::cos(pi * distance)) / 2.0L;
        }
        const double error = std::fabs(static_cast<double>(map(column, row) - sum));
        EXPECT_LE(error, circles.roundingBound());
        EXPECT_LE(error, 1e-5 * circles.range().deviation) << "far beyond what happens";
      }
    }
  }
}

TEST(Circles, EveryLevelIsTheSubsampledFinestMap) {
  for (const Circles& circles : variety()) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const HeightMap finest = made(circles, seed, 129);
      for (int level = 1; level <= 8; ++level) {
        const HeightMap coarse = test::subsampled(finest, level);
        EXPECT_TRUE(sameBits(made(circles, seed, coarse.columns()).view(), coarse.view())) << level;
      }
    }
  }
}

TEST(Circles, DoNotDependOnSlicing) {
  for (const Circles& circles : variety()) {
    for (int samples : {1, 3, 65, 257}) {
      const HeightMap whole = made(circles, 5, samples);
      EXPECT_TRUE(sameBits(made(circles, 5, samples, test::shortestSlice()).view(), whole.view()))
          << circles.discs() << " discs, " << samples << " samples";
    }
  }
}

/// How many times a disc covers a sample.
long covered(const Circles& circles, std::uint64_t seed, int samples) {
  long count = 0;
  RandomSequence random(seed);
  const std::int32_t step = kCircleUnits / (samples - 1);
  for (int n = 0; n < circles.discs(); ++n) {
    const Disc disc = circles.draw(random);
    for (int row = 0; row < samples; ++row) {
      for (int column = 0; column < samples; ++column) {
        count += disc.at(static_cast<float>(column * step - disc.x),
                         static_cast<float>(row * step - disc.y)) != 0.0f;
      }
    }
  }
  return count;
}

TEST(Circles, StopAfterASmallUnitWhenTheSliceIsOver) {
  constexpr int samples = 2049;
  HeightMap map(samples, samples);
  const auto steps = [&map](const Circles& circles, std::uint64_t seed) {
    return finish(*circles.begin({.seed = seed, .samples = samples}, map.view()), test::shortestSlice());
  };
  // A unit is at most 4096 samples and what the last row has more, however large the disc is.
  const Circles wide(1, 1.0, 1.0, 1.0);
  std::uint64_t seed = 0;
  for (bool central = false; !central; central || ++seed) {
    RandomSequence random(seed);
    const Disc disc = wide.draw(random);
    central = std::abs(disc.x - kCircleUnits / 2) + std::abs(disc.y - kCircleUnits / 2) < kCircleUnits / 8;
  }
  EXPECT_GE(steps(wide, seed), covered(wide, seed, samples) / (4096 + samples));
  // Discs that touch nothing are no free ride: 16 units of drawing, and in each band the search.
  EXPECT_GE(steps(Circles(1000, 1.0, 0.01, 0.01), 1), 16 + 256);
}

TEST(Circles, DoNotAllocateOnceBegun) {
  for (int samples : {1, 65}) {
    HeightMap map(samples, samples);
    const auto task = Circles(1000, 4.0, 0.5, 0.1).begin({.seed = 1, .samples = samples}, map.view());
    const long before = test::allocationCount();
    finish(*task, test::shortestSlice());
    EXPECT_EQ(test::allocationCount(), before);
  }
}

TEST(Circles, HaveMeanZeroAndTheirDeviationAtEverySample) {
  for (const Circles& circles : {Circles(1000, 4.0, 0.5, 0.1), Circles(60, 3.0, 1.0, 0.3)}) {
    constexpr int samples = 5, count = samples * samples;
    const int seeds = 8000;
    std::vector<double> sums(count), squares(count);
    for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(seeds); ++seed) {
      const HeightMap map = made(circles, mixBits(seed), samples);
      for (std::size_t n = 0; n < count; ++n) {
        const double height = map.samples()[n];
        sums[n] += height;
        squares[n] += height * height;
      }
    }
    const double deviation = circles.range().deviation;
    for (std::size_t n = 0; n < count; ++n) {
      EXPECT_LT(std::fabs(sums[n] / seeds), 4.0 * deviation / std::sqrt(seeds)) << "sample " << n;
      EXPECT_NEAR(std::sqrt(squares[n] / seeds), deviation, 0.03 * deviation) << "sample " << n;
    }
  }
}

TEST(Circles, PromiseARangeThatOneDiscAloneAlmostReaches) {
  for (const Circles& circles : variety()) {
    const HeightRange range = circles.range();
    EXPECT_EQ(range.mean, 0.0);
    EXPECT_EQ(range.min, -range.max);
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const HeightMap map = made(circles, seed, 33);
      for (float height : map.samples()) ASSERT_LE(std::fabs(height), range.max);
    }
  }
  const Circles one(1, 1.0, 1.0, 1.0);
  float highest = 0.0f;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const HeightMap map = made(one, seed, 65);
    for (float height : map.samples()) highest = std::max(highest, std::fabs(height));
  }
  EXPECT_GT(highest, 0.99 * one.range().max);
}

TEST(Circles, ResidualIsWithinAFactorOfWhatIsMeasured) {
  for (const Circles& circles : {Circles(1000, 4.0, 0.5, 0.1), Circles(300, 1.0, 1.0, 0.01),
                                 Circles(2000, 2.0, 0.1, 0.3), Circles(500, 1.0, 0.25, 1.0)}) {
    constexpr int samples = 129, seeds = 40;
    EXPECT_EQ(circles.residual(0, samples), 0.0);
    std::vector<double> squares(8);
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const HeightMap finest = made(circles, mixBits(seed), samples);
      for (int level = 1; level <= 6; ++level)
        squares[static_cast<std::size_t>(level)] +=
            test::squaredError(finest, test::subsampled(finest, level), level) / seeds;
      const float centre = finest(samples / 2, samples / 2);
      for (float height : finest.samples()) {
        const double error = height - centre;
        squares[7] += error * error / (samples * samples * seeds);
      }
    }
    for (int level = 1; level <= 7; ++level) {
      const double ratio =
          circles.residual(level, samples) / std::sqrt(squares[static_cast<std::size_t>(level)]);
      EXPECT_GT(ratio, 1.0 / 1.3) << circles.discs() << " discs, level " << level;
      EXPECT_LT(ratio, 1.3) << circles.discs() << " discs, level " << level;
    }
  }
}

}  // namespace
}  // namespace teren
