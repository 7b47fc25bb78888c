#include "teren/Script.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <utility>

#include "teren/Parameter.h"

#include "stream/Turn.h"

namespace teren {
namespace {

/// To the right and ahead of a direction.
struct Step {
  double right = 0.0, ahead = 0.0;
};

struct Direction {
  double east = 0.0, north = 1.0;  // unit

  // With fma in so many words: of two products added and two subtracted side by side, GCC 12.2 makes fused
  // instructions by itself where the processor has them, whatever -ffp-contract says (GCC bug 106902).
  Offset of(const Step& step) const {
    return {std::fma(step.ahead, east, step.right * north),
            std::fma(step.ahead, north, -(step.right * east))};
  }
};

/// Where an arc of `turns` (to the right if positive, |turns| <= 1) and the given radius ends, seen from its
/// beginning; in half angles, so that short arcs lose nothing.
Step arc(double turns, double radius) {
  const UnitVector half = turned(0.5 * turns);
  return {2.0 * radius * half.sine * half.sine, 2.0 * radius * half.sine * half.cosine};
}

/// A direction of length 1, `turns` to the right of straight ahead.
Step ahead(double turns) {
  const UnitVector unit = turned(turns);
  return {unit.sine, unit.cosine};
}

struct NamedValue {
  const char* name;
  double value;
};

Result<void> checkFinite(std::initializer_list<NamedValue> values) {
  for (const auto& [name, value] : values) {
    if (!std::isfinite(value)) {
      return Error{std::string("a script's ") + name + " is " + numberText(value) + ", not a finite number"};
    }
  }
  return {};
}

Result<void> checkCourse(const Course& course) {
  const Result<void> finite = checkFinite({{"start", course.start.u + course.start.v},
                                           {"height", course.height},
                                           {"direction", course.east},
                                           {"direction", course.north},
                                           {"speed", course.speed},
                                           {"pitch", course.pitch}});
  if (!finite) return finite;
  if (course.speed < 0.0) return Error{"a script's speed is " + numberText(course.speed) + ", less than 0"};
  if (course.pitch <= 0.0) return Error{"a script's pitch is " + numberText(course.pitch) + ", not above 0"};
  if (course.east == 0.0 && course.north == 0.0) return Error{"a script's direction has no length"};
  return {};
}

Direction unit(double east, double north) {
  const double most = std::max(std::fabs(east), std::fabs(north));
  const double x = east / most, y = north / most;
  const double length = std::sqrt(x * x + y * y);
  return {x / length, y / length};
}

/// A script on the level whose way is known as steps from the start.
class LevelScript : public Script {
 public:
  explicit LevelScript(const Course& course) : course_(course), direction_(unit(course.east, course.north)) {}

  Result<Motion> at(double seconds) const final {
    const double since = std::max(0.0, seconds), distance = course_.speed * since;
    if (!std::isfinite(distance)) {
      return Error{"a script's way after " + numberText(seconds) + " s is " + numberText(distance) +
                   " m, not a finite number"};
    }
    const auto [step, heading] = way(since);
    const Offset gone = direction_.of(step), velocity = direction_.of(heading);
    const Result<Position> position = course_.start.movedBy(gone.east, gone.north, course_.pitch);
    if (!position) return position.error();
    return Motion{*position, course_.height, course_.speed * velocity.east, course_.speed * velocity.north,
                  0.0};
  }

 protected:
  struct Way {
    Step gone, heading;  // [m] from the start, and a direction of length 1
  };
  /// `seconds` and the distance gone in them are finite and >= 0.
  virtual Way way(double seconds) const = 0;
  double speed() const noexcept { return course_.speed; }

 private:
  Course course_;
  Direction direction_;
};

class StraightScript final : public LevelScript {
 public:
  using LevelScript::LevelScript;

 private:
  Way way(double seconds) const override { return {{0.0, speed() * seconds}, {0.0, 1.0}}; }
};

class CircleScript final : public LevelScript {
 public:
  CircleScript(const Course& course, double radius, bool clockwise)
      : LevelScript(course), radius_(radius), side_(clockwise ? 1.0 : -1.0) {}

