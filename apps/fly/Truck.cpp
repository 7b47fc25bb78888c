#include "apps/fly/Truck.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "teren/World.h"

#include "apps/fly/FlightFigures.h"
#include "apps/fly/TruckShape.h"

namespace teren {
namespace {

constexpr double kGravity = 9.81;       // [m/s^2]
constexpr double kEngine = 8.0;         // [m/s^2] at full throttle
constexpr double kDrag = 0.2;           // [1/s]
constexpr double kFriction = 1.5;       // [m/s^2] of the wheels
constexpr double kHolds = 0.7;          // [rad] slope on which it stands with its brakes on
constexpr double kMaxSteer = 0.55;      // [rad] of the front wheels, at walking speed
constexpr double kSteerSpeed = 9.0;     // [m/s] at which half of that is left
constexpr double kSteerTime = 0.15;     // [s]
constexpr double kSwayTime = 0.08;      // [s] in which its body follows the ground
constexpr double kSticks = 0.12;        // [m] above ground at which the wheels still touch
constexpr double kBetweenPrints = 0.3;  // [m]
constexpr std::size_t kMostPrints = 4096;
constexpr double kLeastRut = 0.9;       // [m] radius, of a wheel
constexpr double kSamplesOfARut = 1.5;  // its radius, at least
constexpr double kTwoRuts = 1.3;        // [m] radius up to which two rows of wheels are told apart

}  // namespace

Truck::Truck(const TruckStart& start)
    : model_(truckShape()),
      position_(start.position),
      waterLevel_(std::isnan(start.waterLevel) ? -std::numeric_limits<double>::infinity() : start.waterLevel),
      heading_(std::isfinite(start.heading) ? start.heading : 0.0) {}

double Truck::between(std::string_view one, std::string_view two, std::string_view three,
                      std::string_view four) const {
  const auto held = [this](std::string_view key) { return heldKeys_.contains(key); };
  return (held(three) || held(four) ? 1.0 : 0.0) - (held(one) || held(two) ? 1.0 : 0.0);
}

bool Truck::handle(const InputEvent& event) {
  if (event.name == "U") {
    if (event.value > 0.0) leavesRuts_ = !leavesRuts_;
    return true;
  }
  constexpr std::array<std::string_view, 8> kKeys{"Up", "W", "Down", "S", "Left", "A", "Right", "D"};
  if (std::find(kKeys.begin(), kKeys.end(), event.name) == kKeys.end()) return false;
  if (event.value > 0.0) {
    heldKeys_.emplace(event.name);
  } else if (const auto held = heldKeys_.find(event.name); held != heldKeys_.end()) {
    heldKeys_.erase(held);
  }
  return true;
}

std::vector<KeyHelp> Truck::keys() const {
  return {{"Up, Down  or  W, S", "drive, brake and drive back"},
          {"Left, Right  or  A, D", "steer"},
          {"U", "leave ruts, or none"}};
}

void Truck::update(double dt, const Ground& ground) {
  worldPitch_ = ground.pitch();
  if (!(std::isfinite(dt) && dt > 0.0)) return lieOn(0.0, ground);
  const double steps = std::ceil(dt / kMaxStep);
  for (double done = 0.0; done < steps; done += 1.0) step(dt / steps, ground);
}

void Truck::step(double dt, const Ground& ground) {
  if (floor(0.0, 0.0, ground)) {
    drive(dt);
    const double way = speed_ * std::cos(pitch_) * dt;
    const Result<Position> next =
        position_.movedBy(way * std::sin(heading_), way * std::cos(heading_), worldPitch_);
    if (next) position_ = *next;
  }
  lieOn(dt, ground);
  if (!leavesRuts_ || !stands_ || swims_ || !isKnown_ || prints_.size() >= kMostPrints) return;
  if (!prints_.empty()) {
    const Offset way = offset(prints_.back().position, position_, worldPitch_);
    if (std::hypot(way.east, way.north) < kBetweenPrints) return;
  }
  if (speed_ != 0.0) prints_.push_back({position_, heading_});
}

// Wheels that hang in the air neither drive nor steer.
void Truck::drive(double dt) {
  const double throttle = between("Down", "S", "Up", "W");
  const double wanted =
      between("Left", "A", "Right", "D") * kMaxSteer / (1.0 + std::abs(speed_) / kSteerSpeed);
  steer_ += (wanted - steer_) * -std::expm1(-dt / kSteerTime);
  if (!stands_) return;
  heading_ = std::remainder(heading_ + speed_ * std::tan(steer_) / kWheelbase * dt, 2.0 * std::numbers::pi);
  if (heading_ < 0.0) heading_ += 2.0 * std::numbers::pi;
  const double before = speed_;
  speed_ += (kEngine * throttle - kGravity * std::sin(pitch_) - kDrag * speed_) * dt;
  const double friction = kFriction * dt;
  speed_ -= std::clamp(speed_, -friction, friction);
  const bool stops = before * speed_ <= 0.0 && std::abs(pitch_) < kHolds;
  if (throttle == 0.0 && stops) speed_ = 0.0;
  speed_ = std::clamp(speed_, -0.4 * kTopSpeed, 1.5 * kTopSpeed);
}

void Truck::lieOn(double dt, const Ground& ground) {
  const std::optional<double> low = floor(0.0, 0.0, ground);
  if (!low) return;
  swims_ = *low <= waterLevel_;
  climbRate_ -= kGravity * dt;
  height_ += climbRate_ * dt;
  stands_ = !isKnown_ || dt <= 0.0 || height_ <= *low + kSticks;
  if (stands_) height_ = *low;
  isKnown_ = true;
  if (!stands_) return;
  const auto sway = [dt](double& angle, double wanted) {
    angle += (wanted - angle) * (dt > 0.0 ? -std::expm1(-dt / kSwayTime) : 1.0);
  };
  const auto slope = [&](double ahead, double right, double apart) {
    const std::optional<double> one = floor(ahead, right, ground), other = floor(-ahead, -right, ground);
    return one && other ? std::atan2(*one - *other, apart) : 0.0;
  };
  sway(pitch_, slope(0.5 * kWheelbase, 0.0, kWheelbase));
  sway(roll_, slope(0.0, -0.5 * kTrack, kTrack));
  climbRate_ = speed_ * std::sin(pitch_);
}

std::optional<double> Truck::floor(double ahead, double right, const Ground& ground) const {
  const double sine = std::sin(heading_), cosine = std::cos(heading_);
  const Result<Position> there =
      position_.movedBy(ahead * sine + right * cosine, ahead * cosine - right * sine, ground.pitch());
  const std::optional<double> height = there ? ground.height(*there) : std::nullopt;
  if (!height) return std::nullopt;
  return std::max(*height, waterLevel_);
}

Motion Truck::motion() const {
  const double level = speed_ * std::cos(pitch_);
  return {position_, height_, level * std::sin(heading_), level * std::cos(heading_), climbRate_};
}

void Truck::place(const Motion& motion) {
  position_ = motion.position;
  height_ = motion.height;
  const double ahead = motion.east * std::sin(heading_) + motion.north * std::cos(heading_);
  speed_ = std::clamp(ahead, -kTopSpeed, kTopSpeed);
  climbRate_ = motion.up;
}

void Truck::collided(const Contact& contact) {
  place(contact.motion);
  speed_ *= contact.other ? -0.3 : 0.5;
}

std::vector<Edit> Truck::takeRuts(const ToolGround& ground) {
  const double radius = std::max(kLeastRut, kSamplesOfARut * ground.spacing);
  std::vector<Edit> edits;
  for (const Print& print : std::exchange(prints_, {})) {
    if (lastRut_) {
      const Offset way = offset(lastRut_->position, print.position, ground.pitch);
      if (std::hypot(way.east, way.north) < radius) continue;
    }
    lastRut_ = print;
    const auto press = [&](double right) {
      const Result<Position> there = print.position.movedBy(right * std::cos(print.heading),
                                                            -right * std::sin(print.heading), ground.pitch);
      if (there) edits.push_back(craterEdit(*there, ground.pitch, radius, kRutDepth * radius, 0.25, 0.0));
    };
    if (radius > kTwoRuts) {
      press(0.0);
    } else {
      for (const double side : {-0.5, 0.5}) press(side * kTrack);
    }
  }
  return edits;
}

std::vector<DisplayLine> Truck::headUpDisplay() const {
  std::vector<DisplayLine> lines = flightLines(
      {position_, worldPitch_, height_, stands_ ? 0.0 : std::optional<double>(), speed_, heading_});
  std::erase_if(lines, [](const DisplayLine& line) { return line.what == "above ground"; });
  lines.push_back({"wheels", !stands_ ? "in the air" : swims_ ? "in the water" : "on the ground"});
  lines.push_back({"ruts", leavesRuts_ ? "yes" : "no"});
  return lines;
}

std::optional<Position> placeForTruck(const World& world, const Position& near, double waterLevel) {
  constexpr int kRings = 20, kDirections = 12;
  constexpr double kApart = 100.0, kDry = 3.0, kLevel = 0.94;  // [m], [m], cosine of the slope
  for (int place = 0; place < kRings * kDirections; ++place) {
    const double distance = kApart * (place / kDirections + 1);
    const double turn = 2.0 * std::numbers::pi * (place % kDirections) / kDirections;
    const Result<Position> there =
        near.movedBy(distance * std::sin(turn), distance * std::cos(turn), world.pitch());
    if (!there) continue;
    const SurfacePoint ground = world.query(*there);
    if (ground.drawn > waterLevel + kDry && ground.normal[2] > kLevel) return *there;
  }
  return std::nullopt;
}

}  // namespace teren
