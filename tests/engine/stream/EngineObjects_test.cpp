// The engine under objects that are fast, far, jumping or mad.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "teren/Engine.h"

namespace teren {
namespace {

using std::chrono::milliseconds;

std::shared_ptr<const World> smallWorld(int samples = 9) {
  WorldDescription description;
  description.seed = 5;
  description.samples = samples;
  LayerDescription layer;
  layer.generator = "fault";
  layer.parameters = {{"faults", std::int64_t{10}}, {"deviation", 20.0}};
  layer.pitch = 256.0;
  layer.samples = 17;
  description.layers.push_back(layer);
  auto world = World::create(description, *PluginRegistry::standard());
  EXPECT_TRUE(world.ok()) << (world.ok() ? "" : world.error().message);
  return *world;
}

/// Flies straight on, high up.
class Rocket final : public Object {
 public:
  explicit Rocket(const Motion& motion) : motion_(motion) {}
  std::string name() const override { return "rocket"; }
  void update(double dt, const Ground& ground) override {
    const auto next = motion_.position.movedBy(motion_.east * dt, motion_.north * dt, ground.pitch());
    if (next) motion_.position = *next;
    hadGround = ground.height(motion_.position).has_value();
  }
  Motion motion() const override { return motion_; }
  void place(const Motion& motion) override { motion_ = motion; }
  std::optional<CollisionSphere> collisionSphere() const override { return CollisionSphere{2.0}; }
  bool handle(const InputEvent&) override { return true; }
  bool hadGround = false;

 private:
  Motion motion_;
};

class EngineObjects : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    auto made = Engine::create(world_, {.view = {1, 3}, .workers = GetParam()});
    ASSERT_TRUE(made.ok());
    engine_ = std::move(*made);
  }
  Rocket& add(const Motion& motion) {
    return static_cast<Rocket&>(engine_->add(std::make_unique<Rocket>(motion)));
  }

  std::shared_ptr<const World> world_ = smallWorld();
  std::unique_ptr<Engine> engine_;
};

TEST_P(EngineObjects, AnObjectAt10KilometresASecondHasGroundUnderItOnceTheMachineKeepsUp) {
  add({{}, 1e4});
  const Rocket& rocket = add({{900, 30, 0.5, 0.5}, 1e4, 6e3, -8e3});
  int missing = 0;
  for (int step = 0; step < 180; ++step) {
    engine_->update(1.0 / 60.0, milliseconds(0));
    if (step >= 60 && !rocket.hadGround) ++missing;
    engine_->settle();
  }
  EXPECT_EQ(missing, 0);
}

TEST_P(EngineObjects, AfterAJumpTheGroundComesBeforeTheView) {
  Rocket& rocket = add({{}, 1e4});
  engine_->settle();
  for (const std::int64_t away : {1'000'000, -7}) {
    const Position there{away, 3 * away, 0.5, 0.5};
    rocket.place({there, 1e4});
    std::size_t pending = 0;
    for (int step = 0; step < 100'000 && !engine_->ground().height(there); ++step) {
      engine_->update(0.0, std::chrono::microseconds(20));
      pending = engine_->figures().pending;
    }
    EXPECT_TRUE(engine_->ground().height(there));
    EXPECT_GT(pending, 40U) << "of 49 and the ground";
    engine_->settle();
    EXPECT_EQ(engine_->figures().pending, 0U);
  }
}

TEST_P(EngineObjects, AMadObjectStarvesNobody) {
  world_ = smallWorld(257);  // a node takes several updates
  for (const double speed : {1e6, 1e12, 1e300, 1.7e308}) {
    auto made = Engine::create(world_, {.view = {1, 1}, .workers = GetParam()});
    engine_ = std::move(*made);
    const Rocket& calm = add({{10, 10, 0.5, 0.5}, 1e4});
    add({{}, 1e4, speed, -speed});
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    do {
      engine_->update(1.0 / 60.0, std::chrono::microseconds(300));
    } while (engine_->figures().pending > 0 && std::chrono::steady_clock::now() < end);
    EXPECT_EQ(engine_->figures().pending, 0U) << speed;
    EXPECT_GE(engine_->figures().nodes, 9U) << speed;
    engine_->update(1.0 / 60.0, milliseconds(1));
    EXPECT_TRUE(calm.hadGround) << speed;
  }
}

