#include "apps/fly/Aircraft.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace teren {
namespace {

constexpr double kFullTurn = 2.0 * std::numbers::pi;

constexpr double kRollTime = 0.35;           // [s] in which the roll approaches what the pilot asks
constexpr double kAcceleration = 25.0;       // [m/s^2] at full throttle, plus
constexpr double kAccelerationShare = 0.35;  // [1/s] of the speed, so that fast flight is not sluggish

constexpr double kPlannedSlope = 0.35;       // the climb it counts on when it looks ahead
constexpr double kClimbSlope = 0.7;          // the steepest it climbs,
constexpr double kDescentSlope = 0.25;       // and descends, in metres per metre flown
constexpr double kFollowRate = 0.7;          // [1/s] of the height still missing
constexpr double kPullUp = 14.0;             // [m/s^2] largest change of the climb rate upwards
constexpr double kPushDown = 4.0;            // [m/s^2] and downwards
constexpr double kLookAheadTime = 12.0;      // [s]
constexpr double kLookAheadAtLeast = 500.0;  // [m]
constexpr int kNearLooks = 4, kFarLooks = 20;

constexpr double kClearanceRate = 25.0;  // [m/s] at full climb, plus
constexpr double kClearanceShare = 0.5;  // [1/s] of the clearance

double bounded(double value, double low, double high, double otherwise) {
  return std::isfinite(value) ? std::clamp(value, low, high) : otherwise;
}

double wrapped(double angle) {
  const double rest = std::fmod(angle, kFullTurn);
  const double positive = rest < 0.0 ? rest + kFullTurn : rest;
  return positive < kFullTurn ? positive : 0.0;
}

}  // namespace

Aircraft::Aircraft(const AircraftStart& start)
    : position_(start.position),
      waterLevel_(std::isnan(start.waterLevel) ? -std::numeric_limits<double>::infinity() : start.waterLevel),
      clearance_(bounded(start.clearance, kMinClearance, kMaxClearance, AircraftStart{}.clearance)),
      height_(clearance_ + (std::isfinite(waterLevel_) ? waterLevel_ : 0.0)),
      heading_(std::isfinite(start.heading) ? wrapped(start.heading) : 0.0),
      speed_(bounded(start.speed, kMinSpeed, kMaxSpeed, AircraftStart{}.speed)) {}

void Aircraft::setControls(const AircraftControls& controls) noexcept {
  controls_ = {bounded(controls.turn, -1.0, 1.0, 0.0), bounded(controls.throttle, -1.0, 1.0, 0.0),
               bounded(controls.climb, -1.0, 1.0, 0.0)};
}

void Aircraft::update(double dt, const Ground& ground) {
  if (std::isfinite(dt) && dt > 0.0) {
    const double steps = std::ceil(dt / kMaxStep);
    for (double done = 0.0; done < steps; done += 1.0) step(dt / steps, ground);
  } else {
    if (!flying_) height_ = heightToAimAt(ground).value_or(height_);
    stayAbove(ground);
  }
}

void Aircraft::step(double dt, const Ground& ground) {
  steer(dt);
  follow(dt, ground);
  move(dt, ground);
  stayAbove(ground);
}

void Aircraft::steer(double dt) {
  roll_ += (controls_.turn * kMaxRoll - roll_) * -std::expm1(-dt / kRollTime);
  heading_ = wrapped(heading_ + roll_ / kMaxRoll * kTurnRate * dt);
  const double acceleration = kAcceleration + kAccelerationShare * speed_;
  speed_ = std::clamp(speed_ + controls_.throttle * acceleration * dt, kMinSpeed, kMaxSpeed);
  const double rate = kClearanceRate + kClearanceShare * clearance_;
  clearance_ = std::clamp(clearance_ + controls_.climb * rate * dt, kMinClearance, kMaxClearance);
}

void Aircraft::move(double dt, const Ground& ground) {
  const double distance = speed_ * dt;
  const Result<Position> next =
      position_.movedBy(distance * std::sin(heading_), distance * std::cos(heading_), ground.pitch());
  if (next) position_ = *next;
  height_ += climbRate_ * dt;
}

// Aims at the height it should have, with the climb rate and its change limited: a smooth path, which can be
// flown.
void Aircraft::follow(double dt, const Ground& ground) {
  const std::optional<double> aim = heightToAimAt(ground);
  if (aim && !flying_) {
    height_ = *aim;
    flying_ = true;
  }
  const double wanted =
      aim ? std::clamp((*aim - height_) * kFollowRate, -kDescentSlope * speed_, kClimbSlope * speed_) : 0.0;
  climbRate_ += std::clamp(wanted - climbRate_, -kPushDown * dt, kPullUp * dt);
}

// The clearance above the ground below, and above the ground ahead less what can be climbed on the way there.
// Following with a rate k lags a time 1/k behind, so the aim is that far ahead of the aircraft: then a steady
// slope is followed without lag.
std::optional<double> Aircraft::heightToAimAt(const Ground& ground) const {
  const double lead = speed_ / kFollowRate;
  const double beyond = std::max(kLookAheadAtLeast, kLookAheadTime * speed_);
  const double turn = roll_ / kMaxRoll * kTurnRate / speed_;  // [rad] per metre
  std::optional<double> aim;
  double east = 0.0, north = 0.0, distance = 0.0;
  for (int look = 0; look <= kNearLooks + kFarLooks; ++look) {
    const Result<Position> there = position_.movedBy(east, north, ground.pitch());
    if (!there) break;
    if (const std::optional<double> low = floor(*there, ground)) {
      const double needed = *low + clearance_ - kPlannedSlope * std::max(0.0, distance - lead);
      aim = aim ? std::max(*aim, needed) : needed;
    }
    const double stride = look < kNearLooks ? lead / kNearLooks : beyond / kFarLooks;
    const double heading = heading_ + turn * (distance + 0.5 * stride);
    east += stride * std::sin(heading);
    north += stride * std::cos(heading);
    distance += stride;
  }
  return aim;
}

// The last word, whatever the ground does: a wall that grew overnight lifts the aircraft onto its edge.
void Aircraft::stayAbove(const Ground& ground) {
  const std::optional<double> low = floor(position_, ground);
  if (!low) {
    heightAboveGround_.reset();
    return;
  }
  if (height_ < *low + kHardClearance) {
    height_ = *low + kHardClearance;
    climbRate_ = std::max(climbRate_, 0.0);
  }
  heightAboveGround_ = height_ - *low;
}

std::optional<double> Aircraft::floor(const Position& position, const Ground& ground) const {
  const std::optional<double> height = ground.height(position);
  if (!height) return std::nullopt;
  return std::max(*height, waterLevel_);
}

Motion Aircraft::motion() const {
  return {position_, height_, speed_ * std::sin(heading_), speed_ * std::cos(heading_), climbRate_};
}

Pose Aircraft::pose() const noexcept {
  return {position_, height_, heading_, std::atan2(climbRate_, speed_), roll_};
}

}  // namespace teren
