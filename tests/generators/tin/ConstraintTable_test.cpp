#include "generators/tin/ConstraintTable.h"

#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

TEST(ConstraintTable, HoldsWhatAMapWouldHoldAfterManyChanges) {
  constexpr std::uint64_t kSeed = 1;
  RandomSequence random(kSeed);
  ConstraintTable table;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> expected;
  for (int n = 0; n < 20000; ++n) {
    auto a = static_cast<std::uint32_t>(random.nextBits(5));
    auto b = a + 1 + static_cast<std::uint32_t>(random.nextBits(5));
    const std::pair<std::uint32_t, std::uint32_t> edge(a, b);
    if (random.next() % 2 == 0) std::swap(a, b);
    ASSERT_EQ(table.contains(a, b), expected.contains(edge)) << "step " << n << " of seed " << kSeed;
    // Fuller for a while, then emptier, so that long runs of places are broken up.
    const bool fills = n / 2000 % 2 == 0;
    if (random.next() % 4 == 0 ? fills : !fills) {
      if (expected.erase(edge) > 0) table.erase(a, b);
    } else {
      const auto id = static_cast<std::uint32_t>(n);
      table.set(a, b, id);
      expected[edge] = id;
    }
    ASSERT_EQ(table.size(), expected.size());
    if (expected.contains(edge)) {
      ASSERT_EQ(table.id(b, a), expected[edge]);
    }
  }
  table.forEach([&](std::uint32_t a, std::uint32_t b, std::uint32_t id) {
    ASSERT_LT(a, b);
    ASSERT_TRUE(expected.contains({a, b}));
    ASSERT_EQ(expected[std::pair(a, b)], id);
    expected.erase({a, b});
  });
  EXPECT_TRUE(expected.empty());
}

TEST(ConstraintTable, AnEmptyOneTakesNoBytesAndKnowsNoEdge) {
  const ConstraintTable table;
  EXPECT_EQ(table.bytes(), 0U);
  EXPECT_FALSE(table.contains(0, 1));
}

}  // namespace
}  // namespace teren