TEST_P(EngineObjects, GroundThatIsLeftBeforeItCouldBeMadeIsNotWanted) {
  auto made = Engine::create(world_, {.view = {1, 1}, .workers = GetParam()});
  engine_ = std::move(*made);
  add({{}, 1e4, 1e9, -1e9});
  engine_->update(1.0 / 60.0, milliseconds(0));  // chooses, and has no time for more
  EXPECT_EQ(engine_->figures().pending, 9U);     // the view's nodes, and no ground
}

TEST_P(EngineObjects, MotionThatCannotBeIsNamedOnceAndBreaksNothing) {
  Rocket& mad = add({{3, 3, 0.5, 0.5}, 1e4});
  const Rocket& calm = add({{10, 10, 0.5, 0.5}, 1e4, 30.0});
  engine_->settle();
  const double nan = std::nan("");
  for (const Motion& bad : {Motion{{3, 3, nan, 0.5}, 1e4}, Motion{{3, 3, 0.5, 0.5}, 1e300},
                            Motion{{3, 3, 0.5, 0.5}, 1e4, nan, 0.0}}) {
    mad.place(bad);
    for (int step = 0; step < 5; ++step) engine_->update(1.0 / 60.0, milliseconds(1));
    EXPECT_TRUE(calm.hadGround);
    EXPECT_TRUE(engine_->ground().height({3, 3, 0.5, 0.5}));
  }
  engine_->update(nan, milliseconds(1));
  const std::vector<std::string> messages = engine_->takeMessages();
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_TRUE(messages[0].starts_with("object 1, \"rocket\",")) << messages[0];
  EXPECT_TRUE(messages[1].starts_with("the engine was asked to move on by nan s")) << messages[1];
  EXPECT_TRUE(engine_->takeMessages().empty());
}

TEST_P(EngineObjects, GivesItsObjectsBackInTheirOrderForAnotherEngine) {
  const Rocket& first = add({{3, 3, 0.5, 0.5}, 1e4});
  const Rocket& second = add({{10, 10, 0.5, 0.5}, 1e4, 30.0});
  engine_->setActive(1);
  engine_->settle();
  std::vector<std::unique_ptr<Object>> objects = engine_->takeObjects();
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].get(), &first);
  EXPECT_EQ(objects[1].get(), &second);
  EXPECT_EQ(engine_->objectCount(), 0U);
  EXPECT_FALSE(engine_->handle({"Up", 1.0}));
  engine_->update(1.0 / 60.0, milliseconds(1));  // goes on without any
  auto other = Engine::create(world_, {.view = {1, 3}, .workers = GetParam()});
  for (std::unique_ptr<Object>& object : objects) (*other)->add(std::move(object));
  (*other)->settle();
  engine_.reset();
  (*other)->update(1.0 / 60.0, milliseconds(1));
  EXPECT_TRUE(second.hadGround);
}

TEST_P(EngineObjects, AFallingObjectStopsOnTheGroundTheEngineMade) {
  Rocket& rocket = add({{0, 0, 0.3, 0.6}, 1e4});
  EXPECT_TRUE(engine_->handle({"A", 1.0}));
  engine_->settle();
  rocket.place({{0, 0, 0.3, 0.6}, -1e4});  // under the ground
  engine_->update(1.0 / 60.0, milliseconds(1));
  const double low = world_->query(rocket.motion().position).drawn;
  EXPECT_GT(rocket.motion().height, low + 1.999);
  EXPECT_LT(rocket.motion().height, low + 10.0);
}

INSTANTIATE_TEST_SUITE_P(Workers, EngineObjects, testing::Values(0, 2));

}  // namespace
}  // namespace teren
