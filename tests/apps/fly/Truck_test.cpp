#include "apps/fly/Truck.h"

#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/PluginRegistry.h"

#include "apps/fly/Flight.h"
#include "tests/apps/fly/FakeGround.h"
#include "tests/engine/plugin/ScratchFolder.h"

namespace teren {
namespace {

constexpr double kDt = 1.0 / 60.0;
constexpr ToolGround kCoarse{64.0, 2.0}, kFine{64.0, 0.5};

void drive(Truck& truck, const Ground& ground, double seconds) {
  for (double gone = 0.0; gone < seconds; gone += kDt) truck.update(kDt, ground);
}

TEST(Truck, StandsOnTheGroundUntilSomebodyDrivesIt) {
  Truck truck({.position = {3, 4, 0.5, 0.5}});
  const FakeGround ground = flatGround(12.0);
  drive(truck, ground, 2.0);
  EXPECT_EQ(truck.motion().position, (Position{3, 4, 0.5, 0.5}));
  EXPECT_EQ(truck.motion().height, 12.0);
  EXPECT_TRUE(truck.takeRuts(kCoarse).empty());
  EXPECT_TRUE(truck.handle({"W", 1.0}));
  drive(truck, ground, 4.0);
  EXPECT_GT(truck.speed(), 10.0);
  truck.letGo();
  drive(truck, ground, 60.0);
  EXPECT_EQ(truck.speed(), 0.0) << "friction stops it";
  EXPECT_EQ(truck.motion().height, 12.0);
}

TEST(Truck, DrivesNoFasterThanItCanAndTurnsTheWayItIsSteered) {
  Truck truck({});
  const FakeGround ground = flatGround(0.0);
  truck.handle({"Up", 1.0});
  drive(truck, ground, 60.0);
  EXPECT_LE(truck.speed(), Truck::kTopSpeed);
  EXPECT_GT(truck.speed(), 0.75 * Truck::kTopSpeed);
  truck.handle({"Up", 0.0});
  truck.handle({"Right", 1.0});
  drive(truck, ground, 1.0);
  EXPECT_GT(truck.attitude().heading, 0.05);
  EXPECT_LT(truck.attitude().heading, 3.0);
}

TEST(Truck, LiesOnSlopesAsTheyAre) {
  const FakeGround ground([](double east, double north) { return 0.3 * east + 0.1 * north; });
  Truck truck({});
  drive(truck, ground, 3.0);
  EXPECT_NEAR(truck.attitude().pitch, std::atan(0.1), 1e-6);
  EXPECT_NEAR(truck.attitude().roll, -std::atan(0.3), 1e-6) << "its right side is the higher one";
}

TEST(Truck, IsNeverBelowTheGroundItDrivesOver) {
  const FakeGround ground(
      [](double east, double north) { return 6.0 * std::sin(0.11 * north) + 2.0 * std::sin(0.31 * east); });
  Truck truck({});
  truck.handle({"W", 1.0});
  for (int frame = 0; frame < 3000; ++frame) {
    if (frame % 300 == 0) truck.handle({"A", frame % 600 == 0 ? 1.0 : 0.0});
    truck.update(kDt, ground);
    const Motion motion = truck.motion();
    ASSERT_GE(motion.height, *ground.height(motion.position) - 1e-9) << frame;
  }
}

TEST(Truck, IsLiftedByAHeapAndFallsIntoAHole) {
  Truck truck({});
  double height = 10.0;
  const FakeGround ground([&height](double, double) { return height; });
  drive(truck, ground, 0.5);
  height = 30.0;
  truck.update(kDt, ground);
  EXPECT_EQ(truck.motion().height, 30.0);
  height = 0.0;
  drive(truck, ground, 1.0);
  EXPECT_GT(truck.motion().height, 20.0) << "it takes its time";
  EXPECT_LT(truck.motion().height, 29.0);
  drive(truck, ground, 3.0);
  EXPECT_EQ(truck.motion().height, 0.0);
}

TEST(Truck, LeavesRutsAlongItsWayUnlessItIsToldNotTo) {
  Truck truck({});
  const FakeGround ground = flatGround(0.0);
  truck.handle({"W", 1.0});
  drive(truck, ground, 3.0);
  const auto ruts = truck.takeRuts(kCoarse);
  ASSERT_GT(ruts.size(), 3U);
  for (std::size_t k = 0; k < ruts.size(); ++k) {
    ASSERT_TRUE(checkEdit(ruts[k]).ok());
    EXPECT_EQ(ruts[k].x, 0.0);
    EXPECT_GT(ruts[k].depth, 0.0);
    if (k > 0) {
      const double apart = ruts[k].y - ruts[k - 1].y;
      EXPECT_GE(apart, ruts[k].size - 1e-9);
      EXPECT_LT(apart, 2.0 * ruts[k].size) << "they overlap";
    }
  }
  EXPECT_TRUE(truck.takeRuts(kCoarse).empty()) << "each is told once";
  EXPECT_TRUE(truck.handle({"U", 1.0}));
  EXPECT_FALSE(truck.leavesRuts());
  drive(truck, ground, 1.0);
  EXPECT_TRUE(truck.takeRuts(kCoarse).empty());
  truck.handle({"U", 1.0});
  drive(truck, ground, 1.0);
  EXPECT_FALSE(truck.takeRuts(kCoarse).empty());
}

TEST(Truck, LeavesTwoRutsWhereTheGroundIsFineEnoughToTellThemApart) {
  Truck truck({});
  truck.handle({"W", 1.0});
  drive(truck, flatGround(0.0), 3.0);
  const auto ruts = truck.takeRuts(kFine);
  ASSERT_GT(ruts.size(), 3U);
  ASSERT_EQ(ruts.size() % 2, 0U);
  for (std::size_t k = 0; k < ruts.size(); k += 2) {
    EXPECT_NEAR(ruts[k + 1].x - ruts[k].x, Truck::kTrack, 1e-9);
    EXPECT_EQ(ruts[k].y, ruts[k + 1].y);
  }
}

TEST(Truck, SwimsAndLeavesNoRutsInTheWater) {
  Truck truck({.waterLevel = 5.0});
  const FakeGround ground = flatGround(-20.0);
  truck.handle({"W", 1.0});
  drive(truck, ground, 3.0);
  EXPECT_EQ(truck.motion().height, 5.0);
  EXPECT_TRUE(truck.takeRuts(kCoarse).empty());
}

TEST(Truck, WaitsWhereNoGroundIsKnown) {
  Truck truck({.position = {0, 0, 0.25, 0.25}});
  truck.handle({"W", 1.0});
  drive(truck, unknownGround(), 3.0);
  EXPECT_EQ(truck.motion().position, (Position{0, 0, 0.25, 0.25}));
}

const auto kToTheEnd = [](std::size_t, std::size_t) { return true; };
const Position kStart{1, 1, 0.5, 0.5};

/// A flight over a plain 30 m high in which somebody is about to drive.
class DrivenTruck : public testing::Test {
 protected:
  void begin(const DeformerSource& deformers) {
    const auto world = World::create(
        WorldDescription::fromJson(
            R"({ "layers": [ { "generator": "constant", "parameters": { "height": 30 } } ] })", "the test's")
            .value(),
        *PluginRegistry::standard());
    ASSERT_TRUE(world.ok());
    flight_ = std::make_unique<Flight>(Engine::create(*world, {.view = {.level = 0, .radius = 3}}).value(),
                                       AircraftStart{}, TruckStart{.position = kStart});
    ASSERT_TRUE(flight_->truck());
    flight_->setEdits(std::make_unique<LandEdits>(
        *world, deformers,
        [this](const World&) -> Result<std::filesystem::path> { return folder_ / "land.edits"; }));
    flight_->settle(kToTheEnd);
    for (int turn = 0; turn < 2; ++turn) flight_->nextObject();
    ASSERT_EQ(&flight_->activeObject(), flight_->truck());
    flight_->settle(kToTheEnd);
    EXPECT_EQ(flight_->truck()->motion().height, 30.0);
    flight_->engine().handle({"W", 1.0});
  }
  void driveOn(int frames) {
    for (int frame = 0; frame < frames; ++frame) flight_->advance(kDt);
  }
  void waitForEdits() {
    for (int turn = 0; turn < 100'000 && flight_->edits()->unfinished() > 0; ++turn) flight_->advance(0.0);
    ASSERT_EQ(flight_->edits()->unfinished(), 0U);
  }

  const ScratchFolder folder_;
  std::unique_ptr<Flight> flight_;
};

TEST_F(DrivenTruck, PressesItsRutsIntoTheLand) {
  begin(deformersOf(PluginRegistry::standard()));
  driveOn(120);
  flight_->engine().letGo();
  EXPECT_GT(flight_->edits()->edits() + flight_->edits()->unfinished(), 2U);
  waitForEdits();
  flight_->settle(kToTheEnd);
  const Position behind = kStart.movedBy(0.0, 6.0, 64.0).value();
  EXPECT_LT(flight_->engine().finestHeight(behind).value_or(1e9), 29.9) << "a rut";
  const Position beside = kStart.movedBy(-25.0, 3.0, 64.0).value();
  EXPECT_EQ(flight_->engine().finestHeight(beside).value_or(1e9), 30.0);
  EXPECT_EQ(flight_->edits()->takeMessages().size(), 0U);
}

TEST_F(DrivenTruck, LeavesNoRutsOnceNobodyDrivesIt) {
  begin(deformersOf(PluginRegistry::standard()));
  driveOn(120);
  flight_->nextObject();
  ASSERT_GT(flight_->truck()->speed(), 3.0) << "it rolls on";
  waitForEdits();
  ASSERT_TRUE(flight_->edits()->undo());
  driveOn(60 * 20);
  EXPECT_EQ(flight_->truck()->speed(), 0.0);
  EXPECT_TRUE(flight_->edits()->redo()) << "what was undone can be redone";
}

TEST_F(DrivenTruck, SaysOnceThatItLeavesNoRutsWhereNothingMakesThem) {
  begin([](std::string_view) -> Result<DeformerKind> { return Error{"there is none"}; });
  std::vector<std::string> all;
  for (int frame = 0; frame < 200; ++frame) {
    driveOn(1);
    for (std::string& message : flight_->edits()->takeMessages()) all.push_back(std::move(message));
  }
  EXPECT_EQ(all, std::vector<std::string>{"the truck leaves no ruts: there is none"});
}

TEST(Truck, IsPutOnDryLevelLandNearTheStart) {
  const auto world = World::create(WorldDescription::standard(), *PluginRegistry::standard()).value();
  const Position near = Position::fromMetres(60.0, 0.0, 64.0).value();
  const auto place = placeForTruck(*world, near, -150.0);
  ASSERT_TRUE(place);
  EXPECT_GT(world->query(*place).drawn, -150.0);
  EXPECT_FALSE(placeForTruck(*world, near, 1e6)) << "there is only water";
}

}  // namespace
}  // namespace teren
