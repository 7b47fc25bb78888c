// Positions are whole numbers and fractions, so the land 2^40 patches away is as rough and as finely resolved
// as at the origin.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Bake.h"
#include "teren/Engine.h"
#include "teren/HeightMapOperations.h"
#include "teren/World.h"

#include "tests/engine/world/RandomDraws.h"
#include "tests/engine/world/TestWorld.h"
#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

constexpr std::int64_t kFar = std::int64_t{1} << 40;

LayerDescription layerOf(const char* generator, double pitch) {
  LayerDescription layer;
  layer.generator = generator;
  layer.pitch = pitch;
  layer.samples = 33;
  return layer;
}

/// Patches of 16 intervals.
std::shared_ptr<const World> worldOf(std::uint64_t seed, std::vector<LayerDescription> layers) {
  WorldDescription description;
  description.seed = seed;
  description.samples = 33;
  description.layers = std::move(layers);
  return makeTestWorld(description);
}

/// The same three maps again and again: the land at patch (i + k 2^6, j + l 2^6) is that at (i, j).
std::shared_ptr<const World> repeatingWorld() {
  return worldOf(1, {layerOf("same", 4096.0), layerOf("same", 512.0), layerOf("same", 64.0)});
}

TEST(FarAway, OneFaultLayerIsAsRoughOverEightByEightPatchesAsAtTheOrigin) {
  constexpr int kSeeds = 64;
  double origin = 0.0, far = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const std::shared_ptr<const World> world = worldOf(seed, {layerOf("fault", 64.0)});
    const auto deviation = [&](std::int64_t i, std::int64_t j) {
      return statistics(bake(*world, {.i = i, .j = j, .columns = 8, .rows = 8}).value().view()).deviation;
    };
    origin += deviation(0, 0) / kSeeds;
    far += deviation(kFar, kFar) / kSeeds;
  }
  RecordProperty("origin_mm", static_cast<int>(1000.0 * origin));
  RecordProperty("far_mm", static_cast<int>(1000.0 * far));
  EXPECT_NEAR(far / origin, 1.0, 0.05) << far << " m far away, " << origin << " m at the origin";
}

TEST(FarAway, TheLandOfRepeatedMapsHasTheBitsOfTheOriginAtEveryLevel) {
  const std::shared_ptr<const World> world = repeatingWorld();
  for (int level = 0; level <= std::min(4, world->topLevel()); ++level) {
    const auto baked = [&](std::int64_t i, std::int64_t j) {
      return bake(*world, {.i = i, .j = j, .columns = 4, .rows = 3, .level = level}).value();
    };
    EXPECT_TRUE(test::sameBits(baked(kFar, -kFar).view(), baked(0, 0).view())) << "level " << level;
  }
}

TEST(FarAway, QueriesResolveAFractionOfAPatchAsFinelyAsAtTheOrigin) {
  constexpr std::uint64_t kSeed = 91;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const std::shared_ptr<const World> world = repeatingWorld();
  int finer = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Position near{below(random, 64), below(random, 64), uniform(random), uniform(random)};
    Position far = near;
    far.i += kFar;
    far.j -= kFar;
    const SurfacePoint here = world->query(near), there = world->query(far);
    ASSERT_EQ(there.height, here.height);
    ASSERT_EQ(there.drawn, here.drawn);
    ASSERT_EQ(there.normal, here.normal);
    ASSERT_EQ(there.error, here.error);
    Position step = far;
    step.u = std::min(far.u + 0x1p-30, 1.0 - 0x1p-53);  // 60 nanometres: lost where a double holds 2^46 m
    finer += world->height(step) != there.height ? 1 : 0;
  }
  EXPECT_GT(finer, 1990);
}