 private:
  Way way(double seconds) const override {
    const double turns = speed() * seconds / (2.0 * std::numbers::pi * radius_);
    const double share = turns - std::floor(turns);
    Way way{arc(share, radius_), ahead(share)};
    way.gone.right *= side_;
    way.heading.right *= side_;
    return way;
  }

  double radius_, side_;
};

class TurnsScript final : public LevelScript {
 public:
  explicit TurnsScript(const Course& course) : LevelScript(course) {
    Step at;
    int eighths = 0;
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
      starts_[leg] = at;
      headings_[leg] = eighths / 8.0;
      at = onLeg(leg, kTurnLegSeconds).gone;
      eighths += kTurnLegEighths[leg];
    }
    assert(eighths == 0);
    round_ = at;
  }

 private:
  static constexpr std::size_t kLegs = kTurnLegEighths.size();
  static constexpr double kRoundSeconds = kLegs * kTurnLegSeconds;

  /// At a speed of 1, from the beginning of the round.
  Way onLeg(std::size_t leg, double seconds) const {
    const double turns = kTurnLegEighths[leg] * (seconds / kTurnLegSeconds) / 8.0;
    Step step{0.0, seconds};
    if (kTurnLegEighths[leg] != 0) {
      step = arc(turns, kTurnLegSeconds * 8.0 / (kTurnLegEighths[leg] * 2.0 * std::numbers::pi));
    }
    const Step forwards = ahead(headings_[leg]);
    const Offset turnedStep = Direction{forwards.right, forwards.ahead}.of(step);
    return {{starts_[leg].right + turnedStep.east, starts_[leg].ahead + turnedStep.north},
            ahead(headings_[leg] + turns)};
  }

  Way way(double seconds) const override {
    const double rounds = std::floor(seconds / kRoundSeconds);
    // The quotient may have rounded up to a whole number: then the rest is a little below zero.
    const double rest = std::max(0.0, std::fma(-rounds, kRoundSeconds, seconds));
    const double leg = std::min(std::floor(rest / kTurnLegSeconds), static_cast<double>(kLegs - 1));
    Way way = onLeg(static_cast<std::size_t>(leg), std::fma(-leg, kTurnLegSeconds, rest));
    way.gone.right = speed() * std::fma(rounds, round_.right, way.gone.right);
    way.gone.ahead = speed() * std::fma(rounds, round_.ahead, way.gone.ahead);
    return way;
  }

  std::array<Step, kLegs> starts_{};
  std::array<double, kLegs> headings_{};  // in turns
  Step round_;
};

class WaypointScript final : public Script {
 public:
  struct Leg {
    Waypoint from;
    double east = 0.0, north = 0.0, up = 0.0;  // [m] to its end
    double begin = 0.0, length = 0.0;          // [m] from the start, and its own
  };

  WaypointScript(std::vector<Leg> legs, Waypoint last, double speed, double pitch, bool loop)
      : legs_(std::move(legs)), last_(std::move(last)), speed_(speed), pitch_(pitch), loop_(loop) {
    if (!legs_.empty()) length_ = legs_.back().begin + legs_.back().length;
  }

  Result<Motion> at(double seconds) const override {
    double distance = speed_ * std::max(0.0, seconds);
    if (legs_.empty() || (!loop_ && distance >= length_)) return Motion{last_.position, last_.height};
    if (loop_) distance = std::max(0.0, std::fma(-std::floor(distance / length_), length_, distance));
    const auto after = std::upper_bound(legs_.begin(), legs_.end(), distance,
                                        [](double at, const Leg& leg) { return at < leg.begin; });
    const Leg& leg = *std::prev(after);
    const double share = std::min(1.0, (distance - leg.begin) / leg.length), rate = speed_ / leg.length;
    const Result<Position> position = leg.from.position.movedBy(share * leg.east, share * leg.north, pitch_);
    if (!position) return position.error();
    return Motion{*position, leg.from.height + share * leg.up, rate * leg.east, rate * leg.north,
                  rate * leg.up};
  }

