#include "stream/Sweep.h"

#include <cmath>

#include <gtest/gtest.h>

namespace teren {
namespace {

constexpr Vector3 kA{0, 0, 0}, kB{4, 0, 0}, kC{4, 4, 0};

TEST(Sweep, BallOntoAFaceStopsARadiusAbove) {
  const auto touch = sweepFace({{3, 1, 10}, {3, 1, -10}, 2.0}, kA, kB, kC);
  ASSERT_TRUE(touch);
  EXPECT_EQ(touch->time, 0.4);
  EXPECT_EQ(touch->normal.z, 1.0);
}

TEST(Sweep, FaceIsTouchedFromAboveOnly) {
  EXPECT_FALSE(sweepFace({{3, 1, -10}, {3, 1, 10}, 2.0}, kA, kB, kC));
  EXPECT_FALSE(sweepFace({{3, 1, -10}, {3, 1, -20}, 2.0}, kA, kB, kC));
}

TEST(Sweep, BallBesideAFaceMissesIt) {
  EXPECT_FALSE(sweepFace({{1, 3, 10}, {1, 3, -10}, 0.1}, kA, kB, kC));
  EXPECT_FALSE(sweepFace({{5, 1, 10}, {5, 1, -10}, 0.1}, kA, kB, kC));
  EXPECT_FALSE(sweepFace({{3, 1, 10}, {3, 1, 2.5}, 2.0}, kA, kB, kC)) << "stops above";
}

TEST(Sweep, BallTouchesASegmentFromTheSide) {
  const auto touch = sweepSegment({{2, -10, 0}, {2, 10, 0}, 3.0}, kA, kB);
  ASSERT_TRUE(touch);
  EXPECT_NEAR(touch->time, 0.35, 1e-15);
  EXPECT_EQ(touch->normal.y, -1.0);
  EXPECT_FALSE(sweepSegment({{7, -10, 0}, {7, 10, 0}, 2.9}, kA, kB)) << "beyond its end";
  EXPECT_FALSE(sweepSegment({{-5, 0, 0}, {9, 0, 0}, 1.0}, kA, kB)) << "along it: its ends are points";
}

TEST(Sweep, GrazingPointIsTouchedAndAHairBesideIsNot) {
  EXPECT_TRUE(sweepPoint({{-10, 2, 0}, {10, 2, 0}, 2.0}, kA));
  EXPECT_FALSE(sweepPoint({{-10, 2.0000001, 0}, {10, 2.0000001, 0}, 2.0}, kA));
}

TEST(Sweep, OverlapIsATouchOnlyWhereItDeepens) {
  EXPECT_EQ(sweepPoint({{1, 0, 0}, {0.5, 0, 0}, 2.0}, kA)->time, 0.0);
  EXPECT_FALSE(sweepPoint({{1, 0, 0}, {2, 0, 0}, 2.0}, kA));
  EXPECT_FALSE(sweepPoint({{1, 0, 0}, {1, 0, 0}, 2.0}, kA)) << "standing";
  EXPECT_EQ(sweepFace({{3, 1, 1}, {3, 1, 0.5}, 2.0}, kA, kB, kC)->time, 0.0);
  EXPECT_FALSE(sweepFace({{3, 1, 1}, {3, 1, 1.5}, 2.0}, kA, kB, kC));
}

TEST(Sweep, FindsThePointAtTheEndOfAnyWay) {
  for (const double way : {1.0, 1e4, 1e9, 1e15, 1e22}) {
    const auto touch = sweepPoint({{-way, 0, 0}, {way, 0, 0}, 1e-3 * way}, kA);
    ASSERT_TRUE(touch) << way;
    EXPECT_NEAR(touch->time, 0.4995, 1e-12) << way;
  }
}

}  // namespace
}  // namespace teren
