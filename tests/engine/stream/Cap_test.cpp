// Law 6: one cap on bytes for everything the engine holds.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>

#include <gtest/gtest.h>

#include "teren/Engine.h"

#include "tests/engine/stream/FaultWorld.h"

namespace teren {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr std::size_t kMiB = std::size_t{1} << 20;

/// A world whose nodes take about 40 kB each, and whose base maps thousands of bytes.
std::shared_ptr<const World> largeWorld() {
  return test::faultWorld(6, 65, {512.0, 64.0}, 10);
}

/// Goes where it is told.
class Puppet final : public Object {
 public:
  void update(double, const Ground&) override {}
  Motion motion() const override { return place; }
  Motion place;
};

struct CappedEngine {
  CappedEngine(int workers, std::size_t cap, int radius = 12) : world(largeWorld()) {
    auto made = Engine::create(world, {.view = {0, radius}, .workers = workers, .capBytes = cap});
    EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().message);
    engine = std::move(*made);
    puppet = static_cast<Puppet*>(&engine->add(std::make_unique<Puppet>()));
  }
  void moveTo(double east, double north) {
    puppet->place.position = *Position::fromMetres(east, north, world->pitch());
  }
  std::shared_ptr<const World> world;
  std::unique_ptr<Engine> engine;
  Puppet* puppet;
};

using Surface = std::map<std::tuple<std::int64_t, std::int64_t>, std::tuple<float, int, int>>;

Surface surfaceOf(const Scene& scene) {
  Surface surface;
  for (const auto& mesh : scene.meshes()) {
    for (const SurfaceVertex& vertex : mesh->vertices) {
      surface[{mesh->originColumn + vertex.column, mesh->originRow + vertex.row}] = {
          vertex.height, vertex.normalX, vertex.normalY};
    }
  }
  return surface;
}

class Cap : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Workers, Cap, testing::Values(0, 1, 3));

TEST_P(Cap, HoldsAtEveryMomentOfAFlightThatLeapsAndTurns) {
  CappedEngine flight(GetParam(), 12 * kMiB);
  flight.engine->settle();
  for (int step = 0; step < 600; ++step) {
    const double leap = step % 100 == 99 ? 1e6 * step : 0.0;
    flight.moveTo(leap + 30.0 * step, 500.0 * std::sin(0.05 * step));
    flight.puppet->place.east = 1800.0;
    flight.engine->update(1.0 / 60.0, microseconds(300));
    ASSERT_LE(flight.engine->figures().bytes, 12 * kMiB) << "step " << step;
  }
  flight.engine->settle();
  EXPECT_LE(flight.engine->figures().peakBytes, 12 * kMiB);
  EXPECT_GT(flight.engine->figures().peakBytes, 6 * kMiB);
}

TEST_P(Cap, DrawsAsFarAsItAllowsAndSettlesThere) {
  CappedEngine small(GetParam(), 12 * kMiB), large(GetParam(), 16 * kMiB), ample(GetParam(), 512 * kMiB);
  for (CappedEngine* flight : {&small, &large, &ample}) flight->engine->settle();
  const auto radius = [](const CappedEngine& flight) { return flight.engine->figures().radius; };
  EXPECT_GE(radius(small), 1);
  EXPECT_LT(radius(small), radius(large));
  EXPECT_LT(radius(large), radius(ample));
  EXPECT_EQ(radius(ample), 12);
  for (const CappedEngine* flight : {&small, &large, &ample}) {
    const EngineFigures figures = flight->engine->figures();
    const auto side = static_cast<std::size_t>(2 * figures.radius + 1);
    EXPECT_EQ(figures.pending, 0U);
    EXPECT_EQ(figures.nodes, side * side);
  }
}

TEST_P(Cap, ChangesNothingOfWhatIsDrawn) {
  CappedEngine small(GetParam(), 12 * kMiB), ample(GetParam(), 512 * kMiB);
  // Away and back, so that everything has to be made again.
  small.engine->settle();
  small.moveTo(5e4, -3e4);
  small.engine->settle();
  small.moveTo(0.0, 0.0);
  small.engine->settle();
  ample.engine->settle();
  const Surface drawn = surfaceOf(*small.engine->scene()), all = surfaceOf(*ample.engine->scene());
  EXPECT_GT(drawn.size(), 1000U);
  EXPECT_LT(drawn.size(), all.size());
  for (const auto& [place, vertex] : drawn) {
    const auto found = all.find(place);
    ASSERT_NE(found, all.end());
    ASSERT_EQ(found->second, vertex);
  }
}

