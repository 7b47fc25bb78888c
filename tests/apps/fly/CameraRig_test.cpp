#include "apps/fly/CameraRig.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/apps/fly/FakeGround.h"

namespace teren {
namespace {

constexpr double kDry = -1e9;
constexpr double kPi = std::numbers::pi;

Pose above(double height, double heading = 0.0) {
  return {{5, 6, 0.5, 0.5}, height, heading, 0.0, 0.0};
}

Offset fromObject(const Pose& object, const Viewpoint& view) {
  return offset(object.position, view.pose.position, 64.0);
}

TEST(CameraRig, BeginsInThirdPersonBehindAndAboveTheObject) {
  const CameraRig rig;
  const Pose object = above(100.0, kPi / 2.0);  // heading east
  const Viewpoint view = rig.viewpoint(object, flatGround(0.0), kDry);
  EXPECT_EQ(rig.person(), CameraRig::Person::third);
  EXPECT_LT(fromObject(object, view).east, -15.0);
  EXPECT_NEAR(fromObject(object, view).north, 0.0, 1e-9);
  EXPECT_GT(view.pose.height, 102.0);
  EXPECT_NEAR(view.pose.heading, kPi / 2.0, 1e-12);
}

TEST(CameraRig, SitsInTheObjectInFirstPersonAndRollsWithIt) {
  CameraRig rig;
  rig.togglePerson();
  Pose object = above(100.0);
  object.roll = 0.5;
  const Viewpoint view = rig.viewpoint(object, flatGround(0.0), kDry);
  EXPECT_EQ(rig.person(), CameraRig::Person::first);
  EXPECT_LT(std::hypot(fromObject(object, view).east, fromObject(object, view).north), 3.0);
  EXPECT_GT(view.pose.roll, 0.2);
}

TEST(CameraRig, MovesRelativeToTheObjectsHeading) {
  CameraRig rig;
  rig.togglePerson();
  const Pose object = above(100.0, kPi / 2.0);
  const Viewpoint before = rig.viewpoint(object, flatGround(0.0), kDry);
  rig.update(1.0, {.forward = 1.0, .right = 1.0, .up = 1.0}, object);
  const Viewpoint after = rig.viewpoint(object, flatGround(0.0), kDry);
  const Offset moved = offset(before.pose.position, after.pose.position, 64.0);
  EXPECT_GT(moved.east, 10.0);    // forward
  EXPECT_LT(moved.north, -10.0);  // right
  EXPECT_GT(after.pose.height, before.pose.height + 10.0);
}

TEST(CameraRig, StaysWithinItsGreatestOffset) {
  CameraRig rig;
  const Pose object = above(100.0);
  rig.update(1e6, {.forward = -1.0}, object);
  EXPECT_NEAR(fromObject(object, rig.viewpoint(object, flatGround(0.0), kDry)).north, -CameraRig::kMaxOffset,
              1.0);
}

TEST(CameraRig, GoesBackToItsDefaultWhenReset) {
  CameraRig rig;
  const Pose object = above(1000.0);
  const Viewpoint before = rig.viewpoint(object, flatGround(0.0), kDry);
  rig.update(2.0, {1.0, -1.0, 1.0}, object);
  rig.look(1.0, 0.4);
  rig.zoom(5.0);
  rig.reset();
  const Viewpoint after = rig.viewpoint(object, flatGround(0.0), kDry);
  EXPECT_EQ(after.pose.position, before.pose.position);
  EXPECT_EQ(after.pose.height, before.pose.height);
  EXPECT_EQ(after.pose.heading, before.pose.heading);
  EXPECT_EQ(after.fieldOfView, before.fieldOfView);
}

TEST(CameraRig, CirclesTheObjectWhenLookingAroundInThirdPerson) {
  CameraRig rig;
  const Pose object = above(500.0);
  rig.look(kPi / 2.0, 0.0);
  const Viewpoint view = rig.viewpoint(object, flatGround(0.0), kDry);
  EXPECT_NEAR(view.pose.heading, kPi / 2.0, 1e-12);
  EXPECT_LT(fromObject(object, view).east, -15.0);
  EXPECT_NEAR(fromObject(object, view).north, 0.0, 1e-9);
}

TEST(CameraRig, NeverLooksPastStraightUpOrDown) {
  CameraRig rig;
  for (const double up : {100.0, -200.0}) {
    rig.look(0.0, up);
    EXPECT_LE(std::abs(rig.viewpoint(above(5e3), flatGround(0.0), kDry).pose.pitch), CameraRig::kMaxPitch);
  }
}

TEST(CameraRig, ZoomsBetweenItsLimits) {
  CameraRig rig;
  const auto field = [&rig] { return rig.viewpoint(above(100.0), flatGround(0.0), kDry).fieldOfView; };
  EXPECT_EQ(field(), CameraRig::kDefaultFieldOfView);
  rig.zoom(1.0);
  EXPECT_LT(field(), CameraRig::kDefaultFieldOfView);
  rig.zoom(1000.0);
  EXPECT_EQ(field(), CameraRig::kMinFieldOfView);
  rig.zoom(-1000.0);
  EXPECT_EQ(field(), CameraRig::kMaxFieldOfView);
}

TEST(CameraRig, KeepsTheEyeAboveGroundAndWater) {
  CameraRig rig;
  const Pose object = above(10.0);
  EXPECT_DOUBLE_EQ(rig.viewpoint(object, flatGround(50.0), kDry).pose.height,
                   50.0 + CameraRig::kEyeClearance);
  EXPECT_DOUBLE_EQ(rig.viewpoint(object, flatGround(-50.0), 40.0).pose.height,
                   40.0 + CameraRig::kEyeClearance);
  EXPECT_LT(rig.viewpoint(object, unknownGround(), kDry).pose.height, 20.0);
}

TEST(CameraRig, ComesRoundAfterATurnWithoutEverLosingTheObject) {
  CameraRig rig;
  rig.update(0.02, {}, above(100.0, 0.1));
  for (int frame = 1; frame <= 50; ++frame) rig.update(0.02, {}, above(100.0, 0.1 - 0.01 * frame));
  const double heading = 0.1 - 0.5;  // through north, to the left
  const double behind = rig.viewpoint(above(100.0, heading), flatGround(0.0), kDry).pose.heading - heading;
  EXPECT_GT(behind, 0.05);
  EXPECT_LT(behind, 0.6);
  for (int frame = 0; frame < 200; ++frame) rig.update(0.02, {}, above(100.0, heading));
  EXPECT_NEAR(rig.viewpoint(above(100.0, heading), flatGround(0.0), kDry).pose.heading, heading, 1e-3);
}

}  // namespace
}  // namespace teren
