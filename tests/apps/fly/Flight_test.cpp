#include "apps/fly/Flight.h"

#include <cmath>
#include <memory>
#include <tuple>
#include <utility>

#include <gtest/gtest.h>

#include "teren/PluginRegistry.h"

#include "apps/fly/CameraRig.h"

namespace teren {
namespace {

/// A flight over the default world with a small view.
std::unique_ptr<Flight> flightAt(const Position& position, double speed, double heading = 0.3) {
  Result<std::shared_ptr<const World>> world =
      World::create(WorldDescription::standard(), *PluginRegistry::standard());
  if (!world) return nullptr;
  Result<std::unique_ptr<Engine>> engine =
      Engine::create(std::move(world).value(), {.view = {.level = 2, .radius = 2}});
  if (!engine) return nullptr;
  return std::make_unique<Flight>(std::move(engine).value(),
                                  AircraftStart{.position = position, .heading = heading, .speed = speed});
}

const auto kToTheEnd = [](std::size_t, std::size_t) { return true; };

TEST(Flight, BeginsAboveTheGroundOnceItHasSettled) {
  const std::unique_ptr<Flight> flight = flightAt({100, -40, 0.5, 0.5}, 60.0);
  ASSERT_TRUE(flight);
  flight->settle(kToTheEnd);
  for (const Aircraft* aircraft : flight->aircraft()) {
    ASSERT_TRUE(aircraft->heightAboveGround());
    EXPECT_GE(*aircraft->heightAboveGround(), AircraftStart{}.clearance - Flight::kLower - 1e-6);
    const Offset away = offset({100, -40, 0.5, 0.5}, aircraft->motion().position, 64.0);
    EXPECT_LT(std::hypot(away.east, away.north), 90.0);
  }
}

TEST(Flight, NeverLetsAnAircraftBelowTheKnownGround) {
  const std::unique_ptr<Flight> flight = flightAt({18, -230, 0.0, 0.0}, 250.0);
  ASSERT_TRUE(flight);
  flight->settle(kToTheEnd);
  flight->engine().handle({"F", 1.0});
  int looks = 0;
  for (int frame = 0; frame < 600; ++frame) {
    flight->engine().handle({"Right", frame % 200 < 60 ? 1.0 : 0.0});
    flight->advance(1.0 / 30.0);
    for (const Aircraft* aircraft : flight->aircraft()) {
      // Of ground that has come since it moved it knows at its next step.
      if (!aircraft->heightAboveGround()) continue;
      ++looks;
      ASSERT_GE(*aircraft->heightAboveGround(), Aircraft::kHardClearance - 1e-9);
    }
  }
  EXPECT_GT(looks, 600);  // of 1200
}

std::unique_ptr<Engine> engineOfSeed(std::uint64_t seed) {
  WorldDescription description = WorldDescription::standard();
  description.seed = seed;
  const auto world = World::create(description, *PluginRegistry::standard()).value();
  return Engine::create(world, {.view = {.level = 2, .radius = 2}}).value();
}

TEST(Flight, GoesOverToAnotherLandWhereItIsOnceThatIsThere) {
  const std::unique_ptr<Flight> flight = flightAt({100, -40, 0.5, 0.5}, 60.0);
  ASSERT_TRUE(flight);
  flight->settle(kToTheEnd);
  flight->nextObject();
  std::unique_ptr<Engine> next = engineOfSeed(77);
  const World* const land = &next->world();
  flight->goOverTo(std::move(next));
  Motion before;
  int frames = 0;
  while (flight->isLeaving() && frames < 100'000) {
    ASSERT_NE(&flight->engine().world(), land);
    before = flight->aircraft()[0]->motion();
    flight->advance(0.001);
    ++frames;
  }
  EXPECT_GT(frames, 1) << "land takes time to be made";
  EXPECT_EQ(flight->changes(), 1);
  EXPECT_EQ(&flight->engine().world(), land);
  EXPECT_EQ(flight->engine().objectCount(), 2U);
  EXPECT_EQ(flight->active(), 1U);
  const Offset way = offset(before.position, flight->aircraft()[0]->motion().position, 64.0);
  EXPECT_LT(std::hypot(way.east, way.north), 0.1);
  EXPECT_TRUE(flight->aircraft()[1]->followsScript());
  EXPECT_GE(flight->engine().figures().nodes, 25U);
  for (const Aircraft* aircraft : flight->aircraft()) {
    EXPECT_TRUE(flight->engine().finestHeight(aircraft->motion().position)) << aircraft->name();
  }
  flight->advance(0.1);
  EXPECT_TRUE(flight->aircraft()[0]->heightAboveGround());
}

TEST(Flight, GoesOverToTheLastLandItWasGiven) {
  const std::unique_ptr<Flight> flight = flightAt({}, 60.0);
  ASSERT_TRUE(flight);
  flight->settle(kToTheEnd);
  flight->goOverTo(engineOfSeed(77));
  flight->advance(0.001);
  std::unique_ptr<Engine> last = engineOfSeed(78);
  const World* const land = &last->world();
  flight->goOverTo(std::move(last));
  for (int frame = 0; flight->isLeaving() && frame < 100'000; ++frame) flight->advance(0.001);
  EXPECT_EQ(&flight->engine().world(), land);
  EXPECT_EQ(flight->changes(), 1);
}

TEST(Flight, KeysReachTheActiveAircraftOnly) {
  const std::unique_ptr<Flight> flight = flightAt({}, 60.0);
  ASSERT_TRUE(flight);
  flight->engine().handle({"Left", 1.0});
  flight->nextObject();  // and so lets go of it
  EXPECT_EQ(flight->active(), 1U);
  flight->engine().handle({"Right", 1.0});
  for (int frame = 0; frame < 60; ++frame) flight->advance(1.0 / 60.0);
  EXPECT_EQ(flight->aircraft()[0]->heading(), 0.3);
  EXPECT_GT(flight->aircraft()[1]->heading(), 0.4);
  EXPECT_FALSE(flight->aircraft()[1]->followsScript());
  flight->nextObject();
  EXPECT_EQ(flight->active(), 0U);
}

/// Metres of the second aircraft ahead and to the left of the first.
std::pair<double, double> aheadAndLeft(const Flight& flight) {
  const Aircraft &first = *flight.aircraft()[0], &second = *flight.aircraft()[1];
  const Offset away = offset(first.motion().position, second.motion().position, 64.0);
  const double sine = std::sin(first.heading()), cosine = std::cos(first.heading());
  return {away.east * sine + away.north * cosine, away.north * sine - away.east * cosine};
}

TEST(Flight, TheSecondAircraftPassesOnTheLeft) {
  for (const double heading : {0.0, 0.3, 4.0}) {
    const std::unique_ptr<Flight> flight = flightAt({0, 0, 60.0 / 64.0, 0.0}, 60.0, heading);
    ASSERT_TRUE(flight);
    flight->settle(kToTheEnd);
    const Position start = flight->aircraft()[1]->motion().position;
    if (heading == 0.0) {
      EXPECT_EQ(start, (*Position::fromMetres(0.0, -60.0, 64.0)));
    }
    double ahead = 0.0, left = 0.0, before = -1e9;
    for (int frame = 0; frame < 60 * 5; ++frame) {
      std::tie(ahead, left) = aheadAndLeft(*flight);
      ASSERT_NEAR(left, 60.0, 1e-6);
      ASSERT_GT(ahead, before) << "it never falls back";
      if (frame == 0) {
        EXPECT_NEAR(ahead, -60.0, 1e-6);
      }
      before = ahead;
      flight->advance(1.0 / 60.0);
    }
    EXPECT_GT(ahead, 100.0);
    EXPECT_TRUE(flight->aircraft()[1]->followsScript());
  }
}

TEST(Flight, TheSecondAircraftIsInTheLeftOfThePictureAsItPasses) {
  const std::unique_ptr<Flight> flight = flightAt({0, 0, 60.0 / 64.0, 0.0}, 60.0, 0.0);
  ASSERT_TRUE(flight);
  flight->settle(kToTheEnd);
  CameraRig rig;
  int seen = 0;
  for (int frame = 0; frame < 60 * 8; ++frame) {
    flight->advance(1.0 / 60.0);
    rig.update(1.0 / 60.0, {}, poseOf(flight->activeObject()));
    const Viewpoint view = rig.viewpoint(poseOf(flight->activeObject()), flight->engine().ground(), -1e9);
    const Motion second = flight->aircraft()[1]->motion();
    const Offset away = offset(view.pose.position, second.position, 64.0);  // the view is to the north
    const double up = std::atan2(second.height - view.pose.height, away.north) - view.pose.pitch;
    const double left = std::atan2(-away.east, away.north);
    const double half = 0.5 * view.fieldOfView;
    const bool inPicture =
        away.north > 0.0 && std::abs(up) < half && std::abs(std::tan(left)) < std::tan(half) * 16.0 / 9.0;
    if (inPicture) {
      EXPECT_GT(left, 0.0);
      ++seen;
    }
    if (frame >= 60 * 3 && frame < 60 * 6) {
      EXPECT_TRUE(inPicture) << frame / 60.0 << " s";
    }
  }
  EXPECT_GT(seen, 60 * 4);
}

TEST(Flight, AnAircraftDrivenIntoAHillIsNeverBelowTheGround) {
  for (const double speed : {100.0, 1e3, 1e4, 1e6}) {
    const std::unique_ptr<Flight> flight = flightAt({3, 8, 0.5, 0.5}, speed < 500.0 ? 60.0 : 600.0);
    ASSERT_TRUE(flight);
    flight->settle(kToTheEnd);
    Aircraft& aircraft = *flight->aircraft()[0];
    for (int frame = 0; frame < 120; ++frame) {
      Motion dive = aircraft.motion();
      dive.up = -speed;
      aircraft.place(dive);
      flight->advance(frame % 2 == 0 ? 0.1 : 1.0 / 60.0);
      const auto low = flight->engine().finestHeight(aircraft.motion().position);
      ASSERT_TRUE(low);
      ASSERT_GT(aircraft.motion().height, *low + 0.99 * Aircraft::kRadius) << speed << ", frame " << frame;
    }
    EXPECT_GT(aircraft.touches(), 5) << speed;
  }
}

TEST(Flight, TwoAircraftThatMeetThrowEachOtherBackAndSaySo) {
  const std::unique_ptr<Flight> flight = flightAt({}, 60.0, 0.0);
  ASSERT_TRUE(flight);
  flight->settle(kToTheEnd);
  Aircraft &first = *flight->aircraft()[0], &second = *flight->aircraft()[1];
  flight->advance(1.0 / 60.0);
  Motion opposite = first.motion();
  opposite.position = *opposite.position.movedBy(0.0, 20.0, 64.0);
  opposite.north = -60.0;
  second.place(opposite);
  second.handle({"S", 1.0});  // its pilot takes over from the script
  second.letGo();
  for (int frame = 0; frame < 30; ++frame) flight->advance(1.0 / 60.0);
  EXPECT_EQ(first.touches(), 1);
  EXPECT_EQ(second.touches(), 1);
  EXPECT_EQ(first.touched(), "the second aircraft at 120 m/s");
  const Offset apart = offset(first.motion().position, second.motion().position, 64.0);
  EXPECT_GT(apart.north, 2.0 * Aircraft::kRadius);
  EXPECT_EQ(first.headUpDisplay().back().what, "HIT");
}

TEST(Flight, LimitsHowFarOneFrameCanMoveIt) {
  const std::unique_ptr<Flight> flight = flightAt({}, 100.0);
  ASSERT_TRUE(flight);
  const Position before = flight->activeObject().motion().position;
  flight->advance(3600.0);
  const Offset flown = offset(before, flight->activeObject().motion().position, 64.0);
  EXPECT_NEAR(std::hypot(flown.east, flown.north), 100.0 * Flight::kLongestStep, 1e-6);
  EXPECT_EQ(flight->engineTimes().count(), 1U);
}

}  // namespace
}  // namespace teren
