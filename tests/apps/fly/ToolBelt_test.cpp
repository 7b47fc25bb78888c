#include "apps/fly/ToolBelt.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/EditedGround.h"
#include "teren/PluginRegistry.h"

namespace teren {
namespace {

using Tool = ToolBelt::Tool;

constexpr ToolGround kGround{64.0, 2.0};
constexpr Tool kAll[] = {Tool::dig,  Tool::heap,   Tool::smooth, Tool::crater,
                         Tool::rake, Tool::shovel, Tool::pour};
const auto kAllAreThere = [](std::string_view) { return true; };

Position at(double east, double north) {
  return Position::fromMetres(east, north, kGround.pitch).value();
}

ToolBelt with(Tool tool) {
  ToolBelt belt;
  while (belt.inHand() != tool) belt.takeNext(kAllAreThere);
  return belt;
}

TEST(ToolBelt, GoesThroughItsToolsAndThenHoldsNone) {
  ToolBelt belt;
  EXPECT_FALSE(belt.inHand());
  for (const Tool tool : kAll) {
    EXPECT_TRUE(belt.takeNext(kAllAreThere).empty());
    EXPECT_EQ(belt.inHand(), tool);
  }
  belt.takeNext(kAllAreThere);
  EXPECT_FALSE(belt.inHand());
  EXPECT_TRUE(belt.press({}).empty());
}

TEST(ToolBelt, PassesOverToolsWithoutADeformerAndNamesThem) {
  ToolBelt belt;
  const auto passed = belt.takeNext([](std::string_view) { return false; });
  EXPECT_EQ(passed.size(), 7U);
  EXPECT_FALSE(belt.inHand());
  const auto isCrater = [](std::string_view kind) { return kind == "crater"; };
  for (int turn = 0; turn < 4; ++turn) EXPECT_TRUE(belt.takeNext(isCrater).empty());
  EXPECT_EQ(belt.takeNext(isCrater), (std::vector<Tool>{Tool::rake, Tool::shovel, Tool::pour}));
  EXPECT_FALSE(belt.inHand());
}

TEST(ToolBelt, IsMadeOfStampsThatTheDeformerTakes) {
  const PluginRegistry& registry = *PluginRegistry::standard();
  for (const Tool tool : kAll) {
    ToolBelt belt = with(tool);
    for (int turn = 0; turn < 20; ++turn) belt.resize(-1);
    for (int step = 0; step < 20; ++step, belt.resize(1)) {
      for (int turn = 0; turn < 20; ++turn) belt.deepen(turn < 10 ? -1 : 1);
      for (int turn = 0; turn < 15; ++turn, belt.deepen(1)) {
        std::vector<Edit> edits = belt.press(at(10.0, 20.0));
        for (const Edit& edit : belt.press(at(10.0, 20.0 + 1.5 * belt.spacing()))) {
          edits.push_back(edit);
        }
        belt.lift();
        ASSERT_FALSE(edits.empty());
        for (const Edit& edit : edits) {
          ASSERT_TRUE(checkEdit(edit).ok()) << editText(edit);
          EXPECT_EQ(edit.kind, ToolBelt::kindOf(tool));
          const auto values = Values::check(registry.find(edit.kind)->parameters, edit.parameters, edit.kind);
          ASSERT_TRUE(values.ok()) << values.error().message;
          const Stamp stamp{.size = edit.size, .depth = edit.depth, .values = *values};
          const auto reach = (*registry.makeDeformer(edit.kind))->reach(stamp, kGround.spacing);
          ASSERT_TRUE(reach.ok()) << editText(edit) << ": " << reach.error().message;
        }
      }
    }
  }
}

TEST(ToolBelt, StampsAlongTheWayOfTheHandEvenlySpacedHoweverItIsCutUp) {
  for (const double stride : {0.3, 7.0, 41.0}) {
    ToolBelt belt = with(Tool::dig);
    std::vector<Edit> all = belt.press(at(0.0, 0.0));
    ASSERT_EQ(all.size(), 1U);
    double way = 0.0;
    while (way < 205.0) {
      way += stride;
      for (const Edit& edit : belt.press(at(0.6 * way, 0.8 * way))) all.push_back(edit);
    }
    EXPECT_EQ(all.size(), static_cast<std::size_t>(way / belt.spacing()) + 1) << stride;
    for (std::size_t k = 0; k < all.size(); ++k) {
      EXPECT_NEAR(all[k].x, 0.6 * belt.spacing() * static_cast<double>(k), 1e-6);
      EXPECT_NEAR(all[k].y, 0.8 * belt.spacing() * static_cast<double>(k), 1e-6);
    }
  }
}

TEST(ToolBelt, LeavesOutWhatLiesBetweenWhereTheHandJumps) {
  ToolBelt belt = with(Tool::dig);
  belt.press(at(0.0, 0.0));
  EXPECT_EQ(belt.press(at(5000.0, 0.0)).size(), 1U);
  EXPECT_EQ(belt.press(at(5000.0 + belt.spacing(), 0.0)).size(), 1U);
  belt.lift();
  EXPECT_EQ(belt.press(at(0.0, 0.0)).size(), 1U) << "a new stroke begins at once";
}

TEST(ToolBelt, PushesTheRakeTheWayItGoes) {
  ToolBelt belt = with(Tool::rake);
  EXPECT_TRUE(belt.press(at(100.0, 0.0)).empty()) << "which way it goes is not known yet";
  const auto north = belt.press(at(100.0, 1.2 * belt.spacing()));
  ASSERT_EQ(north.size(), 1U);
  EXPECT_NEAR(north[0].y, belt.spacing(), 1e-9);
  const std::vector<Values::Entry> pushed = {
      {"tool", std::string("rake")}, {"push", true}, {"direction", 90.0}};
  EXPECT_EQ(north[0].parameters, pushed);
  const auto south = belt.press(at(100.0, -1.2 * belt.spacing()));
  ASSERT_EQ(south.size(), 2U);
  EXPECT_EQ(std::get<double>(south[0].parameters.back().second), 270.0);
}

TEST(ToolBelt, MakesToolsInSandNoLargerThanSandTakes) {
  ToolBelt belt = with(Tool::shovel);
  belt.standOn({16.0, 0.5});
  for (int turn = 0; turn < 30; ++turn) belt.resize(1);
  EXPECT_EQ(belt.size(), 0.5 * ToolBelt::kMostSand);
  EXPECT_EQ(belt.press({})[0].size, belt.size());
}

TEST(ToolBelt, PressesNoDeeperIntoSandThanThatComesToRestSoon) {
  const auto world = World::create(
      WorldDescription::fromJson(R"({ "layers": [ { "generator": "constant" } ] })", "the test's").value(),
      *PluginRegistry::standard());
  ASSERT_TRUE(world.ok());
  for (const Tool tool : {Tool::shovel, Tool::pour}) {
    ToolBelt belt = with(tool);
    for (int turn = 0; turn < 30; ++turn) belt.resize(1);
    for (int turn = 0; turn < 30; ++turn) belt.deepen(1);
    EXPECT_EQ(belt.depth(), ToolBelt::kDeepestSand * kGround.spacing);
    EditedGround ground(*world, deformersOf(PluginRegistry::standard()));
    belt.press({});
    belt.lift();
    std::vector<Edit> edits = belt.press({});
    for (Edit& edit : belt.press(at(0.0, 1.5 * belt.spacing()))) edits.push_back(std::move(edit));
    std::uint64_t steps = 0;
    for (Edit& edit : edits) {
      edit.steps = ground.stepsSinceEdit();
      ASSERT_TRUE(ground.apply(edit).ok());
      ASSERT_TRUE(ground.rest().ok());
      steps = std::max(steps, ground.stepsSinceEdit());
    }
    EXPECT_LT(steps, 4000U) << ToolBelt::nameOf(tool);
  }
}

TEST(ToolBelt, GivesEachStrokeANumberOfItsOwn) {
  ToolBelt belt = with(Tool::dig);
  belt.press(at(0.0, 0.0));
  const std::uint64_t first = belt.stroke();
  belt.press(at(0.0, 50.0));
  EXPECT_EQ(belt.stroke(), first);
  belt.press(at(5000.0, 0.0));
  EXPECT_EQ(belt.stroke(), first) << "the hand jumped, but was not lifted";
  belt.lift();
  belt.press(at(0.0, 0.0));
  EXPECT_NE(belt.stroke(), first);
}

TEST(ToolBelt, DigsDownAndHeapsUpAndIsNeverDeeperThanLarge) {
  EXPECT_GT(with(Tool::dig).press({})[0].depth, 0.0);
  EXPECT_LT(with(Tool::heap).press({})[0].depth, 0.0);
  ToolBelt belt = with(Tool::crater);
  for (int turn = 0; turn < 30; ++turn) belt.deepen(1);
  for (int turn = 0; turn < 30; ++turn) belt.resize(-1);
  EXPECT_EQ(belt.depth(), belt.size());
  EXPECT_EQ(belt.press({})[0].depth, belt.size());
}

TEST(ToolBelt, GivesACraterTheSameSeedInTheSamePlaceOnly) {
  ToolBelt belt = with(Tool::crater);
  const auto seed = [&](double east) {
    belt.lift();
    return belt.press(at(east, 3.0))[0].seed;
  };
  EXPECT_EQ(seed(1.0), seed(1.0));
  EXPECT_NE(seed(1.0), seed(2.0));
}

}  // namespace
}  // namespace teren
