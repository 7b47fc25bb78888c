#include "apps/fly/SceneZero.h"

#include <cmath>

#include <gtest/gtest.h>

namespace teren {
namespace {

TEST(SceneZero, StaysWhileTheEyeIsNear) {
  SceneZero zero;
  EXPECT_FALSE(zero.follow({31, -31, 0.2, 0.9}, 64.0));
  EXPECT_EQ(zero.position(), Position{});
}

TEST(SceneZero, MovesToACornerOfTheLatticeNearTheEye) {
  SceneZero zero;
  const Position eye{40, -7, 0.3, 0.6};
  EXPECT_TRUE(zero.follow(eye, 64.0));
  EXPECT_EQ(zero.position(), (Position{40, -7, 0.0, 0.0}));
  EXPECT_FALSE(zero.follow(eye, 64.0));
}

TEST(SceneZero, KeepsTheEyeWithinItsReachAtTheEndOfTheWorldToo) {
  SceneZero zero;
  for (const Position& start :
       {Position{0, 0, 0.0, 0.0}, Position{kMaxPatch - 10000, -kMaxPatch + 1, 0.5, 0.5}}) {
    for (int step = 0; step < 500; ++step) {
      const Position eye = *start.movedBy(33.0 * step, 71.0 * step, 64.0);
      zero.follow(eye, 64.0);
      const Offset away = offset(zero.position(), eye, 64.0);
      ASSERT_LE(std::abs(away.east), SceneZero::kFarthest);
      ASSERT_LE(std::abs(away.north), SceneZero::kFarthest);
      ASSERT_EQ(zero.position().u, 0.0);
      ASSERT_EQ(zero.position().v, 0.0);
    }
  }
}

}  // namespace
}  // namespace teren
