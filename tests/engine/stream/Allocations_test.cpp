// What the frame path takes from the heap: nothing, once it is warm (law 4: allocating may take any time).
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include <gtest/gtest.h>

#include "teren/Engine.h"

#include "stream/Selection.h"
#include "tests/engine/stream/FaultWorld.h"
#include "tests/engine/stream/NodeErrorsWait.h"
#include "tests/support/AllocationCount.h"

namespace teren {
namespace {

using test::allocationCount;

class Puppet final : public Object {
 public:
  void update(double, const Ground& ground) override { seen = ground.height(place.position); }
  Motion motion() const override { return place; }
  std::optional<CollisionSphere> collisionSphere() const override { return CollisionSphere{.radius = 2.0}; }
  Motion place;
  std::optional<double> seen;
};

class Allocations : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Workers, Allocations, testing::Values(0, 2));

TEST_P(Allocations, OfUpdatesAroundAMovingEyeAreNoneWhileTheCutStays) {
  const auto world = test::faultWorld(3, 17, {1024.0, 64.0}, 20);
  auto engine = Engine::create(
      world,
      {.view = {.detail = DetailSettings{.pixelError = 30.0, .distance = 3000.0}}, .workers = GetParam()});
  ASSERT_TRUE(engine.ok());
  auto& puppet = static_cast<Puppet&>((*engine)->add(std::make_unique<Puppet>()));
  ASSERT_TRUE(test::measureNodeErrors(**engine));
  const auto fly = [&](int round) {
    long allocated = 0;
    for (int step = 0; step < 200; ++step) {
      const double angle = 2.0 * std::acos(-1.0) * step / 200.0;
      puppet.place.position =
          *Position::fromMetres(32.0 + 12.0 * std::cos(angle), 32.0 + 12.0 * std::sin(angle), world->pitch());
      puppet.place.height = 60.0 + std::sin(angle);
      puppet.place.east = -12.0 * std::sin(angle);
      puppet.place.north = 12.0 * std::cos(angle);
      const auto serial = (*engine)->scene()->serial();
      const long before = allocationCount();
      (*engine)->update(1.0 / 60.0, std::chrono::milliseconds(20));
      if (round > 0 && (*engine)->scene()->serial() == serial) allocated += allocationCount() - before;
    }
    return allocated;
  };
  for (int round = 0; round < 3; ++round) {  // until all that comes and goes is there
    fly(0);
    (*engine)->settle();
  }
  const auto serial = (*engine)->scene()->serial();
  EXPECT_EQ(fly(1), 0);
  EXPECT_EQ((*engine)->scene()->serial(), serial) << "it was not about a cut that stays";
}

TEST(SelectionAllocations, OfChoosingAreNoneWhileTheCutIsNoLargerThanBefore) {
  Selection::Ground ground{64.0, -100.0, 300.0, {0.0}};
  for (int level = 1; level <= 9; ++level) ground.errors.push_back(0.25 * std::exp2(level));
  Selection selection(ground);
  const auto look = [&](int step) {
    const Viewer viewer{*Position::fromMetres(40.0 * step, 10.0, 64.0),
                        100.0,
                        {.pixelError = 2.0, .distance = 8000.0},
                        300.0,
                        0.0,
                        0.0};
    const long before = allocationCount();
    EXPECT_TRUE(selection.choose({&viewer, 1}, 1.0));
    selection.keep();
    return allocationCount() - before;
  };
  for (int step = 0; step < 300; ++step) look(step);
  const std::size_t nodes = selection.kept().size();
  long allocated = 0;
  for (int step = 299; step > 0; --step) allocated += look(step);
  EXPECT_EQ(allocated, 0);
  EXPECT_GT(nodes, 500U);
}

}  // namespace
}  // namespace teren
