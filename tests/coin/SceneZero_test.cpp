#include "coin/SceneZero.h"

#include <cmath>

#include <gtest/gtest.h>

namespace teren {
namespace {

TEST(SceneZero, StaysWhileTheEyeIsInItsPatchAtMuchTheSameHeight) {
  SceneZero zero;
  EXPECT_FALSE(zero.follow({0, 0, 0.2, 0.9}, 31.0, 64.0));
  EXPECT_EQ(zero.position(), Position{});
  EXPECT_EQ(zero.height(), 0.0);
}

TEST(SceneZero, MovesToTheCornerOfTheEyesPatchAndByWholeStepsInHeight) {
  SceneZero zero;
  const Position eye{40, -7, 0.3, 0.6};
  EXPECT_TRUE(zero.follow(eye, 1010.0, 64.0));
  EXPECT_EQ(zero.position(), (Position{40, -7, 0.0, 0.0}));
  EXPECT_EQ(zero.height(), 1024.0);
  EXPECT_FALSE(zero.follow(eye, 1010.0, 64.0));
}

TEST(SceneZero, DoesNotDependOnTheWayTheEyeCame) {
  SceneZero straight, roundabout;
  straight.follow({5, 6, 0.3, 0.6}, 100.0, 64.0);
  for (int step = 0; step < 100; ++step) roundabout.follow({step, 6, 0.5, 0.5}, 10.0 * step, 64.0);
  roundabout.follow({5, 6, 0.3, 0.6}, 100.0, 64.0);
  EXPECT_EQ(straight.position(), roundabout.position());
  EXPECT_EQ(straight.height(), roundabout.height());
}

TEST(SceneZero, KeepsTheEyeWithinItsReachAtTheEndOfTheWorldToo) {
  SceneZero zero;
  for (const Position& start :
       {Position{0, 0, 0.0, 0.0}, Position{kMaxPatch - 10000, -kMaxPatch + 1, 0.5, 0.5}}) {
    for (int step = 0; step < 500; ++step) {
      const Position eye = *start.movedBy(33.0 * step, 71.0 * step, 64.0);
      zero.follow(eye, 17.0 * step, 64.0);
      const Offset away = offset(zero.position(), eye, 64.0);
      ASSERT_LE(std::abs(away.east), SceneZero::kFarthest);
      ASSERT_LE(std::abs(away.north), SceneZero::kFarthest);
      ASSERT_LE(std::abs(17.0 * step - zero.height()), SceneZero::kFarthest);
      ASSERT_EQ(zero.position().u, 0.0);
      ASSERT_EQ(zero.position().v, 0.0);
    }
  }
}

TEST(SceneZero, DividesLargePatchesAsFarAsDoublesCan) {
  SceneZero zero;
  const double pitch = 1000.0;
  const std::int64_t far = std::int64_t{1} << 40;
  zero.follow({far, -far, 0.7, 0.99}, 0.0, pitch);
  const Offset away = offset(zero.position(), {far, -far, 0.7, 0.99}, pitch);
  EXPECT_LE(std::abs(away.east), SceneZero::kFarthest);
  EXPECT_LE(std::abs(away.north), SceneZero::kFarthest);
  EXPECT_EQ(zero.position().u, 0.6875);
  zero.follow({kMaxPatch - 1, kMaxPatch / 2, 0.7, 0.99}, 0.0, pitch);
  EXPECT_EQ(zero.position(), (Position{kMaxPatch - 1, kMaxPatch / 2, 0.0, 0.0}))
      << "a double has no digits left there";
}

}  // namespace
}  // namespace teren
