#include "apps/fly/Flight.h"

#include <cmath>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

#include "teren/PluginRegistry.h"

namespace teren {
namespace {

/// A flight over the default world with a small view.
std::unique_ptr<Flight> flightAt(const Position& position, double speed) {
  Result<std::shared_ptr<const World>> world =
      World::create(WorldDescription::standard(), *PluginRegistry::standard());
  if (!world) return nullptr;
  Result<std::unique_ptr<Engine>> engine =
      Engine::create(std::move(world).value(), {.view = {.level = 2, .radius = 2}});
  if (!engine) return nullptr;
  return std::make_unique<Flight>(std::move(engine).value(),
                                  AircraftStart{.position = position, .heading = 0.3, .speed = speed});
}

const auto kToTheEnd = [](std::size_t, std::size_t) { return true; };

TEST(Flight, BeginsAboveTheGroundOnceItHasSettled) {
  const std::unique_ptr<Flight> flight = flightAt({100, -40, 0.5, 0.5}, 60.0);
  ASSERT_TRUE(flight);
  flight->settle(kToTheEnd);
  for (const Aircraft* aircraft : flight->aircraft()) {
    ASSERT_TRUE(aircraft->heightAboveGround());
    EXPECT_GE(*aircraft->heightAboveGround(), AircraftStart{}.clearance - 1e-6);
    EXPECT_EQ(aircraft->motion().position.i / 2, 50);
  }
}

TEST(Flight, NeverLetsAnAircraftBelowTheKnownGround) {
  const std::unique_ptr<Flight> flight = flightAt({18, -230, 0.0, 0.0}, 250.0);
  ASSERT_TRUE(flight);
  flight->settle(kToTheEnd);
  AircraftControls low;
  low.climb = -1.0;
  int looks = 0;
  for (int frame = 0; frame < 600; ++frame) {
    low.turn = frame % 200 < 60 ? 1.0 : 0.0;
    flight->advance(1.0 / 30.0, low);
    for (const Aircraft* aircraft : flight->aircraft()) {
      // Of ground that has come since it moved it knows at its next step.
      if (!aircraft->heightAboveGround()) continue;
      ++looks;
      ASSERT_GE(*aircraft->heightAboveGround(), Aircraft::kHardClearance - 1e-9);
    }
  }
  EXPECT_GT(looks, 600);  // of 1200
}

TEST(Flight, SteersTheActiveAircraftOnly) {
  const std::unique_ptr<Flight> flight = flightAt({}, 60.0);
  ASSERT_TRUE(flight);
  flight->nextObject();
  EXPECT_EQ(flight->active(), 1U);
  for (int frame = 0; frame < 60; ++frame) flight->advance(1.0 / 60.0, {.turn = 1.0});
  EXPECT_EQ(flight->aircraft()[0]->heading(), 0.3);
  EXPECT_GT(flight->aircraft()[1]->heading(), 0.4);
  flight->nextObject();
  EXPECT_EQ(flight->active(), 0U);
}

TEST(Flight, LimitsHowFarOneFrameCanMoveIt) {
  const std::unique_ptr<Flight> flight = flightAt({}, 100.0);
  ASSERT_TRUE(flight);
  const Position before = flight->activeAircraft().motion().position;
  flight->advance(3600.0, {});
  const Offset flown = offset(before, flight->activeAircraft().motion().position, 64.0);
  EXPECT_NEAR(std::hypot(flown.east, flown.north), 100.0 * Flight::kLongestStep, 1e-6);
  EXPECT_EQ(flight->engineTimes().count(), 1U);
}

}  // namespace
}  // namespace teren
