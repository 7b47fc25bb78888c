#include "apps/fly/FreeCamera.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/apps/fly/FakeGround.h"

namespace teren {
namespace {

constexpr double kDry = -std::numeric_limits<double>::infinity();
constexpr double kPitch = 64.0;  // [m]

Viewpoint at(double height, double heading = 0.0, double pitch = 0.0) {
  return {{.position = {3, -7, 0.25, 0.5}, .height = height, .heading = heading, .pitch = pitch}, 0.87};
}

TEST(FreeCamera, BeginsWhereTheOtherWasAndStaysThere) {
  FreeCamera camera(at(500.0, 1.0, -0.3));
  camera.update(5.0, {}, flatGround(0.0), kDry);
  EXPECT_EQ(camera.viewpoint().pose.position, at(500.0).pose.position);
  EXPECT_EQ(camera.viewpoint().pose.height, 500.0);
  EXPECT_EQ(camera.viewpoint().pose.heading, 1.0);
  EXPECT_EQ(camera.viewpoint().fieldOfView, 0.87);
}

TEST(FreeCamera, GoesWhereItLooksAsFastAsItIsHigh) {
  const double heading = 0.5 * std::numbers::pi;  // east
  FreeCamera camera(at(500.0, heading));
  camera.update(0.1, {.forward = 1.0}, flatGround(100.0), kDry);
  const Offset way = offset(at(0.0).pose.position, camera.viewpoint().pose.position, kPitch);
  EXPECT_NEAR(way.east, 40.0, 1e-9);
  EXPECT_NEAR(way.north, 0.0, 1e-9);
  FreeCamera down(at(500.0, 0.0, -0.5));
  down.update(0.1, {.forward = 1.0}, flatGround(100.0), kDry);
  EXPECT_NEAR(down.viewpoint().pose.height, 500.0 - 40.0 * std::sin(0.5), 1e-9);
  FreeCamera aside(at(120.0));
  aside.update(0.1, {.right = 1.0, .up = 1.0}, flatGround(100.0), kDry);
  const Offset right = offset(at(0.0).pose.position, aside.viewpoint().pose.position, kPitch);
  EXPECT_NEAR(right.east, 0.1 * FreeCamera::kSlowest, 1e-9);
  EXPECT_NEAR(aside.viewpoint().pose.height, 120.0 + 0.1 * FreeCamera::kSlowest, 1e-9);
}

TEST(FreeCamera, StaysAboveGroundAndWaterAndBelowItsCeiling) {
  FreeCamera camera(at(110.0));
  for (int turn = 0; turn < 50; ++turn) camera.update(0.1, {.up = -1.0}, flatGround(100.0), kDry);
  EXPECT_EQ(camera.viewpoint().pose.height, 100.0 + FreeCamera::kClearance);
  camera.update(0.1, {.up = -1.0}, flatGround(100.0), 130.0);
  EXPECT_EQ(camera.viewpoint().pose.height, 130.0 + FreeCamera::kClearance);
  for (int turn = 0; turn < 500; ++turn) camera.update(0.1, {.up = 1.0}, flatGround(100.0), kDry);
  EXPECT_EQ(camera.viewpoint().pose.height, FreeCamera::kHighest);
  FreeCamera lost(at(0.0));
  lost.update(0.1, {.forward = 1.0, .up = -1.0}, unknownGround(), kDry);
  EXPECT_TRUE(std::isfinite(lost.viewpoint().pose.height));
}

TEST(FreeCamera, TurnsAndZoomsWithinItsLimits) {
  FreeCamera camera(at(500.0));
  camera.look(1.0, -9.0);
  EXPECT_NEAR(camera.viewpoint().pose.heading, 1.0, 1e-12);
  EXPECT_EQ(camera.viewpoint().pose.pitch, -CameraRig::kMaxPitch);
  camera.zoom(1.0);
  EXPECT_NEAR(camera.viewpoint().fieldOfView, 0.9 * 0.87, 1e-12);
  camera.zoom(1000.0);
  EXPECT_EQ(camera.viewpoint().fieldOfView, CameraRig::kMinFieldOfView);
}

}  // namespace
}  // namespace teren
