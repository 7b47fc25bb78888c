#include "stream/View.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

GroundNodes groundOf(const Motion& motion, const World& world) {
  GroundNodes nodes;
  groundNodes(motion, world, nodes);
  return nodes;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::shared_ptr<const World> plainWorld() {
  WorldDescription description;
  description.samples = 17;
  LayerDescription layer;
  layer.generator = "fault";
  layer.samples = 17;
  description.layers.push_back(layer);
  return *World::create(description, *PluginRegistry::standard());
}

std::set<std::pair<std::int64_t, std::int64_t>> places(const std::vector<NodeKey>& nodes) {
  std::set<std::pair<std::int64_t, std::int64_t>> set;
  for (const NodeKey& key : nodes) set.emplace(key.i, key.j);
  return set;
}

TEST(GroundNodes, OfAStandingObjectAreThoseAroundItItsOwnFirst) {
  const auto world = plainWorld();
  const GroundNodes inside = groundOf({{3, -4, 0.5, 0.5}}, *world);
  EXPECT_EQ(inside.wanted, (std::vector<NodeKey>{{0, 3, -4}}));
  EXPECT_TRUE(inside.passing.empty());
  const GroundNodes corner = groundOf({{3, -4, 0.01, 0.99}}, *world);
  EXPECT_EQ(corner.wanted.front(), (NodeKey{0, 3, -4}));
  EXPECT_EQ(places(corner.wanted),
            (std::set<std::pair<std::int64_t, std::int64_t>>{{3, -4}, {2, -4}, {3, -3}, {2, -3}}));
}

TEST(GroundNodes, ReachAsFarAsTheObjectDoes) {
  const auto world = plainWorld();
  const GroundNodes nodes = groundOf({{0, 0, 0.5, 0.5}, 0, 0, 0, 0, 100.0}, *world);
  EXPECT_EQ(nodes.wanted.size(), 25U);
}

TEST(GroundNodes, FollowTheWayWithoutAGapAtAnySpeed) {
  const auto world = plainWorld();
  for (const double speed : {10.0, 60.0, 300.0, 1279.0, 1e4, 1e5}) {
    const Motion motion{{7, 9, 0.3, 0.8}, 0.0, 0.6 * speed, -0.8 * speed};
    const GroundNodes nodes = groundOf(motion, *world);
    std::set<std::pair<std::int64_t, std::int64_t>> known = places(nodes.wanted);
    for (const auto& place : places(nodes.passing)) EXPECT_TRUE(known.insert(place).second) << "twice";
    const double seconds = std::min(kGroundSeconds, kGroundPitches * 64.0 / speed);
    for (int k = 0; k <= 20'000; ++k) {
      const double time = seconds * k / 20'000.0;
      const Position at = *motion.position.movedBy(motion.east * time, motion.north * time, 64.0);
      ASSERT_TRUE(known.contains({at.i, at.j})) << speed << " m/s after " << time << " s";
    }
    EXPECT_LE(known.size(), 4U * 129U);
  }
}

TEST(GroundNodes, IncludeThoseOfWhichOnlyACornerIsCrossed) {
  const auto world = plainWorld();
  RandomSequence random(4711);
  const auto draw = [&] { return static_cast<double>(random.nextBits(30)) * 0x1p-30; };
  for (int trial = 0; trial < 500; ++trial) {
    const double speed = 500.0 * draw(), east = 2.0 * draw() - 1.0, north = 2.0 * draw() - 1.0;
    const double length = std::sqrt(east * east + north * north);
    const Motion motion{{-3, 5, draw(), draw()}, 0.0, speed * east / length, speed * north / length};
    const auto known = places(groundOf(motion, *world).wanted);
    std::set<std::pair<std::int64_t, std::int64_t>> met;
    for (int k = 0; k <= 2000; ++k) {
      const double time = kGroundSeconds * k / 2000.0;
      for (const auto& [x, y] : {std::pair{0.0, 0.0}, {-7.9, -7.9}, {-7.9, 7.9}, {7.9, -7.9}, {7.9, 7.9}}) {
        const Position at =
            *motion.position.movedBy(motion.east * time + x, motion.north * time + y, world->pitch());
        met.insert({at.i, at.j});
      }
    }
    for (const auto& place : met) {
      ASSERT_TRUE(known.contains(place)) << "trial " << trial << ": (" << place.first << ", " << place.second
                                         << ") at " << motion.east << ", " << motion.north << " m/s";
    }
  }
}

TEST(GroundNodes, ComeInTheOrderInWhichTheyAreReached) {
  const auto world = plainWorld();
  const GroundNodes nodes = groundOf({{0, 0, 0.5, 0.5}, 0.0, 0.0, 1000.0}, *world);
  ASSERT_EQ(nodes.wanted.size(), 32U);
  for (std::size_t k = 0; k < nodes.wanted.size(); ++k) {
    EXPECT_EQ(nodes.wanted[k], (NodeKey{0, 0, static_cast<std::int64_t>(k)}));
  }
}

TEST(GroundNodes, ThatCannotBeReadyInTimeAreOnlyKept) {
  const auto world = plainWorld();
  const GroundNodes fast = groundOf({{0, 0, 0.5, 0.5}, 0.0, 1e4, 0.0}, *world);
  EXPECT_EQ(fast.passing.front(), (NodeKey{0, 0, 0}));
  EXPECT_GE(fast.wanted.front().i, 7);  // 500 m away
  EXPECT_GT(fast.wanted.size(), 100U);
  for (const double speed : {1e6, 1e300, kInfinity}) {
    const GroundNodes mad = groundOf({{0, 0, 0.5, 0.5}, 0.0, speed, 0.0}, *world);
    EXPECT_TRUE(mad.wanted.empty()) << speed;
    EXPECT_EQ(mad.passing.front(), (NodeKey{0, 0, 0})) << speed;
  }
}

TEST(GroundNodes, EndWithTheWorld) {
  const auto world = plainWorld();
  const GroundNodes nodes = groundOf({{kMaxPatch - 3, 0, 0.5, 0.5}, 0.0, 1000.0, 0.0}, *world);
  EXPECT_LE(nodes.wanted.size(), 3U);
  EXPECT_FALSE(nodes.wanted.empty());
}

}  // namespace
}  // namespace teren