std::size_t meshBytes(const Scene& scene) {
  std::size_t sum = 0;
  for (const auto& mesh : scene.meshes()) sum += mesh->bytes();
  return sum;
}

/// A renderer that holds so many copies of every mesh it shows, settled.
EngineFigures settledWithRenderer(Engine& engine, std::size_t copies) {
  for (int frame = 0; frame < 10; ++frame) {
    engine.settle();
    engine.setRendererBytes(copies * meshBytes(*engine.scene()));
  }
  return engine.figures();
}

TEST_P(Cap, LeavesRoomForTheRenderersCopyAndShrinksWhereItTakesMore) {
  CappedEngine flight(GetParam(), 14 * kMiB);
  flight.engine->settle();
  const int before = flight.engine->figures().radius;
  const EngineFigures once = settledWithRenderer(*flight.engine, 1);
  EXPECT_EQ(once.radius, before);
  EXPECT_EQ(once.pending, 0U);
  EXPECT_LE(once.bytes, 14 * kMiB);
  const EngineFigures thrice = settledWithRenderer(*flight.engine, 3);
  EXPECT_LT(thrice.radius, before);
  EXPECT_EQ(thrice.pending, 0U);
  EXPECT_LE(thrice.bytes, 14 * kMiB);
}

TEST_P(Cap, GrowsTheViewBackWhenThereIsRoomAgain) {
  // The least cap at which the view reaches so far: whatever else is wanted costs it a ring.
  const auto radiusUnder = [](std::size_t cap) {
    CappedEngine flight(GetParam(), cap, 6);
    flight.engine->update(0.0, milliseconds(0));
    return flight.engine->figures().radius;
  };
  std::size_t cap = 8 * kMiB;
  while (radiusUnder(cap) < 6) cap += kMiB / 8;
  CappedEngine flight(GetParam(), cap, 6);
  flight.engine->settle();
  EXPECT_EQ(flight.engine->figures().radius, 6);
  flight.puppet->place.east = 30'000.0;  // a strip of ground of 2 s in front of it
  flight.engine->settle();
  EXPECT_EQ(flight.engine->figures().radius, 5);
  EXPECT_EQ(flight.engine->figures().nodes, 121U);
  EXPECT_LE(flight.engine->figures().peakBytes, cap);
  flight.puppet->place.east = 0.0;
  flight.engine->settle();
  EXPECT_EQ(flight.engine->figures().radius, 6);
  EXPECT_EQ(flight.engine->figures().nodes, 169U);
  EXPECT_EQ(flight.engine->figures().pending, 0U);
  EXPECT_LE(flight.engine->figures().peakBytes, cap);
}

TEST_P(Cap, FreesWithinTheBudget) {
  CappedEngine flight(GetParam(), 512 * kMiB);
  flight.engine->settle();
  const std::size_t nodes = flight.engine->figures().nodes;
  flight.moveTo(1e6, 1e6);
  flight.engine->update(0.0, milliseconds(0));
  EXPECT_EQ(flight.engine->figures().nodes, nodes);  // no time, nothing freed
  std::size_t most = 0;
  microseconds budget(5);
  for (std::size_t before = nodes, updates = 1; before > nodes / 2; ++updates) {
    if (updates % 1000 == 0) budget *= 2;  // under sanitizers choosing alone may take five
    flight.engine->update(0.0, budget);
    const std::size_t now = flight.engine->figures().nodes;
    most = std::max(most, before - std::min(before, now));
    before = now;
  }
  EXPECT_LT(most, nodes / 2);
}

TEST(Cap, BelowWhatTheWorldNeedsIsRefusedWithTheNumberOfBytes) {
  WorldDescription description = WorldDescription::standard();
  description.samples = 1025;
  auto world = World::create(description, *PluginRegistry::standard());
  ASSERT_TRUE(world.ok());
  const auto refused = Engine::create(*world, {.view = {0, 1}, .capBytes = 16 * kMiB});
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("16777216"), std::string::npos) << refused.error().message;
  EXPECT_TRUE(Engine::create(*world, {.view = {0, 1}}).ok());
}

}  // namespace
}  // namespace teren
