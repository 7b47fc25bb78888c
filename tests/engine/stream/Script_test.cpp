#include "teren/Script.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPitch = 64.0;

struct Exact {
  long double east = 0.0L, north = 0.0L;
};

/// Clockwise from a direction: what a heading's sine and cosine are.
Exact turnedFrom(const Course& course, long double angle, long double right, long double ahead) {
  const long double length =
      std::hypot(static_cast<long double>(course.east), static_cast<long double>(course.north));
  const long double e = course.east / length, n = course.north / length;
  const long double r = right * std::cos(angle) + ahead * std::sin(angle);
  const long double a = ahead * std::cos(angle) - right * std::sin(angle);
  return {a * e + r * n, a * n - r * e};
}

/// Metres from the start, without rounding in between.
Exact gone(const Course& course, const Motion& motion) {
  const Position &from = course.start, &to = motion.position;
  return {
      (static_cast<long double>(to.i - from.i) + (static_cast<long double>(to.u) - from.u)) * course.pitch,
      (static_cast<long double>(to.j - from.j) + (static_cast<long double>(to.v) - from.v)) * course.pitch};
}

/// The published bound after a flight of `seconds`.
double bound(const Course& course, double seconds) {
  return kScriptError * course.speed * seconds + 1e-9;
}

void expectNear(const Course& course, const Motion& motion, const Exact& exact, double seconds) {
  const Exact there = gone(course, motion);
  ASSERT_LE(std::hypot(static_cast<double>(there.east - exact.east),
                       static_cast<double>(there.north - exact.north)),
            bound(course, seconds))
      << seconds << " s";
}

std::vector<Course> courses() {
  return {{},
          {.start = {-5, 70, 0.25, 0.75}, .east = 3.0, .north = -4.0, .speed = 300.0},
          {.start = {std::int64_t{1} << 40, -3, 0.1, 0.9},
           .east = -1e-200,
           .north = 3e-200,
           .speed = 1e4,
           .pitch = 10.0}};
}

