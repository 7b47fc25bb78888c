#include "apps/fly/Aircraft.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/apps/fly/FakeGround.h"

namespace teren {
namespace {

constexpr double kPi = std::numbers::pi;

double heightOf(const FakeGround& ground, const Aircraft& aircraft) {
  return aircraft.motion().height - *ground.height(aircraft.motion().position);
}

/// Hills, steps and spikes of up to some 500 m, the same everywhere for one seed.
FakeGround wildGround() {
  return FakeGround([](double east, double north) {
    const double hills = 220.0 * std::sin(east / 310.0) * std::cos(north / 270.0);
    const double steps = std::fmod(std::floor(north / 190.0) * 7.0 + 1e4, 5.0) * 60.0;
    const double spike = std::fmod(std::floor(north / 23.0) * 13.0 + 1e5, 17.0) == 0.0 ? 300.0 : 0.0;
    return hills + steps + spike;
  });
}

TEST(Aircraft, FliesAtItsClearanceAboveFlatGroundFromTheFirstUpdate) {
  const FakeGround ground = flatGround(321.0);
  Aircraft aircraft({.clearance = 140.0});
  aircraft.update(1.0 / 60.0, ground);
  EXPECT_DOUBLE_EQ(aircraft.motion().height, 461.0);
  aircraft.update(10.0, ground);
  EXPECT_DOUBLE_EQ(aircraft.motion().height, 461.0);
  ASSERT_TRUE(aircraft.heightAboveGround());
  EXPECT_DOUBLE_EQ(*aircraft.heightAboveGround(), 140.0);
}

TEST(Aircraft, IsPutAtItsHeightAgainAsTheGroundBecomesKnownUntilItFlies) {
  Aircraft aircraft({.clearance = 100.0});
  aircraft.update(0.0, unknownGround());
  EXPECT_EQ(aircraft.motion().height, 100.0);
  aircraft.update(0.0, flatGround(900.0));
  EXPECT_EQ(aircraft.motion().height, 1000.0);
  aircraft.update(0.0, flatGround(300.0));
  EXPECT_EQ(aircraft.motion().height, 400.0);
  aircraft.update(0.01, flatGround(300.0));
  aircraft.update(0.0, flatGround(0.0));
  EXPECT_EQ(aircraft.motion().height, 400.0);
}

TEST(Aircraft, KeepsHeadingAndSpeedWithoutInput) {
  const FakeGround ground = wildGround();
  Aircraft aircraft({.position = {3, -4, 0.25, 0.5}, .heading = 0.7, .speed = 60.0});
  const Position start = aircraft.motion().position;
  for (int frame = 0; frame < 600; ++frame) aircraft.update(1.0 / 60.0, ground);
  const Offset flown = offset(start, aircraft.motion().position, ground.pitch());
  EXPECT_NEAR(flown.east, 600.0 * std::sin(0.7), 1e-6);
  EXPECT_NEAR(flown.north, 600.0 * std::cos(0.7), 1e-6);
  EXPECT_EQ(aircraft.heading(), 0.7);
  EXPECT_EQ(aircraft.speed(), 60.0);
}

TEST(Aircraft, IsNeverBelowTheGroundWhateverTheTimeStepAndThePilot) {
  const FakeGround ground = wildGround();
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto uniform = [&random] { return static_cast<double>(random()) / 4294967296.0; };
    Aircraft aircraft({.heading = uniform() * 6.0, .speed = 20.0 + 400.0 * uniform()});
    for (int frame = 0; frame < 400; ++frame) {
      aircraft.setControls({2.0 * uniform() - 1.0, 2.0 * uniform() - 1.0, uniform() < 0.6 ? -1.0 : 1.0});
      aircraft.update(uniform() < 0.1 ? 3.0 * uniform() : 0.1 * uniform(), ground);
      ASSERT_GE(heightOf(ground, aircraft), Aircraft::kHardClearance - 1e-9) << "frame " << frame;
    }
  }
}

TEST(Aircraft, IsLiftedOverAWallThatItCannotClimb) {
  const FakeGround ground([](double, double north) { return north < 900.0 ? 0.0 : 4000.0; });
  Aircraft aircraft({.speed = 300.0});
  for (int frame = 0; frame < 8; ++frame) {
    aircraft.update(1.0, ground);
    ASSERT_GE(heightOf(ground, aircraft), Aircraft::kHardClearance);
  }
  EXPECT_GT(aircraft.motion().height, 4000.0);
}

TEST(Aircraft, ClimbsBeforeRisingGroundSoThatHalfOfItsClearanceStays) {
  const FakeGround ground(
      [](double, double north) { return north < 1500.0 ? 0.0 : std::min(300.0, 0.6 * (north - 1500.0)); });
  Aircraft aircraft({.speed = 60.0, .clearance = 130.0});
  double lowest = 1e9, before = 0.0;
  for (int frame = 0; frame < 60 * 60; ++frame) {
    aircraft.update(1.0 / 60.0, ground);
    lowest = std::min(lowest, heightOf(ground, aircraft));
    if (aircraft.motion().position.y(ground.pitch()) < 1500.0) before = aircraft.motion().height;
  }
  EXPECT_GT(before, 160.0);
  EXPECT_GT(lowest, 65.0);
}

TEST(Aircraft, FollowsASteadySlopeWithoutLag) {
  const FakeGround ground([](double, double north) { return 0.2 * north; });
  Aircraft aircraft({.speed = 60.0, .clearance = 100.0});
  aircraft.update(60.0, ground);
  EXPECT_NEAR(heightOf(ground, aircraft), 100.0, 2.0);
}

TEST(Aircraft, ChangesItsClimbRateOnlyAsFastAsACrewCouldBear) {
  const FakeGround ground(
      [](double east, double north) { return 200.0 * std::sin(east / 500.0) * std::cos(north / 400.0); });
  Aircraft aircraft({.heading = 0.5});
  aircraft.update(1.0 / 60.0, ground);
  double rate = aircraft.motion().up;
  for (int frame = 0; frame < 3600; ++frame) {
    aircraft.update(1.0 / 60.0, ground);
    ASSERT_LE(std::abs(aircraft.motion().up - rate), 14.0 / 60.0 + 1e-12) << "frame " << frame;
    rate = aircraft.motion().up;
  }
}

TEST(Aircraft, TakesWaterForGround) {
  const FakeGround ground = flatGround(-400.0);
  Aircraft aircraft({.clearance = 100.0, .waterLevel = -150.0});
  aircraft.update(5.0, ground);
  EXPECT_DOUBLE_EQ(aircraft.motion().height, -50.0);
  EXPECT_DOUBLE_EQ(*aircraft.heightAboveGround(), 100.0);
}

TEST(Aircraft, KeepsItsHeightWhereTheGroundIsUnknown) {
  Aircraft aircraft({.clearance = 100.0});
  aircraft.update(1.0, flatGround(200.0));
  aircraft.update(30.0, unknownGround());
  EXPECT_DOUBLE_EQ(aircraft.motion().height, 300.0);
  EXPECT_FALSE(aircraft.heightAboveGround());
}

TEST(Aircraft, TurnsToTheRightInClockwiseHeadingsWithTheRightWingDown) {
  const FakeGround ground = flatGround(0.0);
  Aircraft aircraft({.heading = 0.0});
  aircraft.setControls({.turn = 1.0});
  aircraft.update(2.0, ground);
  EXPECT_GT(aircraft.heading(), 0.5);
  EXPECT_LT(aircraft.heading(), 1.0);
  EXPECT_GT(aircraft.attitude().roll, 0.5);
  EXPECT_LE(aircraft.attitude().roll, Aircraft::kMaxRoll);
  const Motion motion = aircraft.motion();
  EXPECT_GT(motion.east, 0.0);
  EXPECT_NEAR(std::atan2(motion.east, motion.north), aircraft.heading(), 1e-12);

  aircraft.setControls({});
  aircraft.update(10.0, ground);
  EXPECT_NEAR(aircraft.attitude().roll, 0.0, 1e-6);
}

TEST(Aircraft, KeepsItsHeadingBetweenZeroAndAFullTurn) {
  const FakeGround ground = flatGround(0.0);
  Aircraft aircraft({.heading = -100.0});
  EXPECT_NEAR(aircraft.heading(), std::fmod(-100.0, 2.0 * kPi) + 2.0 * kPi, 1e-12);
  aircraft.setControls({.turn = -1.0});
  for (int frame = 0; frame < 2000; ++frame) {
    aircraft.update(0.05, ground);
    ASSERT_GE(aircraft.heading(), 0.0);
    ASSERT_LT(aircraft.heading(), 2.0 * kPi);
  }
}

TEST(Aircraft, StaysBetweenItsSpeedLimits) {
  const FakeGround ground = flatGround(0.0);
  EXPECT_EQ(Aircraft({.speed = 1e9}).speed(), Aircraft::kMaxSpeed);
  EXPECT_EQ(Aircraft({.speed = -1.0}).speed(), Aircraft::kMinSpeed);
  EXPECT_EQ(Aircraft({.speed = std::nan("")}).speed(), 60.0);
  Aircraft aircraft({});
  aircraft.setControls({.throttle = 1.0});
  aircraft.update(60.0, ground);
  EXPECT_EQ(aircraft.speed(), Aircraft::kMaxSpeed);
  aircraft.setControls({.throttle = -1.0});
  aircraft.update(120.0, ground);
  EXPECT_EQ(aircraft.speed(), Aircraft::kMinSpeed);
}

TEST(Aircraft, LetsThePilotChooseTheClearance) {
  const FakeGround ground = flatGround(50.0);
  Aircraft aircraft({.clearance = 100.0});
  aircraft.setControls({.climb = 1.0});
  aircraft.update(3.0, ground);
  aircraft.setControls({});
  const double chosen = aircraft.clearance();
  EXPECT_GT(chosen, 200.0);
  aircraft.update(60.0, ground);
  EXPECT_NEAR(*aircraft.heightAboveGround(), chosen, 0.5);

  aircraft.setControls({.climb = -1.0});
  aircraft.update(60.0, ground);
  EXPECT_EQ(aircraft.clearance(), Aircraft::kMinClearance);
  EXPECT_NEAR(*aircraft.heightAboveGround(), Aircraft::kMinClearance, 0.5);
}

TEST(Aircraft, FliesTheSameForTheSameSequenceOfTimeSteps) {
  const FakeGround ground = wildGround();
  const auto fly = [&ground] {
    std::mt19937 random(7);
    Aircraft aircraft({.heading = 1.0});
    std::vector<double> path;
    for (int frame = 0; frame < 500; ++frame) {
      const double dt = static_cast<double>(random() % 1000) * 1e-4;
      aircraft.setControls({.turn = static_cast<double>(random() % 3) - 1.0});
      aircraft.update(dt, ground);
      const Motion motion = aircraft.motion();
      path.insert(path.end(), {motion.position.x(64.0), motion.position.y(64.0), motion.height, motion.up});
    }
    return path;
  };
  EXPECT_EQ(fly(), fly());
}

TEST(Aircraft, IgnoresTimeStepsAndControlsThatAreNotNumbers) {
  const FakeGround ground = flatGround(0.0);
  Aircraft aircraft({});
  aircraft.update(1.0, ground);
  const Motion before = aircraft.motion();
  aircraft.setControls({std::nan(""), std::numeric_limits<double>::infinity(), std::nan("")});
  for (const double dt : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    aircraft.update(dt, ground);
    EXPECT_EQ(aircraft.motion().position, before.position);
    EXPECT_EQ(aircraft.motion().height, before.height);
  }
  aircraft.update(1.0, ground);
  EXPECT_EQ(aircraft.heading(), 0.0);
  EXPECT_EQ(aircraft.speed(), 60.0);
}

TEST(Aircraft, StandsStillAtTheEndOfTheWorld) {
  const FakeGround ground = flatGround(0.0);
  Aircraft aircraft({.position = {0, kMaxPatch, 0.0, 0.0}, .speed = 100.0});
  for (int second = 0; second < 10; ++second) aircraft.update(1.0, ground);
  EXPECT_LE(aircraft.motion().position.j, kMaxPatch);
  EXPECT_DOUBLE_EQ(*aircraft.heightAboveGround(), AircraftStart{}.clearance);
}

/// What a collision at a place says to an aircraft as it flies.
Contact contactOf(const Aircraft& aircraft, std::array<double, 3> normal) {
  Contact contact;
  contact.normal = normal;
  contact.motion = aircraft.motion();
  return contact;
}

std::string shown(const Aircraft& aircraft, const std::string& what) {
  for (const DisplayLine& line : aircraft.headUpDisplay()) {
    if (line.what == what) return line.says;
  }
  return "";
}

TEST(Aircraft, FliesByItsKeysAndLetsGoOfThem) {
  const FakeGround ground = flatGround(0.0);
  Aircraft aircraft({});
  EXPECT_TRUE(aircraft.handle({"Right", 1.0}));
  EXPECT_TRUE(aircraft.handle({"D", 1.0}));
  EXPECT_TRUE(aircraft.handle({"D", 0.0}));
  aircraft.update(1.0, ground);
  const double turned = aircraft.heading();
  EXPECT_GT(turned, 0.1) << "one of the two keys is still down";
  aircraft.letGo();
  aircraft.update(10.0, ground);
  EXPECT_LT(aircraft.heading(), turned + 0.5);
  EXPECT_TRUE(aircraft.handle({"W", 1.0}));
  EXPECT_TRUE(aircraft.handle({"R", 1.0}));
  aircraft.update(2.0, ground);
  EXPECT_GT(aircraft.speed(), 100.0);
  EXPECT_GT(aircraft.clearance(), 150.0);
  EXPECT_TRUE(aircraft.handle({"S", 1.0}));
  const double speed = aircraft.speed();
  aircraft.update(1.0, ground);
  EXPECT_EQ(aircraft.speed(), speed) << "faster and slower cancel out";
  EXPECT_FALSE(aircraft.handle({"Q", 1.0}));
  EXPECT_FALSE(aircraft.handle({"Num Up", 1.0}));
}

TEST(Aircraft, ListsEveryKeyItListensTo) {
  Aircraft aircraft({});
  std::string keys;
  for (const KeyHelp& line : aircraft.keys()) keys.append(line.keys).append(", ");
  for (const char* key : {"Up", "Down", "Left", "Right", "W", "S", "A", "D", "R", "F"}) {
    EXPECT_TRUE(aircraft.handle({key, 1.0})) << key;
    EXPECT_NE(keys.find(key), std::string::npos) << key;
  }
}

TEST(Aircraft, FollowsItsScriptUntilThePilotTouchesTheControls) {
  const FakeGround ground = flatGround(100.0);
  const auto script = *circleScript({.speed = 100.0}, 500.0);
  Aircraft aircraft({.clearance = 80.0, .script = script});
  for (int frame = 0; frame < 600; ++frame) aircraft.update(1.0 / 60.0, ground);
  const Offset off = offset((*script->at(10.0)).position, aircraft.motion().position, ground.pitch());
  EXPECT_LT(std::hypot(off.east, off.north), 1e-6);
  EXPECT_NEAR(aircraft.heading(), 2.0, 1e-6);
  EXPECT_NEAR(*aircraft.heightAboveGround(), 80.0, 1e-9);
  EXPECT_GT(aircraft.attitude().roll, 0.5) << "leans into the turn";
  EXPECT_EQ(shown(aircraft, "pilot"), "follows a script");
  aircraft.handle({"W", 1.0});
  aircraft.handle({"W", 0.0});
  EXPECT_FALSE(aircraft.followsScript());
  aircraft.update(5.0, ground);
  EXPECT_NEAR(aircraft.attitude().roll, 0.0, 1e-3);
}

TEST(Aircraft, FeelsTheGroundItHitsAndSaysSo) {
  const FakeGround ground = flatGround(0.0);
  Aircraft aircraft({.speed = 100.0});
  aircraft.update(1.0, ground);
  EXPECT_EQ(shown(aircraft, "HIT"), "");
  aircraft.collided(contactOf(aircraft, {0.0, -0.6, 0.8}));  // a slope of 37 degrees ahead
  EXPECT_EQ(aircraft.touches(), 1);
  EXPECT_GT(aircraft.motion().up, 60.0);
  EXPECT_LT(aircraft.speed(), 60.0);
  EXPECT_EQ(aircraft.heading(), 0.0) << "thrown up, not back";
  EXPECT_EQ(shown(aircraft, "HIT"), "the ground at 60 m/s");
  EXPECT_TRUE(aircraft.headUpDisplay().back().warning);
  aircraft.update(Aircraft::kTouchShown + 0.1, ground);
  EXPECT_EQ(shown(aircraft, "HIT"), "");
}

TEST(Aircraft, BouncesOffAWall) {
  Aircraft aircraft({.speed = 100.0});
  aircraft.update(1.0, flatGround(0.0));
  aircraft.collided(contactOf(aircraft, {0.0, -1.0, 0.0}));
  EXPECT_NEAR(aircraft.heading(), kPi, 1e-9);
  EXPECT_NEAR(aircraft.speed(), 0.7 * 40.0, 1e-9);
}

TEST(Aircraft, SharesTheBlowWithAnotherAircraft) {
  Aircraft aircraft({.speed = 100.0}), other({.speed = 50.0, .name = "other"});
  aircraft.update(1.0, flatGround(0.0));
  Contact contact = contactOf(aircraft, {0.0, -1.0, 0.0});
  contact.other = &other;
  contact.otherVelocity = {0.0, 50.0, 0.0};
  aircraft.collided(contact);
  EXPECT_NEAR(aircraft.speed(), 0.7 * (100.0 - 0.7 * 50.0), 1e-9);
  EXPECT_EQ(shown(aircraft, "HIT"), "other at 50 m/s");
}

TEST(Aircraft, HasAModelOfTrianglesAllOfWhosePointsExist) {
  const Aircraft aircraft({});
  std::size_t triangles = 0;
  bool spins = false;
  float widest = 0.0F;
  for (const ModelPart& part : aircraft.model().parts) {
    triangles += part.triangles.size();
    spins = spins || part.spin != 0.0F;
    for (const ModelPoint& point : part.points) widest = std::max(widest, std::abs(point[0]));
    for (const auto& triangle : part.triangles) {
      for (const std::uint32_t index : triangle) ASSERT_LT(index, part.points.size());
    }
  }
  EXPECT_GT(triangles, 300U);
  EXPECT_TRUE(spins) << "its propeller";
  EXPECT_NEAR(widest, 5.5F, 1e-6F);
}

TEST(AircraftAutopilot, FliesAGentleCourseToBothSidesAtASafeHeight) {
  const FakeGround ground(
      [](double east, double north) { return 100.0 * std::sin(east / 1500.0) * std::cos(north / 1300.0); });
  for (const double speed : {60.0, 300.0}) {
    Aircraft aircraft({.speed = speed, .clearance = 30.0});
    aircraft.setAutopilot(true);
    double left = 0.0, right = 0.0, before = aircraft.heading(), lowest = 1e9;
    for (int frame = 0; frame < 60 * 200; ++frame) {
      aircraft.update(1.0 / 60.0, ground);
      const double turn = std::remainder(aircraft.heading() - before, 2.0 * kPi);
      before = aircraft.heading();
      left = std::min(left, turn);
      right = std::max(right, turn);
      if (frame > 600) lowest = std::min(lowest, heightOf(ground, aircraft));
    }
    const double sharpest = Aircraft::kCoursePull / speed / 60.0;
    EXPECT_LT(left, -0.3 * sharpest);
    EXPECT_GT(right, 0.3 * sharpest);
    EXPECT_GE(left, -1.01 * sharpest);
    EXPECT_LE(right, 1.01 * sharpest);
    EXPECT_NEAR(aircraft.clearance(), Aircraft::kSafeClearance, 1.0);
    EXPECT_GT(lowest, 0.5 * Aircraft::kSafeClearance);
    EXPECT_EQ(aircraft.touches(), 0);
    EXPECT_NEAR(aircraft.speed(), speed, 1e-9);
  }
}

TEST(AircraftAutopilot, IsOnAndOffBySpaceAndGivesWayToEverySteeringKey) {
  const FakeGround ground = flatGround(0.0);
  for (const char* key : {"Up", "W", "Down", "S", "Left", "A", "Right", "D", "R", "F"}) {
    Aircraft aircraft({});
    EXPECT_TRUE(aircraft.handle({"Space", 1.0}));
    EXPECT_TRUE(aircraft.handle({"Space", 0.0}));
    ASSERT_TRUE(aircraft.hasAutopilot());
    EXPECT_EQ(aircraft.headUpDisplay().back().says, "autopilot");
    aircraft.update(1.0, ground);
    EXPECT_TRUE(aircraft.handle({key, 1.0}));
    EXPECT_FALSE(aircraft.hasAutopilot()) << key;
    aircraft.handle({key, 0.0});
    EXPECT_FALSE(aircraft.hasAutopilot()) << key;
  }
  Aircraft aircraft({});
  aircraft.handle({"Space", 1.0});
  aircraft.update(10.0, ground);
  aircraft.handle({"Space", 1.0});
  aircraft.update(3.0, ground);
  const double heading = aircraft.heading();
  aircraft.update(3.0, ground);
  EXPECT_NEAR(aircraft.heading(), heading, 1e-3) << "what the autopilot did is not held";
}

}  // namespace
}  // namespace teren
