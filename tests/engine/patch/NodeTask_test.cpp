#include "patch/NodeTask.h"

#include <bit>
#include <random>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "teren/Bake.h"

namespace teren {
namespace {

std::shared_ptr<const World> mixedWorld() {
  WorldDescription description;
  description.seed = 11;
  const auto layer = [&](double pitch, int samples, std::vector<FilterDescription> filters) {
    LayerDescription made;
    made.generator = "fault";
    made.parameters = {{"faults", std::int64_t{30}}};
    made.pitch = pitch;
    made.samples = samples;
    made.filters = std::move(filters);
    description.layers.push_back(made);
  };
  layer(4096.0, 65, {{"band", {}}});
  layer(64.0, 129, {});             // finer than the grid: strided at level 0
  layer(64.0, 65, {{"band", {}}});  // approximate above level 0
  layer(128.0, 9, {});              // coarser than the grid, narrower than a node of level 2
  auto world = World::create(description, *PluginRegistry::standard());
  EXPECT_TRUE(world.ok()) << (world.ok() ? "" : world.error().message);
  return *world;
}

HeightMap finished(const World& world, const NodeKey& key, BaseMapStore& store, const auto& slice) {
  NodeTask task(world, key, store);
  while (!task.step(slice())) {
  }
  return task.takeHeights();
}

bool sameBits(const HeightMap& a, const HeightMap& b) {
  return std::equal(
      a.samples().begin(), a.samples().end(), b.samples().begin(), b.samples().end(),
      [](float x, float y) { return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y); });
}

TEST(NodeTask, GivesTheSameBitsForAnySlicing) {
  const auto world = mixedWorld();
  for (const int level : {0, 1, 2, 5, 9}) {
    BaseMapStore shared(std::size_t{64} << 20), other(std::size_t{64} << 20);
    const NodeKey key{level, -1, 3};
    const HeightMap whole = finished(*world, key, shared, [] { return Slice::unlimited(); });
    const HeightMap sliced =
        finished(*world, key, other, [] { return Slice::until(Slice::Clock::time_point::min()); });
    EXPECT_TRUE(sameBits(whole, sliced)) << "level " << level;
  }
}

TEST(NodeTask, GivesTheSameBitsAfterItsBaseMapsWereDroppedAndMadeAgain) {
  const auto world = mixedWorld();
  BaseMapStore roomy(std::size_t{64} << 20), tiny(1);
  for (const NodeKey key : {NodeKey{0, 0, 0}, NodeKey{2, -1, 1}, NodeKey{0, 0, 0}}) {
    EXPECT_TRUE(sameBits(finished(*world, key, roomy, [] { return Slice::unlimited(); }),
                         finished(*world, key, tiny, [] { return Slice::unlimited(); })));
  }
}

TEST(NodeTask, NeighboursShareTheirBorderBitForBitAtEveryLevel) {
  const auto world = mixedWorld();
  BaseMapStore store(std::size_t{64} << 20);
  const auto at = [&](const NodeKey& key) {
    return finished(*world, key, store, [] { return Slice::unlimited(); });
  };
  for (int level = 0; level <= world->topLevel(); ++level) {
    const HeightMap west = at({level, -1, -1}), east = at({level, 0, -1}), north = at({level, -1, 0});
    const int last = west.columns() - 1;
    for (int k = 0; k <= last; ++k) {
      ASSERT_EQ(west(last, k), east(0, k)) << "level " << level << ", row " << k;
      ASSERT_EQ(west(k, last), north(k, 0)) << "level " << level << ", column " << k;
    }
  }
}

TEST(NodeTask, AtLevelZeroSamplesTheLandscapesFunctionExactly) {
  const auto world = mixedWorld();
  std::mt19937_64 random(5);
  BaseMapStore store(std::size_t{64} << 20);
  for (int round = 0; round < 6; ++round) {
    const NodeKey key{0, static_cast<std::int64_t>(random() % 2000) - 1000,
                      static_cast<std::int64_t>(random() % 2000) - 1000};
    const HeightMap heights = finished(*world, key, store, [] { return Slice::unlimited(); });
    const int n = world->intervals();
    for (int k = 0; k < 50; ++k) {
      const int x = static_cast<int>(random() % static_cast<unsigned>(n)),
                y = static_cast<int>(random() % static_cast<unsigned>(n));
      const Position position{key.i, key.j, static_cast<double>(x) / n, static_cast<double>(y) / n};
      ASSERT_EQ(heights(x, y), static_cast<float>(world->height(position)));
    }
  }
}

TEST(NodeTask, DrawsOnlyTheMeanOfALayerAboveItsCutLevel) {
  WorldDescription description;
  LayerDescription layer;
  layer.generator = "fault";
  description.layers = {layer, layer};
  description.layers[1].pitch = 64.0 * 1024.0;
  const auto world = World::create(description, *PluginRegistry::standard());
  ASSERT_TRUE(world.ok());
  description.layers.erase(description.layers.begin());
  description.layers[0].name = "fault-2";
  const auto alone = World::create(description, *PluginRegistry::standard());
  ASSERT_TRUE(alone.ok());
  BaseMapStore a(std::size_t{64} << 20), b(std::size_t{64} << 20);
  // 2 m samples, pitch 64 m: drawn while the grid's spacing is at most 16 m, so up to level 3.
  const auto unlimited = [] { return Slice::unlimited(); };
  EXPECT_TRUE(
      sameBits(finished(**world, {4, 0, 0}, a, unlimited), finished(**alone, {4, 0, 0}, b, unlimited)));
  EXPECT_FALSE(
      sameBits(finished(**world, {3, 0, 0}, a, unlimited), finished(**alone, {3, 0, 0}, b, unlimited)));
}

TEST(Bake, GivesTheSameBitsForAnyOrderOfVisitsAndSlicing) {
  const auto world = mixedWorld();
  const BakeRegion region{-3, 2, 8, 4, 1};
  const auto plain = bake(*world, region);
  ASSERT_TRUE(plain.ok());
  EXPECT_EQ(plain->columns(), 8 * 32 / 2 + 1);
  EXPECT_EQ(plain->rows(), 4 * 32 / 2 + 1);
  BakeOptions options;
  options.slice = std::chrono::microseconds(20);
  options.visitSeed = 99;
  const auto shuffled = bake(*world, region, options);
  ASSERT_TRUE(shuffled.ok());
  EXPECT_TRUE(sameBits(*plain, *shuffled));
}

TEST(Bake, GivesTheSameBitsForAnyNumberOfWorkers) {
  const auto world = mixedWorld();
  const BakeRegion region{-3, 2, 24, 12, 1};
  const auto plain = bake(*world, region);
  ASSERT_TRUE(plain.ok());
  for (const int workers : {1, 3, 64}) {
    BakeOptions options;
    options.workers = workers;
    options.visitSeed = static_cast<std::uint64_t>(workers);
    const auto shared = bake(*world, region, options);
    ASSERT_TRUE(shared.ok());
    EXPECT_TRUE(sameBits(*plain, *shared)) << workers << " workers";
  }
}

TEST(Bake, AcceptsRegionsThatBeginInsideANode) {
  const auto world = mixedWorld();
  const auto whole = bake(*world, {-8, -8, 16, 16, 3});
  const auto part = bake(*world, {-5, 3, 2, 1, 3});
  ASSERT_TRUE(whole.ok() && part.ok());
  for (int y = 0; y < part->rows(); ++y) {
    for (int x = 0; x < part->columns(); ++x) ASSERT_EQ((*part)(x, y), (*whole)(x + 3 * 4, y + 11 * 4));
  }
}

TEST(Bake, RefusesWhatDoesNotFit) {
  const auto world = mixedWorld();
  const auto refused = [&](const BakeRegion& region, const char* word) {
    const auto result = bake(*world, region);
    ASSERT_FALSE(result.ok());
    EXPECT_NE(result.error().message.find(word), std::string::npos) << result.error().message;
  };
  refused({0, 0, 0, 1, 0}, "columns");
  refused({0, 0, 1, -1, 0}, "rows");
  refused({1, 0, 1, 1, 6}, "multiples");
  refused({0, 0, 1, 1, -1}, "level");
  refused({0, 0, 1, 1, world->topLevel() + 1}, "top level");
  refused({kMaxPatch, 0, 1, 1, 0}, "beyond");
  refused({0, 0, std::int64_t{1} << 40, 1, 0}, "2^28");
  refused({0, 0, std::int64_t{1} << 62, 1, 0}, "beyond");
  for (const int workers : {-1, BakeOptions::kMostWorkers + 1}) {
    BakeOptions options;
    options.workers = workers;
    const auto result = bake(*world, {0, 0, 1, 1, 0}, options);
    ASSERT_FALSE(result.ok());
    EXPECT_NE(result.error().message.find("workers are " + std::to_string(workers)), std::string::npos);
  }
}

TEST(Bake, StopsWhenProgressSaysSo) {
  const auto world = mixedWorld();
  for (const int workers : {0, 2}) {
    BakeOptions options;
    options.workers = workers;
    options.progress = [](std::size_t done, std::size_t) { return done < 2; };
    const auto result = bake(*world, {0, 0, 8, 8, 0}, options);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().message, "cancelled");
  }
}

