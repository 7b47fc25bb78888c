#include "apps/fly/Aircraft.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "apps/fly/AircraftShape.h"
#include "apps/fly/FlightFigures.h"

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

constexpr double kBumpRate = 6.0;         // [m/s] at which it leaves the ground it has hit, at least
constexpr double kSpeedKept = 0.7;        // share of its speed that a blow leaves it
constexpr double kUnfeltLift = 0.02;      // [m] the ground lifts it by this much without a blow
constexpr double kScriptRollTime = 0.35;  // [s] as the pilot's
constexpr double kGravity = 9.81;         // [m/s^2]

constexpr double kLongWave = 97.0, kShortWave = 37.0;  // [s] of the autopilot's course

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
    : name_(start.name),
      model_(aircraftShape(start.paint)),
      script_(start.script),
      position_(start.position),
      waterLevel_(std::isnan(start.waterLevel) ? -std::numeric_limits<double>::infinity() : start.waterLevel),
      clearance_(bounded(start.clearance, kMinClearance, kMaxClearance, AircraftStart{}.clearance)),
      height_(clearance_ + (std::isfinite(waterLevel_) ? waterLevel_ : 0.0)),
      heading_(std::isfinite(start.heading) ? wrapped(start.heading) : 0.0),
      speed_(bounded(start.speed, kMinSpeed, kMaxSpeed, AircraftStart{}.speed)) {}

void Aircraft::setControls(const AircraftControls& controls) noexcept {
  controls_ = {bounded(controls.turn, -1.0, 1.0, 0.0), bounded(controls.throttle, -1.0, 1.0, 0.0),
               bounded(controls.climb, -1.0, 1.0, 0.0)};
}

void Aircraft::setAutopilot(bool on) noexcept {
  autopilot_ = on;
  autopilotSeconds_ = 0.0;
  if (on) script_.reset();
}

bool Aircraft::isHeld(std::string_view one, std::string_view other) const {
  return heldKeys_.contains(one) || heldKeys_.contains(other);
}

// A key counts as itself, so holding W and the up arrow and letting one go still means faster.
bool Aircraft::handle(const InputEvent& event) {
  if (event.name == "Space") {
    if (event.value > 0.0) setAutopilot(!autopilot_);
    return true;
  }
  constexpr std::array<std::string_view, 10> kKeys{"Up", "W",     "Down", "S", "Left",
                                                   "A",  "Right", "D",    "R", "F"};
  if (std::find(kKeys.begin(), kKeys.end(), event.name) == kKeys.end()) return false;
  if (event.value > 0.0) {
    heldKeys_.emplace(event.name);
    script_.reset();
    autopilot_ = false;
  } else if (const auto held = heldKeys_.find(event.name); held != heldKeys_.end()) {
    heldKeys_.erase(held);
  }
  const auto between = [](bool less, bool more) { return (more ? 1.0 : 0.0) - (less ? 1.0 : 0.0); };
  setControls({between(isHeld("Left", "A"), isHeld("Right", "D")),
               between(isHeld("Down", "S"), isHeld("Up", "W")), between(isHeld("F", "F"), isHeld("R", "R"))});
  return true;
}

void Aircraft::letGo() {
  heldKeys_.clear();
  setControls({});
}

std::vector<KeyHelp> Aircraft::keys() const {
  return {{"Up, Down  or  W, S", "faster, slower"},
          {"Left, Right  or  A, D", "turn"},
          {"R, F", "climb, descend"},
          {"Space", "autopilot, until you steer"}};
}

void Aircraft::update(double dt, const Ground& ground) {
  pitch_ = ground.pitch();
  if (std::isfinite(dt) && dt > 0.0) {
    const double steps = std::ceil(dt / kMaxStep);
    for (double done = 0.0; done < steps; done += 1.0) step(dt / steps, ground);
  } else {
    if (!flying_) height_ = heightToAimAt(ground).value_or(height_);
    stayAbove(ground);
  }
}

void Aircraft::step(double dt, const Ground& ground) {
  touchedSeconds_ += dt;
  const bool scripted = followScript(dt);
  if (!scripted) steer(dt);
  follow(dt, ground);
  if (!scripted) move(dt, ground);
  height_ += climbRate_ * dt;
  stayAbove(ground);
}

