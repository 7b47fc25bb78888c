// Objects that say impossible things of themselves must not break the engine, nor take the ground from
// others.
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Engine.h"

#include "tests/doors/Refusal.h"
#include "tests/doors/Registry.h"

namespace teren {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();

std::shared_ptr<const World> smallWorld() {
  WorldDescription description;
  description.samples = 9;
  LayerDescription layer;
  layer.generator = "fault";
  layer.samples = 9;
  description.layers = {layer};
  layer.pitch = 1024.0;
  description.layers.push_back(layer);
  return World::create(description, registryOfAllModules()).value();
}

std::vector<Motion> impossibleMotions() {
  std::vector<Motion> motions;
  for (const double odd : {kNaN, kInfinity, -kInfinity, 1e300, -1e300, 1.0, -0x1p-60}) {
    motions.push_back({{3, 4, odd, 0.5}});
    motions.push_back({{3, 4, 0.5, odd}});
  }
  for (const std::int64_t odd : {kMost, kLeast, kMaxPatch, -kMaxPatch - 1}) {
    motions.push_back({{odd, 4, 0.5, 0.5}});
    motions.push_back({{3, odd, 0.5, 0.5}});
    motions.push_back({{odd, odd, kNaN, kNaN}, kNaN, kNaN, kNaN, kNaN});
  }
  for (const double odd : {kNaN, kInfinity, -kInfinity, 1e300, -1e308, std::numeric_limits<double>::max()}) {
    motions.push_back({{3, 4, 0.5, 0.5}, odd});
    motions.push_back({{3, 4, 0.5, 0.5}, 0.0, odd, 0.0, 0.0});
    motions.push_back({{3, 4, 0.5, 0.5}, 0.0, odd, -odd, odd});
  }
  return motions;
}

/// An engine with a sound object at patch (3, 4) and one more beside it.
struct Stage {
  Stage() {
    engine = Engine::create(smallWorld(), {.view = {1, 1}}).value();
    engine->add(std::make_unique<Resting>(kSound));
    odd = static_cast<Resting*>(&engine->add(std::make_unique<Resting>(kSound)));
  }
  static constexpr Motion kSound{{3, 4, 0.5, 0.5}};
  std::unique_ptr<Engine> engine;
  Resting* odd;
};

TEST(ImpossibleObject, LeavesTheOthersTheirGroundAndTheView) {
  for (const std::size_t active : {std::size_t{0}, std::size_t{1}}) {
    Stage stage;
    stage.engine->setActive(active);
    stage.engine->settle();
    for (const Motion& motion : impossibleMotions()) {
      stage.odd->say(motion);
      stage.engine->update(1.0 / 60.0, std::chrono::milliseconds(2));
      stage.engine->settle();
      ASSERT_EQ(stage.engine->figures().pending, 0U);
      ASSERT_EQ(stage.engine->figures().nodes, 9U);
      ASSERT_TRUE(stage.engine->drawnHeight(Stage::kSound.position).has_value());
      ASSERT_TRUE(stage.engine->ground().height(Stage::kSound.position).has_value());
    }
    const std::vector<std::string> said = stage.engine->takeMessages();
    ASSERT_EQ(said.size(), 1U) << "each object is named once";
    expectOneSentence(said[0], {"object 2", "keeps it where it was"});
  }
}

TEST(ImpossibleObject, CountsAsWhereItWasLast) {
  Stage stage;
  stage.engine->setActive(1);
  const Motion far{{1000, -1000, 0.5, 0.5}};
  stage.odd->say(far);
  stage.engine->settle();
  stage.odd->say({{kMost, kLeast, kNaN, kNaN}});
  stage.engine->settle();
  EXPECT_TRUE(stage.engine->drawnHeight(far.position).has_value());
  EXPECT_FALSE(stage.engine->drawnHeight(Stage::kSound.position).has_value())
      << "the view stays with the object";
  stage.odd->say(Stage::kSound);
  stage.engine->settle();
  EXPECT_TRUE(stage.engine->drawnHeight(Stage::kSound.position).has_value()) << "and goes on with it";
}

TEST(ImpossibleObject, FromTheStartCountsAsAtTheWorldsZero) {
  auto engine = Engine::create(smallWorld(), {.view = {1, 1}}).value();
  engine->add(std::make_unique<Resting>(Motion{{kLeast, kMost, kInfinity, kNaN}, kNaN, kNaN, kNaN, kNaN}));
  engine->settle();
  EXPECT_EQ(engine->figures().nodes, 9U);
  EXPECT_TRUE(engine->drawnHeight({0, 0, 0.0, 0.0}).has_value());
}

TEST(ImpossiblePosition, HasNoHeight) {
  Stage stage;
  stage.engine->settle();
  for (const Motion& motion : impossibleMotions()) {
    if (motion.position.valid()) continue;
    EXPECT_FALSE(stage.engine->drawnHeight(motion.position).has_value());
    EXPECT_FALSE(stage.engine->finestHeight(motion.position).has_value());
    EXPECT_FALSE(stage.engine->ground().height(motion.position).has_value());
  }
}

TEST(ImpossibleBudget, IsTakenAsNoneOrAsMuchAsIsNeeded) {
  Stage stage;
  stage.engine->update(1.0 / 60.0, std::chrono::nanoseconds::min());
  EXPECT_EQ(stage.engine->figures().slices, 0U);
  stage.engine->update(1.0 / 60.0, std::chrono::nanoseconds::max());
  EXPECT_EQ(stage.engine->figures().pending, 0U);
}

TEST(ObjectAtTheWorldsEnd, HasAViewAndGroundAsFarAsTheWorldGoes) {
  for (const std::int64_t i : {-kMaxPatch, kMaxPatch - 1}) {
    for (const std::int64_t j : {-kMaxPatch, kMaxPatch - 1}) {
      Stage stage;
      stage.engine->setActive(1);
      stage.odd->say({{i, j, 0.5, 0.5}, 100.0, i < 0 ? -1e3 : 1e3, j < 0 ? -1e3 : 1e3, 0.0});
      stage.engine->settle();
      EXPECT_EQ(stage.engine->figures().pending, 0U);
      EXPECT_GE(stage.engine->figures().nodes, 1U);
    }
  }
}

}  // namespace
}  // namespace teren
