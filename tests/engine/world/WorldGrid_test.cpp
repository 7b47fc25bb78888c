// A grid samples the landscape's function (law 0), bit for bit; what is drawn lies within the bound that a
// query gives.
#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Bake.h"
#include "teren/Hash.h"
#include "teren/World.h"

#include "tests/engine/world/RandomDraws.h"
#include "tests/engine/world/TestWorld.h"
#include "tests/engine/world/WorldDescriptions.h"
#include "world/Layer.h"

namespace teren {
namespace {

WorldDescription randomWorld(RandomSequence& random) {
  WorldDescription world;
  world.seed = random.next();
  world.samples = (4 << below(random, 4)) + 1;  // 5 ... 33
  const int count = 1 + below(random, 4);
  for (int k = 0; k < count; ++k) {
    LayerDescription layer =
        noise(64.0 * (1 << below(random, 7)), std::ldexp(1.0, below(random, 8)), (2 << below(random, 6)) + 1);
    if (below(random, 2) == 0) layer.generator = "fault";
    layer.blend = below(random, 2) == 0 ? BlendKernel::linear : BlendKernel::smooth;
    layer.preserveVariance = below(random, 2) == 0;
    if (below(random, 3) == 0) layer.filters = {{"band", {}}};
    world.layers.push_back(layer);
  }
  return world;
}

std::uint32_t bits(float value) {
  return std::bit_cast<std::uint32_t>(value);
}

TEST(World, HeightsAreTheBakedSamplesBitForBit) {
  constexpr std::uint64_t kSeed = 78;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  for (int trial = 0; trial < 40; ++trial) {
    const WorldDescription description = randomWorld(random);
    const auto world = makeTestWorld(description);
    const std::int64_t far = std::int64_t{1} << 40;
    const std::int64_t bases[] = {-2, -1000, far - 1, -far - 1, (far << 6) - 1};
    const BakeRegion region{bases[trial % 5], bases[(trial / 5) % 5], 3, 3, 0};
    SCOPED_TRACE(testing::Message() << "trial " << trial << ", patch " << region.i << ", " << region.j);
    const Result<HeightMap> baked = bake(*world, region);
    ASSERT_TRUE(baked.ok()) << baked.error().message;
    const int n = world->intervals();
    for (int k = 0; k < 300; ++k) {
      int x = below(random, 3 * n + 1), y = below(random, 3 * n + 1);
      if (k % 4 == 0) x -= x % n;  // on borders of patches
      if (k % 8 == 0) y -= y % n;
      const Position at{region.i + x / n, region.j + y / n, (x % n) / static_cast<double>(n),
                        (y % n) / static_cast<double>(n)};
      ASSERT_EQ(bits(static_cast<float>(world->height(at))), bits((*baked)(x, y)))
          << "sample " << x << ", " << y;
    }
  }
}

TEST(World, IsSampledMoreThinlyByEveryLevelUpToTheCuts) {
  // Plugins that are exact at every level, no filters: a coarse level is every 2^L-th sample of level 0.
  WorldDescription description =
      worldOf({fault(512.0, 40.0, 65), noise(512.0, 5.0, 9), fault(1024.0, 40.0, 129)});
  description.samples = 17;
  const auto world = makeTestWorld(description);
  const Result<HeightMap> finest = bake(*world, {-16, 16, 32, 16, 0});
  ASSERT_TRUE(finest.ok());
  for (int level = 1; level <= 4; ++level) {  // 512 m are drawn up to level 3 + 3 - 2
    SCOPED_TRACE(level);
    const Result<HeightMap> coarse = bake(*world, {-16, 16, 32, 16, level});
    ASSERT_TRUE(coarse.ok());
    for (int y = 0; y < coarse->rows(); ++y) {
      for (int x = 0; x < coarse->columns(); ++x) {
        ASSERT_EQ(bits((*coarse)(x, y)), bits((*finest)(x << level, y << level))) << x << ", " << y;
      }
    }
  }
}

TEST(World, DrawsOnlyTheMeanOfALayerAboveItsCut) {
  LayerDescription detail = noise(64.0, 5.0), wide = noise(1024.0, 0.0);
  detail.parameters.emplace_back("mean", 100.0);
  const auto world = makeTestWorld(worldOf({detail, wide}));
  // 32 intervals a patch: level 3 has spacing 16 m = pitch / 4 and is the last to draw the detail.
  EXPECT_EQ(world->layers()[0].cutLevel(), 3);
  EXPECT_EQ(world->layers()[1].cutLevel(), 7);
  EXPECT_EQ(world->topLevel(), 7);
  const auto spread = [&](int level) {
    const Result<HeightMap> map = bake(*world, {0, 0, 16, 16, level});
    EXPECT_TRUE(map.ok());
    const auto [low, high] = std::minmax_element(map->samples().begin(), map->samples().end());
    return std::pair(*low, *high);
  };
  EXPECT_GT(spread(3).second - spread(3).first, 10.0F);
  for (int level = 4; level <= 7; ++level) EXPECT_EQ(spread(level), std::pair(100.0F, 100.0F)) << level;
}

TEST(World, QueriesTheTriangleThatTheBakedSamplesSpan) {
  constexpr std::uint64_t kSeed = 79;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const auto world = makeTestWorld(worldOf({fault(64.0, 4.0), fault(512.0, 40.0)}));
  const Result<HeightMap> baked = bake(*world, {-1, -1, 2, 2, 0});
  ASSERT_TRUE(baked.ok());
  for (int trial = 0; trial < 300; ++trial) {
    const double x = 64.0 * uniform(random), y = 64.0 * uniform(random);  // in samples
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const SurfacePoint point =
        world->query({column / 32 - 1, row / 32 - 1, x / 32.0 - column / 32, y / 32.0 - row / 32});
    const auto at = [&](int dx, int dy) { return static_cast<double>((*baked)(column + dx, row + dy)); };
    const double fx = x - column, fy = y - row;
    const double slopeX = fx >= fy ? at(1, 0) - at(0, 0) : at(1, 1) - at(0, 1);
    const double slopeY = fx >= fy ? at(1, 1) - at(1, 0) : at(0, 1) - at(0, 0);
    ASSERT_NEAR(point.drawn, at(0, 0) + fx * slopeX + fy * slopeY, 1e-9);
    const double length = std::sqrt(slopeX * slopeX + slopeY * slopeY + 4.0);
    ASSERT_NEAR(point.normal[0], -slopeX / length, 1e-12);
    ASSERT_NEAR(point.normal[1], -slopeY / length, 1e-12);
    ASSERT_NEAR(point.normal[2], 2.0 / length, 1e-12);
    ASSERT_LE(std::fabs(point.height - point.drawn), point.error);
  }
}

TEST(World, MakesEachMapOnceAQueryThoughTheyDoNotFitIntoItsStore) {
  // Four maps of 2049 samples a side are more than the store may hold.
  ASSERT_GT(4 * 2049 * 2049 * sizeof(float), World::kQueryBytes);
  const auto world = makeTestWorld(worldOf({noise(8192.0, 100.0, 2049)}));
  const int before = noiseMapsBegun();
  const SurfacePoint point = world->query({5, 6, 0.3, 0.7});
  EXPECT_EQ(noiseMapsBegun(), before + 4);
  EXPECT_EQ(point.height, world->height({5, 6, 0.3, 0.7}));
  EXPECT_LE(std::fabs(point.height - point.drawn), point.error);
}

TEST(World, QueriesOnBordersOfPatchesAndCellsAgreeWithTheBakedSamples) {
  constexpr std::uint64_t kSeed = 81;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  for (int trial = 0; trial < 20; ++trial) {
    const auto world = makeTestWorld(randomWorld(random));
    const int n = world->intervals();
    const std::int64_t i = below(random, 64) - 32, j = below(random, 64) - 32;
    const Result<HeightMap> baked = bake(*world, {i, j, 1, 1, 0});
    ASSERT_TRUE(baked.ok());
    // The last square of the patch has corners on the borders to the patches east and north.
    const double inside = 1.0 - 0.25 / n;
    const SurfacePoint point = world->query({i, j, inside, inside});
    const auto at = [&](int dx, int dy) { return static_cast<double>((*baked)(n - 1 + dx, n - 1 + dy)); };
    const double expected = at(0, 0) + 0.75 * (at(1, 0) - at(0, 0)) + 0.75 * (at(1, 1) - at(1, 0));
    ASSERT_NEAR(point.drawn, expected, 1e-9 * std::max(1.0, std::fabs(expected)));
    ASSERT_EQ(point.height, world->height({i, j, inside, inside}));
  }
}

TEST(World, HasNoNegativeZeroInTheNormalOfFlatGround) {
  const auto world = makeTestWorld(worldOf({noise(64.0, 0.0)}));
  for (const double component : world->query({0, 0, 0.25, 0.5}).normal) EXPECT_FALSE(std::signbit(component));
}

}  // namespace
}  // namespace teren