// Two slow waves whose periods do not fit together, so that no turn is like the last. Its clearance is
// brought to what is safe as a pilot would do it.
AircraftControls Aircraft::course(double dt) {
  autopilotSeconds_ += dt;
  const double wave = 0.6 * std::sin(kFullTurn * autopilotSeconds_ / kLongWave) +
                      0.4 * std::sin(kFullTurn * autopilotSeconds_ / kShortWave);
  const double sharpest = std::min(1.0, kCoursePull / (kTurnRate * speed_));
  const double climb = std::clamp((kSafeClearance - clearance_) / kClearanceRate, -1.0, 1.0);
  return {.turn = sharpest * wave, .throttle = 0.0, .climb = climb};
}

void Aircraft::steer(double dt) {
  const AircraftControls controls = autopilot_ ? course(dt) : controls_;
  roll_ += (controls.turn * kMaxRoll - roll_) * -std::expm1(-dt / kRollTime);
  heading_ = wrapped(heading_ + roll_ / kMaxRoll * kTurnRate * dt);
  const double acceleration = kAcceleration + kAccelerationShare * speed_;
  speed_ = std::clamp(speed_ + controls.throttle * acceleration * dt, kMinSpeed, kMaxSpeed);
  const double rate = kClearanceRate + kClearanceShare * clearance_;
  clearance_ = std::clamp(clearance_ + controls.climb * rate * dt, kMinClearance, kMaxClearance);
}

void Aircraft::move(double dt, const Ground& ground) {
  const double distance = speed_ * dt;
  const Result<Position> next =
      position_.movedBy(distance * std::sin(heading_), distance * std::cos(heading_), ground.pitch());
  if (next) position_ = *next;
}

// Where the script says and as fast, leaning into its turns. Its end is the end of the world or a collision.
bool Aircraft::followScript(double dt) {
  if (!script_) return false;
  scriptSeconds_ += dt;
  const Result<Motion> next = script_->at(scriptSeconds_);
  if (!next) {
    script_.reset();
    return false;
  }
  const double before = heading_;
  position_ = next->position;
  speed_ = std::sqrt(next->east * next->east + next->north * next->north);
  turnTo(next->east, next->north);
  const double rate = std::remainder(heading_ - before, kFullTurn) / dt;
  const double wanted = std::clamp(std::atan(rate * speed_ / kGravity), -kMaxRoll, kMaxRoll);
  roll_ += (wanted - roll_) * -std::expm1(-dt / kScriptRollTime);
  return true;
}

void Aircraft::turnTo(double east, double north) {
  if (east != 0.0 || north != 0.0) heading_ = wrapped(std::atan2(east, north));
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
  if (const double lift = *low + kHardClearance - height_; lift > 0.0) {
    height_ = *low + kHardClearance;
    if (flying_ && lift > kUnfeltLift) {
      say("the ground", std::hypot(speed_, climbRate_));
      climbRate_ = std::max(climbRate_, kBumpRate);
    }
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

void Aircraft::place(const Motion& motion) {
  position_ = motion.position;
  height_ = motion.height;
  turnTo(motion.east, motion.north);
  speed_ = std::clamp(std::hypot(motion.east, motion.north), kMinSpeed, kMaxSpeed);
  climbRate_ = motion.up;
}

// Thrown back along the normal: off the ground by its whole speed into it, off another of equal mass by half
// of the speed between them.
void Aircraft::collided(const Contact& contact) {
  script_.reset();
  Motion after = contact.motion;
  const auto& n = contact.normal;
  const auto& other = contact.otherVelocity;
  const double into =
      (other[0] - after.east) * n[0] + (other[1] - after.north) * n[1] + (other[2] - after.up) * n[2];
  const double share = std::max(0.0, into) * (1.0 + kBounce) * (contact.other ? 0.5 : 1.0);
  after.east = kSpeedKept * (after.east + share * n[0]);
  after.north = kSpeedKept * (after.north + share * n[1]);
  after.up += share * n[2];
  if (!contact.other) after.up = std::max(after.up, kBumpRate);
  place(after);
  say(contact.other ? contact.other->name() : "the ground", into);
}

void Aircraft::say(const std::string& what, double speed) {
  ++touches_;
  touched_ = what + " at " + groupedNumber(speed, 0) + " m/s";
  touchedSeconds_ = 0.0;
}

std::vector<DisplayLine> Aircraft::headUpDisplay() const {
  std::vector<DisplayLine> lines =
      flightLines({position_, pitch_, height_, heightAboveGround_, speed_, heading_});
  if (script_) lines.push_back({"pilot", "follows a script"});
  if (autopilot_) lines.push_back({"pilot", "autopilot"});
  if (touchedSeconds_ < kTouchShown) lines.push_back({"HIT", touched_, true});
  return lines;
}

Attitude Aircraft::attitude() const {
  return {heading_, std::atan2(climbRate_, speed_), roll_};
}

}  // namespace teren