/// A field beside layers of every kind.
std::shared_ptr<const World> worldWithField() {
  WorldDescription description;
  description.seed = 12;
  LayerDescription field, maps;
  field.generator = "noise";
  maps.generator = "fault";
  maps.filters = {{"band", {}}};
  description.layers = {field, maps};
  auto world = World::create(description, *PluginRegistry::standard());
  EXPECT_TRUE(world.ok()) << (world.ok() ? "" : world.error().message);
  return *world;
}

TEST(NodeTask, GivesTheCoarserSamplesAroundANodeAsTheNodesOfThatLevelHaveThem) {
  for (const auto& world : {mixedWorld(), worldWithField()}) {
    const int n = world->intervals();
    for (int level = 0; level < world->topLevel() && level < 5; ++level) {
      BaseMapStore store(std::size_t{64} << 20);
      for (const auto& [i, j] : {std::pair<std::int64_t, std::int64_t>{-1, 2}, {6, -3}, {-4, -4}, {3, 5}}) {
        const NodeKey key{level, i, j};
        SCOPED_TRACE("level " + std::to_string(level) + ", node " + std::to_string(i));
        NodeTask task(*world, key, store, true);
        while (!task.step(Slice::until(Slice::Clock::time_point::min()))) {
        }
        const HeightMap own =
            finished(*world, key, store, [] { return Slice::until(Slice::Clock::time_point::min()); });
        EXPECT_TRUE(sameBits(task.heights(), own));
        ASSERT_EQ(task.coarser().columns(), n / 2 + 3);
        for (std::int64_t dj = -1; dj <= 1; ++dj) {
          for (std::int64_t di = -1; di <= 1; ++di) {
            const NodeKey above{level + 1, (i >> 1) + di, (j >> 1) + dj};
            const HeightMap heights = finished(*world, above, store, [] { return Slice::unlimited(); });
            const std::int64_t west = i * n / 2 - above.i * n, south = j * n / 2 - above.j * n;
            for (int y = -1; y <= n / 2 + 1; ++y) {
              for (int x = -1; x <= n / 2 + 1; ++x) {
                const std::int64_t column = west + x, row = south + y;
                if (column < 0 || column > n || row < 0 || row > n) continue;
                ASSERT_EQ(
                    std::bit_cast<std::uint32_t>(task.coarser()(x + 1, y + 1)),
                    std::bit_cast<std::uint32_t>(heights(static_cast<int>(column), static_cast<int>(row))))
                    << x << ", " << y;
              }
            }
          }
        }
      }
    }
    BaseMapStore store(std::size_t{64} << 20);
    NodeTask top(*world, {world->topLevel(), 0, 0}, store, true);
    while (!top.step(Slice::unlimited())) {
    }
    EXPECT_EQ(top.coarser().columns(), 0);
  }
}

}  // namespace
}  // namespace teren