TEST(FarAway, PositionsMoveByAMillimetreAsAtTheOrigin) {
  constexpr double kPitch = 64.0;
  Position near{0, 0, 0.25, 0.75}, far{kFar, -kFar, 0.25, 0.75};
  const Position start = far;
  for (int step = 0; step < 100'000; ++step) {
    near = near.movedBy(1e-3, -1e-3, kPitch).value();
    far = far.movedBy(1e-3, -1e-3, kPitch).value();
    ASSERT_EQ(far, (Position{near.i + kFar, near.j - kFar, near.u, near.v})) << "step " << step;
  }
  EXPECT_NEAR(offset(start, far, kPitch).east, 100.0, 1e-9);
  EXPECT_NEAR(offset(start, far, kPitch).north, -100.0, 1e-9);
}

/// Stays where it is.
class Stone final : public Object {
 public:
  explicit Stone(const Position& position) { motion_.position = position; }
  void update(double, const Ground&) override {}
  Motion motion() const override { return motion_; }

 private:
  Motion motion_;
};

std::unique_ptr<Engine> settledAt(const std::shared_ptr<const World>& world, const Position& position,
                                  int level) {
  EngineOptions options;
  options.view = {.level = level, .radius = 2};
  std::unique_ptr<Engine> engine = Engine::create(world, options).value();
  engine->add(std::make_unique<Stone>(position));
  engine->settle();
  return engine;
}

/// Meshes by where they lie, seen from patch (i, j).
using MeshPlace = std::tuple<std::int64_t, std::int64_t, int, int>;
std::map<MeshPlace, std::shared_ptr<const Mesh>> meshesFrom(const Scene& scene, std::int64_t i,
                                                            std::int64_t j, int intervals) {
  std::map<MeshPlace, std::shared_ptr<const Mesh>> meshes;
  for (const auto& mesh : scene.meshes()) {
    meshes[{mesh->originColumn - i * intervals, mesh->originRow - j * intervals, mesh->columns, mesh->rows}] =
        mesh;
  }
  return meshes;
}

TEST(FarAway, ScenesHaveTheGeometryOfTheOriginRelativeToTheirOwnPlace) {
  const std::shared_ptr<const World> world = repeatingWorld();
  for (const int level : {0, 2}) {
    const Position here{5, 6, 0.3, 0.6}, there{kFar + 5, -kFar + 6, 0.3, 0.6};
    const std::unique_ptr<Engine> near = settledAt(world, here, level), far = settledAt(world, there, level);
    const auto expected = meshesFrom(*near->scene(), 0, 0, world->intervals());
    const auto found = meshesFrom(*far->scene(), kFar, -kFar, world->intervals());
    EXPECT_EQ(expected.size(), far->scene()->meshes().size()) << "no two meshes at one place";
    ASSERT_EQ(found.size(), expected.size());
    for (const auto& [place, mesh] : expected) {
      ASSERT_TRUE(found.contains(place)) << "no mesh at " << std::get<0>(place) << ", " << std::get<1>(place);
      const Mesh& other = *found.at(place);
      EXPECT_EQ(other.level, mesh->level);
      EXPECT_EQ(other.vertices, mesh->vertices);
      EXPECT_EQ(*other.indices, *mesh->indices);
      EXPECT_EQ(other.minHeight, mesh->minHeight);
      EXPECT_EQ(other.maxHeight, mesh->maxHeight);
    }
  }
}

TEST(FarAway, DrawnGroundHasTheBitsOfTheOriginBetweenItsSamplesToo) {
  constexpr std::uint64_t kSeed = 92;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const std::shared_ptr<const World> world = repeatingWorld();
  const Position here{5, 6, 0.3, 0.6}, there{kFar + 5, -kFar + 6, 0.3, 0.6};
  const std::unique_ptr<Engine> near = settledAt(world, here, 1), far = settledAt(world, there, 1);
  for (int trial = 0; trial < 5000; ++trial) {
    const Position p{4 + below(random, 3), 5 + below(random, 3), uniform(random), uniform(random)};
    const Position q{p.i + kFar, p.j - kFar, p.u, p.v};
    const std::optional<double> drawn = near->drawnHeight(p);
    ASSERT_TRUE(drawn.has_value());
    ASSERT_EQ(far->drawnHeight(q), drawn);
    ASSERT_EQ(far->ground().height(q), near->ground().height(p));
  }
}

}  // namespace
}  // namespace teren
