#include "stream/GroundSweep.h"

#include <cmath>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "tests/engine/stream/PatchGround.h"

namespace teren {
namespace {

constexpr double kPitch = 8.0;
constexpr int kIntervals = 4;

/// Rough ground between -3 and 3 m at 2 m between samples: far steeper than a world's.
PatchGround rough(std::uint64_t seed) {
  PatchGround ground(kPitch, kIntervals, [seed](std::int64_t column, std::int64_t row) {
    const std::uint64_t bits =
        hashWith(hashWith(seed, static_cast<std::uint64_t>(column)), static_cast<std::uint64_t>(row));
    return static_cast<double>(bits % 6001) / 1000.0 - 3.0;
  });
  ground.addAround(4);
  return ground;
}

/// The least distance between ground and ball's centre from time 0 to `end`, in `steps` looks.
long double leastDistance(const PatchGround& ground, const MovingBall& ball, double end, int steps) {
  long double least = std::numeric_limits<long double>::infinity();
  for (int k = 0; k <= steps; ++k) {
    const long double time = static_cast<long double>(end) * k / steps;
    const auto at = [time](double from, double to) {
      return from + time * (static_cast<long double>(to) - from);
    };
    least = std::min(least, ground.distance(at(ball.from.x, ball.to.x), at(ball.from.y, ball.to.y),
                                            at(ball.from.z, ball.to.z), ball.radius + 0.01));
  }
  return least;
}

TEST(GroundSweep, AgreesWithFineStepsOverRoughGround) {
  int touched = 0, missed = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const PatchGround ground = rough(seed);
    const GroundSweep sweep(ground, kPitch);
    Dice dice(seed);
    for (int trial = 0; trial < 120; ++trial) {
      MovingBall ball;
      ball.radius = trial % 4 == 0 ? 0.01 : dice.between(0.05, 2.5);
      ball.from = {dice.between(-20, 20), dice.between(-20, 20), 0.0};
      ball.from.z = sweep.rest({}, ball.from.x, ball.from.y, ball.radius)->height + dice.between(1e-6, 4.0);
      ball.to = ball.from + Vector3{dice.between(-8, 8), dice.between(-8, 8), dice.between(-6, 3)};
      const auto touch = sweep.sweep({}, ball);
      const double end = touch ? touch->time : 1.0;
      ASSERT_GE(leastDistance(ground, ball, end, 400), ball.radius - sweepError(20.0))
          << "seed " << seed << ", trial " << trial;
      (touch ? touched : missed) += 1;
      if (!touch) continue;
      const Vector3 there = ball.at(end);
      const long double gap = ground.distance(there.x, there.y, there.z, ball.radius + 0.01);
      ASSERT_NEAR(static_cast<double>(gap), ball.radius, sweepError(20.0)) << seed << ", " << trial;
      // The normal leads from the nearest point of the ground to the centre.
      const Vector3 foot = there - ball.radius * touch->normal;
      ASSERT_NEAR(static_cast<double>(ground.distance(foot.x, foot.y, foot.z, 0.5)), 0.0, 1e-8);
    }
  }
  EXPECT_GT(touched, 300);
  EXPECT_GT(missed, 300);
}

TEST(GroundSweep, RestIsWhereTheBallTouchesAndNoHigher) {
  const PatchGround ground = rough(5);
  const GroundSweep sweep(ground, kPitch);
  Dice dice(5);
  for (int trial = 0; trial < 400; ++trial) {
    const double x = dice.between(-25, 25), y = dice.between(-25, 25), radius = dice.between(0.001, 3.0);
    const auto rest = sweep.rest({}, x, y, radius);
    ASSERT_TRUE(rest);
    ASSERT_NEAR(static_cast<double>(ground.distance(x, y, rest->height, radius + 0.1)), radius, 1e-8);
    for (const double higher : {1e-3, 0.1, 1.0, 5.0}) {
      ASSERT_GT(ground.distance(x, y, rest->height + higher, radius + 0.1), radius - 1e-8L) << higher;
    }
  }
}

/// A wall one square thin and 100 m high, along the column 0.
PatchGround ridge() {
  PatchGround ground(64.0, 32, [](std::int64_t column, std::int64_t) { return column == 0 ? 100.0 : 0.0; });
  ground.addAround(2);
  return ground;
}

TEST(GroundSweep, NoBulletIsTooFastForAThinRidge) {
  const PatchGround ground = ridge();
  const GroundSweep sweep(ground, 64.0);
  for (const double way : {1.0, 100.0, 1e4, 1e9, 1e15}) {
    for (const double radius : {0.0, 0.01, 5.0}) {
      const double before = std::min(way, 60.0);
      const MovingBall ball{{-before - 3.0 - radius, 13.0, 50.0}, {way, 13.0, 50.0}, radius};
      const auto touch = sweep.sweep({}, ball);
      ASSERT_TRUE(touch) << way << ", " << radius;
      // The western face rises 100 m in 2 m, so it is 1 m away from the crest at half its height.
      const double expected = -1.0 - radius * std::sqrt(1.0 + 4e-4);
      EXPECT_NEAR(ball.at(touch->time).x, expected, 32.0 * sweepError(2.0 * way)) << way << ", " << radius;
      EXPECT_LT(touch->normal.x, -0.99);
    }
  }
}

TEST(GroundSweep, ABulletOnTheLineBetweenTwoTrianglesIsStopped) {
  const PatchGround ground = rough(2);
  const GroundSweep sweep(ground, kPitch);
  for (int k = -12; k < 12; ++k) {
    for (const double x : {2.0 * k, 2.0 * k + 1.0, 2.0 * k + 1.0 / 3.0}) {
      EXPECT_TRUE(sweep.sweep({}, {{x, 2.0, 1e3}, {x, 2.0, -1e3}, 0.0})) << "on a side, " << x;
      EXPECT_TRUE(sweep.sweep({}, {{x, x, 1e3}, {x, x, -1e3}, 0.0})) << "on a diagonal, " << x;
    }
  }
}

TEST(GroundSweep, BallSlidesAlongAGapAboveTheGroundWithoutATouch) {
  PatchGround ground(kPitch, kIntervals,
                     [](std::int64_t column, std::int64_t) { return 0.5 * static_cast<double>(column); });
  ground.addAround(3);
  const GroundSweep sweep(ground, kPitch);
  const double high = sweep.rest({}, -10.0, 1.0, 1.0)->height + 1e-6;
  EXPECT_FALSE(sweep.sweep({}, {{-10.0, 1.0, high}, {10.0, 3.0, high + 5.0}, 1.0}));
  EXPECT_TRUE(sweep.sweep({}, {{-10.0, 1.0, high}, {10.0, 3.0, high + 4.999}, 1.0}));
}

TEST(GroundSweep, FlyingOutOfTheGroundFromBelowTouchesNothing) {
  const PatchGround ground = rough(9);
  const GroundSweep sweep(ground, kPitch);
  Dice dice(9);
  for (int trial = 0; trial < 200; ++trial) {
    const double x = dice.between(-20, 20), y = dice.between(-20, 20);
    EXPECT_FALSE(sweep.sweep({}, {{x, y, -10.0}, {x, y, 10.0}, dice.between(0.0, 1.0)}));
  }
}

TEST(GroundSweep, WhereNothingIsHeldNothingIsTouched) {
  PatchGround ground(kPitch, kIntervals, [](std::int64_t, std::int64_t) { return 0.0; });
  ground.add(3, 0);
  const GroundSweep sweep(ground, kPitch);
  EXPECT_FALSE(sweep.sweep({}, {{1, 1, 5}, {1, 1, -5}, 1.0}));
  EXPECT_FALSE(sweep.rest({}, 1.0, 1.0, 1.0));
  EXPECT_TRUE(sweep.sweep({}, {{1, 1, 5}, {49, 1, -5}, 1.0}));
  EXPECT_TRUE(sweep.sweep({}, {{28 - 1e7, 4, 1e6}, {28 + 1e7, 4, -1e6}, 1.0}));
  EXPECT_FALSE(sweep.sweep({}, {{228 - 1e7, 4, 1e6}, {228 + 1e7, 4, -1e6}, 1.0}));
}

TEST(GroundSweep, WorksFarFromTheWorldsZero) {
  PatchGround ground(64.0, 32, [](std::int64_t, std::int64_t) { return 7.0; });
  const std::int64_t far = kMaxPatch - 2;
  ground.add(far, -far);
  const GroundSweep sweep(ground, 64.0);
  const auto touch = sweep.sweep({far, -far, 0.0, 0.0}, {{10, 10, 20}, {10, 10, 0}, 3.0});
  ASSERT_TRUE(touch);
  EXPECT_NEAR(touch->time, 0.5, 1e-12);
}

}  // namespace
}  // namespace teren