/// Times of an hour at 60 Hz, thinned out.
template <class Check>
void overAnHour(Check check) {
  for (std::uint64_t k = 0; k < 4000; ++k) {
    check(static_cast<double>(k < 1000 ? k : hashWith(11, k) % 216'000) / 60.0);
    if (testing::Test::HasFatalFailure()) return;
  }
  check(3600.0);
}

TEST(Script, StraightLeadsWhereItPoints) {
  for (const Course& course : courses()) {
    const auto script = *straightScript(course);
    overAnHour([&](double seconds) {
      const long double distance = static_cast<long double>(course.speed) * seconds;
      expectNear(course, *script->at(seconds), turnedFrom(course, 0.0L, 0.0L, distance), seconds);
    });
  }
}

TEST(Script, NorthIsExactlyNorth) {
  const auto script = *straightScript({.speed = 96.0});
  const Motion motion = *script->at(10.5);
  EXPECT_EQ(motion.position, (Position{0, 15, 0.0, 0.75}));
  EXPECT_EQ(motion.east, 0.0);
  EXPECT_EQ(motion.north, 96.0);
}

TEST(Script, CirclesStayOnTheirCircleForAnHour) {
  for (const Course& course : courses()) {
    for (const bool clockwise : {true, false}) {
      const double radius = 700.0;
      const auto script = *circleScript(course, radius, clockwise);
      const long double side = clockwise ? 1.0L : -1.0L;
      overAnHour([&](double seconds) {
        const long double angle = static_cast<long double>(course.speed) * seconds / radius;
        const Exact exact =
            turnedFrom(course, 0.0L, side * radius * (1.0L - std::cos(angle)), radius * std::sin(angle));
        const Motion motion = *script->at(seconds);
        expectNear(course, motion, exact, seconds);
        const Exact velocity = turnedFrom(course, side * angle, 0.0L, course.speed);
        const double most = course.speed * (kScriptError * course.speed * seconds / radius + 1e-14);
        ASSERT_NEAR(motion.east, static_cast<double>(velocity.east), most) << seconds;
        ASSERT_NEAR(motion.north, static_cast<double>(velocity.north), most) << seconds;
      });
    }
  }
}

TEST(Script, CirclesOfAnySizeKeepTheirAccuracy) {
  const Course course{.speed = 300.0};
  for (const double radius : {1e-3, 1.0, 1e6, 1e12}) {
    const auto script = *circleScript(course, radius);
    overAnHour([&](double seconds) {
      const long double half = static_cast<long double>(course.speed) * seconds / radius / 2.0L;
      const Exact exact{2.0L * radius * std::sin(half) * std::sin(half),
                        2.0L * radius * std::sin(half) * std::cos(half)};
      expectNear(course, *script->at(seconds), exact, seconds);
    });
  }
}

/// The turns as they are published, leg after leg, in long double.
Exact turnsBySteps(const Course& course, double seconds) {
  long double left = seconds, heading = 0.0L;
  Exact at;
  for (std::size_t leg = 0;; leg = (leg + 1) % kTurnLegEighths.size()) {
    const long double time = std::min<long double>(left, kTurnLegSeconds);
    const long double angle = std::numbers::pi_v<long double> / 4.0L * kTurnLegEighths[leg];
    const long double rate = angle / kTurnLegSeconds;
    Exact step{0.0L, course.speed * time};
    if (angle != 0.0L) {
      step = {course.speed / rate * (1.0L - std::cos(rate * time)),
              course.speed / rate * std::sin(rate * time)};
    }
    const Exact turnedStep = turnedFrom(course, heading, step.east, step.north);
    at = {at.east + turnedStep.east, at.north + turnedStep.north};
    heading += angle;
    left -= time;
    if (left <= 0.0L) return at;
  }
}

TEST(Script, TurnsAreAsPublishedForAnHour) {
  for (const Course& course : courses()) {
    const auto script = *turnsScript(course);
    overAnHour([&](double seconds) {
      expectNear(course, *script->at(seconds), turnsBySteps(course, seconds), seconds);
    });
  }
}

TEST(Script, TurnsNeitherJumpNorBend) {
  const Course course{.speed = 300.0};
  const auto script = *turnsScript(course);
  Motion before = *script->at(0.0);
  for (int tick = 1; tick <= 60 * 240; ++tick) {
    const Motion now = *script->at(tick / 60.0);
    const Offset moved = offset(before.position, now.position, kPitch);
    ASSERT_NEAR(std::hypot(moved.east, moved.north), 5.0, 0.001) << tick;
    ASSERT_NEAR(std::hypot(now.east, now.north), 300.0, 1e-9) << tick;
    ASSERT_LT(std::hypot(now.east - before.east, now.north - before.north), 300.0 * 0.16 / 60.0) << tick;
    before = now;
  }
}

TEST(Script, TurnsGetOn) {
  const auto script = *turnsScript({.speed = 300.0});
  const Offset gone = offset({}, (*script->at(600.0)).position, kPitch);
  EXPECT_GT(std::hypot(gone.east, gone.north), 40e3);
}

TEST(Script, WaypointsAreReachedInTime) {
  const std::vector<Waypoint> points{{{0, 0, 0.5, 0.5}, 100.0},
                                     {{10, 0, 0.5, 0.5}, 100.0},
                                     {{10, 0, 0.5, 0.5}, 100.0},
                                     {{10, 0, 0.5, 0.5}, 400.0},
                                     {{10, -20, 0.5, 0.5}, 400.0}};
  const auto script = *waypointScript(points, 10.0, kPitch);
  EXPECT_EQ((*script->at(0.0)).position, points[0].position);
  const Motion first = *script->at(32.0);
  EXPECT_EQ(first.position, (Position{5, 0, 0.5, 0.5}));
  EXPECT_EQ(first.east, 10.0);
  const Motion lifted = *script->at(64.0 + 15.0);
  EXPECT_EQ(lifted.position, points[1].position);
  EXPECT_EQ(lifted.height, 250.0);
  EXPECT_EQ(lifted.up, 10.0);
  for (const double seconds : {222.0, 1e9}) {
    const Motion last = *script->at(seconds);
    EXPECT_EQ(last.position, points[4].position);
    EXPECT_EQ(last.height, 400.0);
    EXPECT_EQ(last.north, 0.0);
  }
}

TEST(Script, WaypointsInALoopComeRoundForAnHourAtMost1e8Away) {
  const std::vector<Waypoint> square{
      {{0, 0, 0.0, 0.0}, 5.0}, {{1, 0, 0.0, 0.0}, 5.0}, {{1, 1, 0.0, 0.0}, 5.0}, {{0, 1, 0.0, 0.0}, 5.0}};
  const auto script = *waypointScript(square, 300.0, kPitch, true);
  overAnHour([&](double seconds) {
    const long double round = std::fmod(300.0L * seconds, 256.0L);
    const long double east = round < 64 ? round : round < 128 ? 64 : round < 192 ? 192 - round : 0;
    const long double north = round < 64 ? 0 : round < 128 ? round - 64 : round < 192 ? 64 : 256 - round;
    const Offset at = offset({}, (*script->at(seconds)).position, kPitch);
    ASSERT_NEAR(at.east, static_cast<double>(east), 1e-8) << seconds;
    ASSERT_NEAR(at.north, static_cast<double>(north), 1e-8) << seconds;
  });
}

TEST(Script, OfOneWaypointStands) {
  for (const bool loop : {false, true}) {
    const auto script = *waypointScript({{{3, 4, 0.5, 0.5}, 7.0}}, 10.0, kPitch, loop);
    EXPECT_EQ((*script->at(1e6)).position, (Position{3, 4, 0.5, 0.5}));
    EXPECT_EQ((*script->at(1e6)).north, 0.0);
  }
}

TEST(Script, RefusesWhatIsNotAWay) {
  const Waypoint here{};
  const double nan = std::nan("");
  for (const auto& refused :
       {straightScript({.speed = nan}), straightScript({.speed = -1.0}),
        straightScript({.height = kInfinity}), straightScript({.east = 0.0, .north = 0.0}),
        straightScript({.start = {0, 0, nan, 0.0}}), straightScript({.pitch = 0.0}),
        turnsScript({.east = kInfinity}), circleScript({}, 0.0), circleScript({}, nan),
        circleScript({}, kInfinity), waypointScript({}, 1.0, kPitch), waypointScript({here}, 0.0, kPitch),
        waypointScript({here}, nan, kPitch), waypointScript({here}, 1.0, -1.0),
        waypointScript({{{}, nan}}, 1.0, kPitch), waypointScript({here, {{}, 1e200}}, 1.0, kPitch)}) {
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().message.find("script"), std::string::npos) << refused.error().message;
    EXPECT_EQ(refused.error().message.find('\n'), std::string::npos);
  }
}

TEST(Script, RefusesToLeaveTheWorldAndGoesOnBefore) {
  for (const auto& made : {straightScript({.speed = 1e300}), turnsScript({.speed = 1e300})}) {
    const auto script = *made;
    EXPECT_TRUE(script->at(0.0).ok());
    EXPECT_FALSE(script->at(1.0).ok());
    EXPECT_FALSE(script->at(1e300).ok());
    EXPECT_FALSE(script->at(kInfinity).ok());
  }
  const auto circle = *circleScript({.speed = 1e300}, 100.0);
  EXPECT_TRUE(circle->at(1.0).ok());
  EXPECT_FALSE(circle->at(1e10).ok());
}

class Plain final : public Ground {
 public:
  std::optional<double> height(const Position&) const override { return low; }
  double pitch() const noexcept override { return kPitch; }
  std::optional<double> low;
};

TEST(ScriptedObject, IsAfterAnHourWhereItsScriptIs) {
  const auto script = *turnsScript({.speed = 300.0});
  ScriptedObject object(script);
  const Plain ground;
  for (int tick = 0; tick < 216'000; ++tick) object.update(1.0 / 60.0, ground);
  // 1/60 is no binary fraction, so an hour of it is not quite an hour.
  const double hour = static_cast<double>(216'000.0L * static_cast<long double>(1.0 / 60.0));
  EXPECT_EQ(object.seconds(), hour);
  EXPECT_EQ(object.motion().position, (*script->at(hour)).position);
}

TEST(ScriptedObject, KeepsItsClearanceAboveTheGroundItKnows) {
  ScriptedObject object(*straightScript({.height = 50.0}), {.clearance = 100.0});
  Plain ground;
  object.update(1.0, ground);
  EXPECT_EQ(object.motion().height, 50.0);
  ground.low = 7.0;
  object.update(1.0, ground);
  EXPECT_EQ(object.motion().height, 107.0);
  ground.low.reset();
  object.update(1.0, ground);
  EXPECT_EQ(object.motion().height, 107.0);
  EXPECT_EQ(object.motion().position.y(kPitch), 300.0);
}

TEST(ScriptedObject, StaysWhereItWasPlaced) {
  ScriptedObject object(*straightScript({}));
  object.place({{5, 5, 0.0, 0.0}, 12.0});
  object.update(1.0, Plain());
  EXPECT_TRUE(object.ended());
  EXPECT_EQ(object.motion().position, (Position{5, 5, 0.0, 0.0}));
  EXPECT_EQ(object.motion().height, 12.0);
}

TEST(ScriptedObject, StandsWhereItsScriptLeavesTheWorld) {
  ScriptedObject object(*straightScript({.speed = 1e17}));
  for (int tick = 0; tick < 10; ++tick) object.update(1.0, Plain());
  const Position end = object.motion().position;
  EXPECT_LT(end.j, kMaxPatch);
  EXPECT_GT(end.j, kMaxPatch / 2);
  EXPECT_EQ(object.motion().north, 0.0);
}

TEST(Object, LooksWhereItGoes) {
  ScriptedObject east(*straightScript({.east = 1.0, .north = 0.0}));
  EXPECT_NEAR(east.attitude().heading, std::numbers::pi / 2.0, 1e-15);
  ScriptedObject standing(*straightScript({.speed = 0.0}));
  EXPECT_EQ(standing.attitude().heading, 0.0);
  ScriptedObject climbing(*waypointScript({{{}, 0.0}, {{0, 1, 0.0, 0.0}, 64.0}}, 1.0, kPitch));
  EXPECT_NEAR(climbing.attitude().pitch, std::numbers::pi / 4.0, 1e-15);
}

TEST(Object, StopsAtAContactUnlessItKnowsBetter) {
  ScriptedObject object(*straightScript({}));
  object.collided({.motion = {{1, 2, 0.0, 0.0}, 3.0, 4.0, 5.0, 6.0}});
  const Motion now = object.motion();
  EXPECT_EQ(now.position, (Position{1, 2, 0.0, 0.0}));
  EXPECT_EQ(now.height, 3.0);
  EXPECT_EQ(std::hypot(now.east, now.north, now.up), 0.0);
}

}  // namespace
}  // namespace teren
