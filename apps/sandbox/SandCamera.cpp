#include "apps/sandbox/SandCamera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Inventor/SbRotation.h>
#include <Inventor/SbVec3f.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>

#include "apps/sandbox/SandScript.h"

namespace teren {
namespace {

constexpr double kDegreesPerPixel = 0.5;
constexpr double kNearerPerNotch = 0.125;
constexpr double kFieldOfView = 0.7;  // [rad] of the picture's height
constexpr double kAllInView = 2.0;    // sides: from there the whole box is in view
constexpr double kNearest = 0.01;     // sides
constexpr double kFarthest = 20.0;    // sides
constexpr double kFlattest = 1.0;     // [degree]

float radians(double degrees) {
  return static_cast<float>(degrees * std::numbers::pi / 180.0);
}

}  // namespace

SandCamera::SandCamera(SoPerspectiveCamera& camera) : camera_(camera) {
  camera_.heightAngle = static_cast<float>(kFieldOfView);
  set(Values::defaults(cameraParameters()));
}

void SandCamera::setBox(double middleX, double middleY, double middleZ, double side) {
  middleX_ = middleX;
  middleY_ = middleY;
  middleZ_ = middleZ;
  side_ = side;
  set(Values::defaults(cameraParameters()));
}

void SandCamera::set(const Values& values) {
  home_ = {values.real("turn"), values.real("tilt"), values.real("distance"),
           values.real("x"),    values.real("y"),    values.real("z")};
  if (home_.distance == 0.0) home_.distance = kAllInView * side_;
  reset();
}

void SandCamera::reset() {
  view_ = home_;
  apply();
}

void SandCamera::turn(double right, double down) {
  view_.turn = std::fmod(view_.turn - kDegreesPerPixel * right, 360.0);
  view_.tilt = std::clamp(view_.tilt + kDegreesPerPixel * down, kFlattest, 90.0);
  apply();
}

void SandCamera::move(double right, double down, double height) {
  const double metres = 2.0 * std::tan(0.5 * kFieldOfView) * view_.distance / std::max(height, 1.0);
  const double cosine = std::cos(radians(view_.turn)), sine = std::sin(radians(view_.turn));
  const double east = -metres * right, north = metres * down;
  view_.x = std::clamp(view_.x + cosine * east - sine * north, -side_, side_);
  view_.y = std::clamp(view_.y + sine * east + cosine * north, -side_, side_);
  apply();
}

void SandCamera::approach(double notches) {
  const double nearer = std::pow(1.0 - kNearerPerNotch, std::clamp(notches, -100.0, 100.0));
  view_.distance = std::clamp(view_.distance * nearer, kNearest * side_, kFarthest * side_);
  apply();
}

void SandCamera::apply() {
  // Inventor's camera looks down its -z axis with y up: straight down, north ahead, is no rotation at all.
  const SbRotation tilted(SbVec3f(1.0F, 0.0F, 0.0F), radians(90.0 - view_.tilt));
  const SbRotation turned(SbVec3f(0.0F, 0.0F, 1.0F), radians(view_.turn));
  const SbRotation orientation = tilted * turned;
  SbVec3f backwards;
  orientation.multVec(SbVec3f(0.0F, 0.0F, 1.0F), backwards);
  const SbVec3f target(static_cast<float>(middleX_ + view_.x), static_cast<float>(middleY_ + view_.y),
                       static_cast<float>(middleZ_ + view_.z));
  camera_.orientation = orientation;
  camera_.position = target + backwards * static_cast<float>(view_.distance);
  camera_.focalDistance = static_cast<float>(view_.distance);
  camera_.nearDistance = static_cast<float>(0.02 * view_.distance);
  camera_.farDistance = static_cast<float>(view_.distance + 4.0 * side_);
}

}  // namespace teren
