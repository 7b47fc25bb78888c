#include "stream/MemoryPlan.h"

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

/// 100 bytes a node: radius 3 takes 4,900, with its margin 8,100.
MemoryNeeds needs(std::size_t cap) {
  return {.cap = cap, .fixed = 1000, .perNode = 100, .leastMaps = 500, .mostMaps = 2000, .radius = 3};
}

TEST(MemoryPlan, GivesEverythingWhereThereIsRoom) {
  EXPECT_EQ(planMemory(needs(1000 + 8100 + 2000)), (MemoryPlan{3, 1, 2000, true}));
}

TEST(MemoryPlan, GivesUpTheUnseenMarginFirst) {
  EXPECT_EQ(planMemory(needs(1000 + 8100 + 2000 - 1)), (MemoryPlan{3, 0, 2000, true}));
}

TEST(MemoryPlan, ThenBaseMaps) {
  EXPECT_EQ(planMemory(needs(1000 + 4900 + 1999)), (MemoryPlan{3, 0, 1999, true}));
  EXPECT_EQ(planMemory(needs(1000 + 4900 + 500)), (MemoryPlan{3, 0, 500, true}));
}

TEST(MemoryPlan, ThenTheViewsRim) {
  const MemoryPlan plan = planMemory(needs(1000 + 4900 + 499));
  EXPECT_EQ(plan.radius, 2);
  EXPECT_EQ(plan.margin, 0);
  EXPECT_EQ(plan.mapBytes, 2000U);  // what the rim has left is good for maps
}

TEST(MemoryPlan, SaysWhereNothingFits) {
  EXPECT_EQ(planMemory(needs(1000 + 100 + 500)), (MemoryPlan{0, 0, 500, true}));
  EXPECT_EQ(planMemory(needs(1000 + 100 + 499)), (MemoryPlan{0, 0, 500, false}));
  EXPECT_EQ(planMemory(needs(0)), (MemoryPlan{0, 0, 500, false}));
}

TEST(MemoryPlan, NeverPlansBeyondTheCapAndNeverAskesForLessThanASmallerCapAllows) {
  const std::uint64_t seed = 6;
  RecordProperty("seed", std::to_string(seed));
  RandomSequence random(seed);
  for (int trial = 0; trial < 10'000; ++trial) {
    MemoryNeeds some;
    some.cap = random.next() % 1'000'000;
    some.fixed = random.next() % 10'000;
    some.perNode = 1 + random.next() % 1000;
    some.leastMaps = random.next() % 10'000;
    some.mostMaps = some.leastMaps + random.next() % 10'000;
    some.radius = static_cast<int>(random.next() % 65);
    const MemoryPlan plan = planMemory(some);
    ASSERT_LE(plan.radius, some.radius);
    if (!plan.fits) continue;
    const auto side = static_cast<std::size_t>(2 * (plan.radius + plan.margin) + 1);
    ASSERT_LE(some.fixed + side * side * some.perNode + plan.mapBytes, some.cap);
    ASSERT_GE(plan.mapBytes, some.leastMaps);
    MemoryNeeds more = some;
    more.cap += random.next() % 100'000;
    const MemoryPlan larger = planMemory(more);
    ASSERT_GE(larger.radius, plan.radius);
    // The largest that fits: one ring more does not.
    const auto next = static_cast<std::size_t>(2 * (plan.radius + 1) + 1);
    if (plan.radius < some.radius) {
      ASSERT_GT(some.fixed + next * next * some.perNode + some.leastMaps, some.cap);
    }
  }
}

}  // namespace
}  // namespace teren
