#include "generators/crater/Smoothing.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

constexpr DeformRegion kRegion{.columns = 2, .rows = 2, .intervals = 32, .spacing = 2.0};
constexpr int kSide = 65;

/// Heights of white noise, as rough as ground can be.
HeightMap rubble(double most, std::uint64_t seed) {
  HeightMap map(kSide, kSide);
  RandomSequence random(seed);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      map(x, y) = static_cast<float>(most * static_cast<double>(random.nextBits(20) - (1 << 19)) * 0x1p-19);
    }
  }
  return map;
}

/// Runs all steps.
void finish(Smoothing& smoothing, DeformGrid& grid) {
  while (smoothing.stepsLeft() > 0) smoothing.row(grid);
}

long double volume(const DeformGrid& grid) {
  long double sum = 0.0L;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) sum += grid(x, y);
  }
  return sum;
}

TEST(Smoothing, KeepsTheVolumeButForARoundingThatItStates) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    DeformGrid grid(kRegion, rubble(4000.0, seed).view());
    const long double before = volume(grid);
    Smoothing smoothing(kRegion, 60.0, 70.0, 40.0, 300);
    finish(smoothing, grid);
    const double samples = 21.0 * 2.0 * 21.0 * 2.0;
    EXPECT_LE(std::fabs(static_cast<double>(volume(grid) - before)),
              300 * samples * 4000.0 * Smoothing::kVolumeError);
    EXPECT_NE(volume(grid), before);  // else nothing was tried
  }
}

TEST(Smoothing, NeverLeavesTheRangeOfTheHeightsBefore) {
  const HeightMap ground = rubble(1000.0, 6);
  DeformGrid grid(kRegion, ground.view());
  const auto [least, most] = std::minmax_element(ground.samples().begin(), ground.samples().end());
  Smoothing smoothing(kRegion, 64.0, 64.0, 50.0, 1);
  finish(smoothing, grid);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      EXPECT_GE(grid(x, y), *least);
      EXPECT_LE(grid(x, y), *most);
    }
  }
}

TEST(Smoothing, CalmsTheHardestCaseInsteadOfSwingingIt) {
  // A checkerboard is what explicit schemes of too large a step make grow.
  HeightMap ground(kSide, kSide);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) ground(x, y) = (x + y) % 2 == 0 ? 1000.0F : -1000.0F;
  }
  DeformGrid grid(kRegion, ground.view());
  Smoothing smoothing(kRegion, 64.0, 64.0, 50.0, Smoothing::kMostSteps);
  const auto roughness = [&] {
    double sum = 0.0;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) sum += grid(x, y) * grid(x, y);
    }
    return sum;
  };
  double before = roughness();
  while (smoothing.stepsLeft() > 0) {
    while (!smoothing.row(grid)) {
    }
    const double now = roughness();
    ASSERT_LE(now, before * (1.0 + 1e-12)) << smoothing.stepsLeft();
    before = now;
  }
  for (int y = 22; y <= 42; ++y) {
    for (int x = 22; x <= 42; ++x) EXPECT_LT(std::fabs(grid(x, y)), 1.0) << x << ", " << y;
  }
}

TEST(Smoothing, BlursLikeAGaussianOfTheStatedDeviationInItsMiddle) {
  HeightMap ground(kSide, kSide);
  ground(32, 32) = 1000.0F;
  DeformGrid grid(kRegion, ground.view());
  // So wide that the weights are 1 within 2 % where something flows.
  const DeformRegion region = kRegion;
  Smoothing smoothing(region, 64.0, 64.0, 57.0, Smoothing::stepsFor(2.0));
  EXPECT_EQ(smoothing.stepsLeft(), 16);
  finish(smoothing, grid);
  double sum = 0.0, squares = 0.0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      sum += grid(x, y);
      squares += grid(x, y) * (x - 32) * (x - 32);
    }
  }
  EXPECT_NEAR(sum, 1000.0, 1e-9);
  EXPECT_NEAR(std::sqrt(squares / sum), 2.0, 0.05);
}

TEST(Smoothing, TakesAsManyStepsAsItsDepthAsksForAndNoMore) {
  EXPECT_EQ(Smoothing::stepsFor(0.0), 1);
  EXPECT_EQ(Smoothing::stepsFor(0.25), 1);
  EXPECT_EQ(Smoothing::stepsFor(0.5), 1);
  EXPECT_EQ(Smoothing::stepsFor(0.51), 2);
  EXPECT_EQ(Smoothing::stepsFor(4.0), 64);
  EXPECT_EQ(Smoothing::stepsFor(Smoothing::kMostSamples), Smoothing::kMostSteps);
}

TEST(Smoothing, LeavesAllAsItIsBeyondItsReachWhereverItsMiddleIs) {
  const HeightMap ground = rubble(100.0, 8);
  for (const double east : {64.0, 64.999, 65.0, 65.7}) {
    for (const double radius : {1e-300, 0.3, 1.0, 2.0, 7.5, 30.0}) {
      DeformGrid grid(kRegion, ground.view());
      const double north = east == 64.0 ? 57.0 : east - 7.3;  // also midway between two samples
      Smoothing smoothing(kRegion, east, north, radius, 9);
      finish(smoothing, grid);
      int changed = 0;
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          const bool far =
              std::hypot(2.0 * x - east, 2.0 * y - north) >= Smoothing::reach(radius, kRegion.spacing);
          if (far) {
            ASSERT_EQ(grid(x, y), ground(x, y)) << east << ", " << radius << ": " << x << ", " << y;
          }
          changed += grid(x, y) != ground(x, y) ? 1 : 0;
        }
      }
      if (radius >= 2.0) {
        EXPECT_GT(changed, 0) << east << ", " << radius;
      }
    }
  }
}

TEST(Smoothing, IsTheSameMirrored) {
  const HeightMap ground = rubble(100.0, 9);
  HeightMap mirrored(kSide, kSide);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) mirrored(x, y) = ground(y, kSide - 1 - x);
  }
  DeformGrid grid(kRegion, ground.view()), turned(kRegion, mirrored.view());
  Smoothing one(kRegion, 64.0, 64.0, 40.0, 5), two(kRegion, 64.0, 64.0, 40.0, 5);
  finish(one, grid);
  finish(two, turned);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) EXPECT_NEAR(turned(x, y), grid(y, kSide - 1 - x), 1e-11);
  }
}

}  // namespace
}  // namespace teren