 private:
  std::vector<Leg> legs_;  // none of length 0
  Waypoint last_;
  double speed_, pitch_, length_ = 0.0;
  bool loop_;
};

}  // namespace

Result<std::shared_ptr<const Script>> straightScript(const Course& course) {
  if (const Result<void> checked = checkCourse(course); !checked) return checked.error();
  return std::shared_ptr<const Script>(std::make_shared<StraightScript>(course));
}

Result<std::shared_ptr<const Script>> circleScript(const Course& course, double radius, bool clockwise) {
  if (const Result<void> checked = checkCourse(course); !checked) return checked.error();
  if (!std::isfinite(radius) || radius <= 0.0) {
    return Error{"a script's radius is " + numberText(radius) + ", expected a finite number above 0"};
  }
  return std::shared_ptr<const Script>(std::make_shared<CircleScript>(course, radius, clockwise));
}

Result<std::shared_ptr<const Script>> turnsScript(const Course& course) {
  if (const Result<void> checked = checkCourse(course); !checked) return checked.error();
  return std::shared_ptr<const Script>(std::make_shared<TurnsScript>(course));
}

Result<std::shared_ptr<const Script>> waypointScript(const std::vector<Waypoint>& points, double speed,
                                                     double pitch, bool loop) {
  if (points.empty()) return Error{"a script has no waypoints"};
  if (const Result<void> finite = checkFinite({{"speed", speed}, {"pitch", pitch}}); !finite) {
    return finite.error();
  }
  if (speed <= 0.0) return Error{"a script's speed is " + numberText(speed) + ", not above 0"};
  if (pitch <= 0.0) return Error{"a script's pitch is " + numberText(pitch) + ", not above 0"};
  std::vector<WaypointScript::Leg> legs;
  double length = 0.0;
  for (std::size_t k = 0; k < points.size() + (loop ? 1 : 0); ++k) {
    const Waypoint& to = points[k % points.size()];
    const Result<void> finite =
        checkFinite({{"waypoint", to.position.u + to.position.v}, {"waypoint's height", to.height}});
    if (!finite) return finite.error();
    if (k == 0) continue;
    const Waypoint& from = points[k - 1];
    const Offset way = offset(from.position, to.position, pitch);
    WaypointScript::Leg leg{from, way.east, way.north, to.height - from.height, length, 0.0};
    leg.length = std::sqrt(leg.east * leg.east + leg.north * leg.north + leg.up * leg.up);
    length += leg.length;
    if (leg.length > 0.0) legs.push_back(leg);
  }
  if (!std::isfinite(length)) return Error{"a script's waypoints lie farther apart than can be counted"};
  return std::shared_ptr<const Script>(
      std::make_shared<WaypointScript>(std::move(legs), points.back(), speed, pitch, loop));
}

ScriptedObject::ScriptedObject(std::shared_ptr<const Script> script, ScriptedObjectOptions options)
    : script_(std::move(script)), options_(std::move(options)) {
  assert(script_);
  follow();
}

void ScriptedObject::update(double dt, const Ground& ground) {
  if (ended_) return;
  // Neumaier's sum: what a dt loses by being added to a long time is kept apart.
  const double sum = seconds_ + dt;
  lostSeconds_ += std::fabs(seconds_) >= std::fabs(dt) ? (seconds_ - sum) + dt : (dt - sum) + seconds_;
  seconds_ = sum;
  const double height = motion_.height;
  follow();
  if (!options_.clearance) return;
  const std::optional<double> low = ground.height(motion_.position);
  motion_.height = low ? *low + *options_.clearance : height;
}

void ScriptedObject::follow() {
  const Result<Motion> next = script_->at(seconds());
  if (next) {
    motion_ = *next;
  } else {
    motion_.east = motion_.north = motion_.up = 0.0;
  }
}

void ScriptedObject::place(const Motion& motion) {
  motion_ = motion;
  ended_ = true;
}

}  // namespace teren
