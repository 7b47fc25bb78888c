#include "apps/fly/CameraRig.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace teren {
namespace {

constexpr double kMoveRate = 12.0;      // [m/s] of the offset, plus
constexpr double kMoveShare = 0.8;      // [1/s] of the distance from the object
constexpr double kLagTime = 0.45;       // [s] in which the third person's view comes round
constexpr double kMaxLag = 0.6;         // [rad]
constexpr double kZoomStep = 0.9;       // factor of the field of view
constexpr double kThirdTilt = -0.07;    // [rad] by which the third person looks down
constexpr double kPitchFollowed = 0.6;  // share of the object's pitch that the first person takes part in
constexpr double kRollFollowed = 0.7;   // share of its roll
constexpr double kThirdRoll = 0.08;     // a hint of roll in third person

double turnBetween(double from, double to) {
  return std::remainder(to - from, 2.0 * std::numbers::pi);
}

}  // namespace

Pose poseOf(const Object& object) {
  const Motion motion = object.motion();
  const Attitude attitude = object.attitude();
  return {motion.position, motion.height, attitude.heading, attitude.pitch, attitude.roll};
}

void CameraRig::update(double dt, const CameraMoves& moves, const Pose& object) {
  Offset3& at = offset();
  const double rate = kMoveRate + kMoveShare * std::hypot(at.forward, at.right, at.up);
  const auto moved = [rate, dt](double value, double move) {
    return std::clamp(value + std::clamp(move, -1.0, 1.0) * rate * dt, -kMaxOffset, kMaxOffset);
  };
  at = {moved(at.forward, moves.forward), moved(at.right, moves.right), moved(at.up, moves.up)};

  if (followed_) lag_ += turnBetween(lastHeading_, object.heading);
  lag_ = std::clamp(lag_ * std::exp(-dt / kLagTime), -kMaxLag, kMaxLag);
  lastHeading_ = object.heading;
  followed_ = true;
}

void CameraRig::look(double right, double up) {
  lookRight_ = std::remainder(lookRight_ + right, 2.0 * std::numbers::pi);
  lookUp_ = std::clamp(lookUp_ + up, -kMaxPitch, kMaxPitch);
}

void CameraRig::zoom(double steps) {
  fieldOfView_ = zoomed(fieldOfView_, steps);
}

double CameraRig::zoomed(double fieldOfView, double steps) {
  return std::clamp(fieldOfView * std::pow(kZoomStep, steps), kMinFieldOfView, kMaxFieldOfView);
}

void CameraRig::reset() {
  first_ = kFirst;
  third_ = kThird;
  lookRight_ = lookUp_ = 0.0;
  fieldOfView_ = kDefaultFieldOfView;
}

void CameraRig::togglePerson() noexcept {
  person_ = person_ == Person::first ? Person::third : Person::first;
}

Viewpoint CameraRig::viewpoint(const Pose& object, const Ground& ground, double waterLevel) const {
  const bool third = person_ == Person::third;
  Viewpoint view;
  view.fieldOfView = fieldOfView_;
  Pose& eye = view.pose;
  eye.heading = object.heading + lookRight_ - (third ? lag_ : 0.0);
  const double tilt = third ? kThirdTilt : kPitchFollowed * object.pitch;
  eye.pitch = std::clamp(tilt + lookUp_, -kMaxPitch, kMaxPitch);
  eye.roll = object.roll * (third ? kThirdRoll : kRollFollowed * std::cos(lookRight_));

  // The cockpit's offset turns with the aircraft, the third person's with the view, so that it circles.
  const double turn = third ? eye.heading : object.heading;
  const double lift = third ? lookUp_ : 0.0;
  const Offset3& at = offset();
  const double ahead = at.forward * std::cos(lift) - at.up * std::sin(lift);
  const double up = at.forward * std::sin(lift) + at.up * std::cos(lift);
  const double east = ahead * std::sin(turn) + at.right * std::cos(turn);
  const double north = ahead * std::cos(turn) - at.right * std::sin(turn);
  const Result<Position> position = object.position.movedBy(east, north, ground.pitch());
  eye.position = position ? *position : object.position;
  eye.height = object.height + up;
  if (const std::optional<double> low = ground.height(eye.position)) {
    eye.height = std::max(eye.height, std::max(*low, waterLevel) + kEyeClearance);
  }
  return view;
}

}  // namespace teren
