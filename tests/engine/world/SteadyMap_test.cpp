#include "world/SteadyMap.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

std::size_t hashed = 0;

struct CountedHash {
  std::size_t operator()(std::uint64_t key) const noexcept {
    ++hashed;
    return hashWith(7, key);
  }
};

using Map = SteadyMap<std::uint64_t, int, CountedHash>;

TEST(SteadyMap, HoldsWhatAnOrdinaryMapHolds) {
  constexpr std::uint64_t kSeed = 20261123;
  SCOPED_TRACE(kSeed);
  std::uint64_t drawn = kSeed;
  const auto draw = [&] { return drawn = hashWith(drawn, 1); };
  Map map;
  std::map<std::uint64_t, int> expected;
  for (int step = 0; step < 20'000; ++step) {
    const std::uint64_t key = draw() % 500;
    if (draw() % 3 == 0) {
      map.erase(key);
      expected.erase(key);
    } else {
      map.insert(key, step);
      expected.emplace(key, step);
    }
    ASSERT_EQ(map.size(), expected.size());
  }
  for (std::uint64_t key = 0; key < 500; ++key) {
    const auto known = expected.find(key);
    ASSERT_EQ(map.contains(key), known != expected.end()) << key;
    if (known != expected.end()) {
      EXPECT_EQ(*map.find(key), known->second) << key;
    }
  }
}

/// Entries that are moved are hashed again.
TEST(SteadyMap, MovesFewEntriesAtOnceHoweverManyItHas) {
  constexpr std::uint64_t kKeys = 100'000;
  Map map;
  std::size_t most = 0;
  for (std::uint64_t key = 0; key < kKeys; ++key) {
    const std::size_t before = hashed;
    map.insert(key, 0);
    most = std::max(most, hashed - before);
  }
  EXPECT_GT(most, 2U) << "this library keeps what it has hashed, so that moving is not seen here";
  EXPECT_LT(most, kKeys / 64);
}

}  // namespace
}  // namespace teren
