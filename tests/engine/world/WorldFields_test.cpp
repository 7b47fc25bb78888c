// Layers that are continuous fields: sampled where they are wanted, without maps and without blending, and
// yet one landscape by every route.
#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Bake.h"
#include "teren/Engine.h"
#include "teren/Hash.h"
#include "teren/World.h"

#include "patch/NodeTask.h"
#include "tests/engine/world/RandomDraws.h"
#include "tests/engine/world/TestWorld.h"
#include "tests/engine/world/ValueNoise.h"
#include "tests/engine/world/WorldDescriptions.h"
#include "tests/support/SlicedWork.h"
#include "world/BaseMap.h"
#include "world/Layer.h"

namespace teren {
namespace {

LayerDescription field(double pitch, double height, double cell) {
  LayerDescription layer;
  layer.generator = "value-noise";
  layer.parameters = {{"mean", 3.0}, {"height", height}, {"cell", cell}};
  layer.pitch = pitch;
  return layer;
}

LayerDescription hostileField(const std::string& parameter, const std::string& value) {
  LayerDescription layer;
  layer.generator = "hostile-field";
  layer.parameters = {{parameter, value}};
  return layer;
}

/// Patches of 16 intervals; a field beneath and above a layer of maps.
std::shared_ptr<const World> mixedWorld(std::uint64_t seed = 1) {
  WorldDescription world =
      worldOf({field(512.0, 40.0, 128.0), noise(128.0, 3.0, 17), field(64.0, 4.0, 16.0)}, seed);
  world.samples = 33;
  return makeTestWorld(world);
}

/// Where fields could go wrong: at the origin, far away, and at both ends of the world.
constexpr std::int64_t kBases[] = {-2, (std::int64_t{1} << 40) - 1, -(std::int64_t{1} << 40) - 1,
                                   kMaxPatch - 4, -kMaxPatch};

HeightMap baked(const World& world, const BakeRegion& region, const BakeOptions& options = {}) {
  Result<HeightMap> map = bake(world, region, options);
  EXPECT_TRUE(map.ok()) << (map.ok() ? "" : map.error().message);
  return std::move(map).value();
}

std::uint32_t bits(double height) {
  return std::bit_cast<std::uint32_t>(static_cast<float>(height));
}

/// The position of sample (x, y) of a region at level 0.
Position placeIn(const World& world, const BakeRegion& region, int x, int y) {
  const int n = world.intervals();
  return {region.i + x / n, region.j + y / n, (x % n) / static_cast<double>(n),
          (y % n) / static_cast<double>(n)};
}

// ---- The door ----

TEST(WorldFields, AreRefusedWhereTheirPitchHasMoreSamplesThanFieldsAreAskedFor) {
  WorldDescription world = worldOf({field(std::ldexp(64.0, 15), 40.0, 128.0)});  // patches of 32 intervals
  EXPECT_TRUE(World::create(world, testRegistry()).ok());
  world.layers.front().pitch = std::ldexp(64.0, 16);
  const Result<std::shared_ptr<const World>> refused = World::create(world, testRegistry());
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("pitch is 4194304 m, expected at most 2^20 samples of 2 m"),
            std::string::npos)
      << refused.error().message;
}

// ---- Law 0: one function ----

TEST(WorldFields, HeightsAreTheBakedSamplesBitForBitHoweverFarAway) {
  constexpr std::uint64_t kSeed = 201;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  for (const std::int64_t i : kBases) {
    const auto world = mixedWorld(random.next());
    const BakeRegion region{i, kBases[below(random, 5)], 4, 4, 0};
    SCOPED_TRACE(testing::Message() << "patch " << region.i << ", " << region.j);
    const HeightMap map = baked(*world, region);
    for (int trial = 0; trial < 400; ++trial) {
      // The last row and column lie, at the world's end, on a line that no position can name.
      const int x = below(random, map.columns() - 1), y = below(random, map.rows() - 1);
      ASSERT_EQ(bits(world->height(placeIn(*world, region, x, y))), bits(map(x, y))) << x << ", " << y;
    }
  }
}

TEST(WorldFields, AreTheGeneratorsOwnSamplesWithoutBlending) {
  LayerDescription layer = field(64.0, 10.0, 16.0);
  layer.name = "hills";
  const auto plain = makeTestWorld(worldOf({layer}, 7));
  layer.blend = BlendKernel::linear;
  layer.preserveVariance = false;
  layer.samples = 9;
  const auto other = makeTestWorld(worldOf({layer}, 7));
  const HeightMap map = baked(*plain, {-3, 5, 2, 2, 0});
  EXPECT_TRUE(test::sameBits(baked(*other, {-3, 5, 2, 2, 0}).view(), map.view()));
  const ValueNoise generator(3.0, 10.0, 16.0);
  const FieldRequest request{.i = -3,
                             .j = 5,
                             .seed = layerSeed(7, "hills"),
                             .pitch = 64.0,
                             .spacing = 2.0,
                             .columns = 65,
                             .rows = 65};
  HeightMap asked(65, 65);
  test::finish(*generator.beginField(request, asked.view()));
  EXPECT_TRUE(test::sameBits(asked.view(), map.view()));
}

TEST(WorldFields, AreAtEveryLevelOneMonolithicGrid) {
  for (const std::int64_t base : {std::int64_t{-16}, (std::int64_t{1} << 40) - 16, kMaxPatch - 32}) {
    WorldDescription description = worldOf({field(512.0, 40.0, 128.0)}, 7);
    description.samples = 17;  // 8 intervals: level 4 is the last to draw the layer
    const auto world = makeTestWorld(description);
    for (int level = 0; level <= 4; ++level) {
      SCOPED_TRACE(testing::Message() << "patch " << base << ", level " << level);
      const BakeRegion region{base, -base - 32, 32, 32, level};
      const int side = (32 * 8 >> level) + 1;
      const FieldRequest request{.i = region.i >> 3,
                                 .j = region.j >> 3,
                                 .seed = layerSeed(7, "value-noise"),
                                 .pitch = 512.0,
                                 .spacing = 8.0 * (1 << level),
                                 .columns = side,
                                 .rows = side,
                                 .level = level};
      HeightMap whole(side, side);
      test::finish(*ValueNoise(3.0, 40.0, 128.0).beginField(request, whole.view()));
      EXPECT_TRUE(test::sameBits(baked(*world, region).view(), whole.view()));
    }
  }
}

TEST(WorldFields, LeaveDetailOutAboveLevelZeroOnly) {
  WorldDescription description = worldOf({field(512.0, 40.0, 64.0)});
  const auto world = makeTestWorld(description);
  const HeightMap finest = baked(*world, {0, 0, 8, 8, 0});
  int others = 0;
  const HeightMap coarse = baked(*world, {0, 0, 8, 8, 3});
  for (int y = 0; y < coarse.rows(); ++y) {
    for (int x = 0; x < coarse.columns(); ++x) others += coarse(x, y) != finest(8 * x, 8 * y) ? 1 : 0;
  }
  EXPECT_GT(others, coarse.columns() * coarse.rows() / 2);
}

TEST(WorldFields, AreDrawnAsTheirMeanAboveTheirCut) {
  const auto world = makeTestWorld(worldOf({field(64.0, 10.0, 16.0), noise(1024.0, 0.0)}));
  EXPECT_EQ(world->layers()[0].cutLevel(), 3);
  const auto spread = [&](int level) {
    const HeightMap map = baked(*world, {0, 0, 16, 16, level});
    const auto [low, high] = std::minmax_element(map.samples().begin(), map.samples().end());
    return *high - *low;
  };
  EXPECT_GT(spread(3), 1.0F);
  EXPECT_EQ(baked(*world, {0, 0, 16, 16, 4}).samples().front(), 3.0F);
  EXPECT_EQ(spread(4), 0.0F);
}

TEST(WorldFields, OfTheProjectsOwnNoiseAreOneFunctionByEveryRouteToTheWorldsEnds) {
  const std::vector<Values::Entry> settings[] = {
      {{"frequency", 0.004}, {"warp", 300.0}},
      {{"kind", std::string("simplex")}, {"frequency", 0.004}, {"fractal", std::string("ridged")}}};
  for (const std::vector<Values::Entry>& parameters : settings) {
    const auto generator = testRegistry().makeGenerator("noise", parameters).value();
    ASSERT_NE(asContinuous(*generator), nullptr);
    LayerDescription layer = field(512.0, 40.0, 128.0);
    layer.generator = "noise";
    layer.parameters = parameters;
    WorldDescription description = worldOf({layer}, 7);
    description.samples = 33;
    const auto world = makeTestWorld(description);
    for (const std::int64_t base : {std::int64_t{-16}, (std::int64_t{1} << 40) - 16, kMaxPatch - 32}) {
      for (int level = 0; level <= 4; ++level) {
        SCOPED_TRACE(testing::Message() << "patch " << base << ", level " << level);
        const BakeRegion region{base, -base - 32, 32, 32, level};
        const HeightMap map = baked(*world, region);
        const FieldRequest request{.i = region.i >> 3,
                                   .j = region.j >> 3,
                                   .seed = layerSeed(7, "noise"),
                                   .pitch = 512.0,
                                   .spacing = 4.0 * (1 << level),
                                   .columns = map.columns(),
                                   .rows = map.rows(),
                                   .level = level};
        HeightMap whole(map.columns(), map.rows());
        test::finish(*asContinuous(*generator)->beginField(request, whole.view()));
        ASSERT_TRUE(test::sameBits(map.view(), whole.view()));
        for (int k = 0; level == 0 && k < 200; ++k) {
          const int x = (k * 37) % (map.columns() - 1), y = (k * 101) % (map.rows() - 1);
          ASSERT_EQ(bits(world->height(placeIn(*world, region, x, y))), bits(map(x, y))) << x << ", " << y;
        }
      }
    }
    EXPECT_FALSE(world->failure().has_value());
  }
}

// ---- Law 1: the same bits ----

TEST(WorldFields, HaveTheSameBitsForAnySlicesOrderAndWorkers) {
  const auto world = mixedWorld();
  for (const int level : {0, 2}) {
    const BakeRegion region{-4, 8, 16, 8, level};
    const HeightMap plain = baked(*world, region);
    BakeOptions options;
    options.slice = std::chrono::microseconds(5);
    options.visitSeed = 99;
    EXPECT_TRUE(test::sameBits(baked(*world, region, options).view(), plain.view())) << "level " << level;
    options = {};
    options.workers = 3;
    EXPECT_TRUE(test::sameBits(baked(*world, region, options).view(), plain.view())) << "level " << level;
  }
}

TEST(WorldFields, CanBeGivenUpAfterAnyStep) {
  const auto world = mixedWorld();
  BaseMapStore store(std::size_t{1} << 20);
  const auto node = [&](int steps) {
    NodeTask task(*world, {1, -1, 2}, store);
    for (int step = 0; step < steps; ++step) {
      if (task.step(test::shortestSlice())) break;
    }
    return task.takeHeights();
  };
  constexpr int kAll = 1 << 20;
  const HeightMap whole = node(kAll);
  for (int steps = 0; steps < 60; ++steps) node(steps);
  EXPECT_TRUE(test::sameBits(node(kAll).view(), whole.view()));
}

// ---- Law 2: watertight ----

TEST(WorldFields, NeighboursShareTheirBorderBitForBitAtEveryLevel) {
  const auto world = mixedWorld();
  BaseMapStore store(std::size_t{16} << 20);
  const auto node = [&](const NodeKey& key) {
    NodeTask task(*world, key, store);
    test::finish(task);
    return task.takeHeights();
  };
  for (int level = 0; level <= world->topLevel(); ++level) {
    for (const std::int64_t base : {std::int64_t{0}, std::int64_t{1} << 40}) {
      const std::int64_t i = (base >> level) - 1, j = -(base >> level) - 1;
      const HeightMap west = node({level, i, j}), east = node({level, i + 1, j}),
                      north = node({level, i, j + 1});
      const int last = west.columns() - 1;
      for (int k = 0; k <= last; ++k) {
        ASSERT_EQ(bits(west(last, k)), bits(east(0, k))) << "level " << level << ", row " << k;
        ASSERT_EQ(bits(west(k, last)), bits(north(k, 0))) << "level " << level << ", column " << k;
      }
    }
  }
}

// ---- Law 7: measured error ----

TEST(WorldFields, QueriesBoundTheirErrorAndNotIdly) {
  constexpr std::uint64_t kSeed = 202;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  std::vector<double> ratios;
  for (int trial = 0; trial < 200; ++trial) {
    WorldDescription description =
        worldOf({field(64.0, 10.0, 16.0 * (1 << below(random, 3)))}, random.next());
    if (trial % 4 == 0) description.layers.push_back(noise(64.0, 0.1, 65));
    if (trial % 4 == 1) description.layers.push_back(field(512.0, 100.0, 512.0));
    description.samples = trial % 2 == 0 ? 65 : 17;
    const auto world = makeTestWorld(description);
    const double n = world->intervals();
    const std::int64_t bias = trial % 3 == 0 ? std::int64_t{1} << 40 : 0;
    const Position corner{bias + below(random, 50), below(random, 50) - bias,
                          below(random, world->intervals()) / n, below(random, world->intervals()) / n};
    double worst = 0.0, bound = 0.0;
    for (int point = 0; point < 100; ++point) {
      Position at = corner;
      at.u += uniform(random) / n;
      at.v += point % 3 == 0 ? at.u - corner.u : uniform(random) / n;
      const SurfacePoint found = world->query(at);
      ASSERT_EQ(found.height, world->height(at));
      ASSERT_LE(std::fabs(found.height - found.drawn), found.error) << "trial " << trial;
      worst = std::max(worst, std::fabs(found.height - found.drawn));
      bound = found.error;
    }
    ratios.push_back(bound / worst);
  }
  std::sort(ratios.begin(), ratios.end());
  RecordProperty("median_bound_over_truth_percent", static_cast<int>(100.0 * ratios[ratios.size() / 2]));
  EXPECT_LE(ratios[ratios.size() / 2], 20.0);
}

TEST(WorldFields, QueriesTakeTheErrorThatTheGeneratorPromisesForTheSpacingOfLevelZero) {
  WorldDescription description = worldOf({field(64.0, 10.0, 64.0)});
  for (const int samples : {17, 33, 65}) {
    description.samples = samples;
    const auto world = makeTestWorld(description);
    const double promised = ValueNoise(3.0, 10.0, 64.0).fieldError(world->spacing(0));
    EXPECT_NEAR(world->query({5, 6, 0.3, 0.7}).error, promised, 1e-5) << samples;
  }
}

TEST(WorldFields, QueriesCountTheRoundingOfSamplesToFloat) {
  // Two high layers that cancel each other: little ground is left, of samples 0.06 m apart.
  LayerDescription up = field(64.0, 0.05, 64.0), down = up;
  up.parameters[0] = {"mean", 1e6};
  down.parameters[0] = {"mean", -1e6};
  const auto world = makeTestWorld(worldOf({up, down}));
  double worst = 0.0;
  for (int k = 0; k < 1000; ++k) {
    const SurfacePoint point = world->query({k, -k, 0.013 + k * 0.0009, 0.5});
    ASSERT_LE(std::fabs(point.height - point.drawn), point.error);
    worst = std::max(worst, std::fabs(point.height - point.drawn) / point.error);
  }
  EXPECT_GE(worst, 0.1) << "an idle bound";
}

TEST(WorldFields, QueriesPromiseNoLargerErrorThanHeightsCanDiffer) {
  const auto world = makeTestWorld(worldOf({hostileField("way", "error-idle")}));
  EXPECT_NEAR(world->query({5, 6, 0.3, 0.7}).error, 25.0, 1e-3);
}

TEST(WorldFields, QueriesSpanTheTriangleOfTheBakedSamples) {
  constexpr std::uint64_t kSeed = 203;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const auto world = mixedWorld();
  const HeightMap map = baked(*world, {-1, -1, 2, 2, 0});
  for (int trial = 0; trial < 300; ++trial) {
    const double x = 32.0 * uniform(random), y = 32.0 * uniform(random);  // in samples
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const SurfacePoint point =
        world->query({column / 16 - 1, row / 16 - 1, x / 16.0 - column / 16, y / 16.0 - row / 16});
    const auto at = [&](int dx, int dy) { return static_cast<double>(map(column + dx, row + dy)); };
    const double fx = x - column, fy = y - row;
    const double drawn = fx >= fy ? at(0, 0) + fx * (at(1, 0) - at(0, 0)) + fy * (at(1, 1) - at(1, 0))
                                  : at(0, 0) + fy * (at(0, 1) - at(0, 0)) + fx * (at(1, 1) - at(0, 1));
    ASSERT_NEAR(point.drawn, drawn, 1e-9);
  }
}

// ---- Law 8: nothing trusted ----

TEST(WorldFields, ThatGoWrongInPlacesAreTheMeanThereByEveryRoute) {
  for (const char* work : {"nan", "above", "unwritten"}) {
    SCOPED_TRACE(work);
    LayerDescription layer = hostileField("work", work), sound = hostileField("work", "well");
    layer.name = sound.name = "field";
    const auto world = makeTestWorld(worldOf({layer})), well = makeTestWorld(worldOf({sound}));
    const BakeRegion region{-1, -1, 3, 3, 0};
    const HeightMap map = baked(*world, region), truth = baked(*well, region);
    int replaced = 0;
    for (int y = 0; y + 1 < map.rows(); y += 3) {
      for (int x = 0; x + 1 < map.columns(); ++x) {
        const bool bad = truth(x, y) > 103.0F;
        ASSERT_EQ(map(x, y), bad ? 100.0F : truth(x, y)) << x << ", " << y;
        ASSERT_EQ(world->height(placeIn(*world, region, x, y)), static_cast<double>(map(x, y)));
        replaced += bad ? 1 : 0;
      }
    }
    EXPECT_GT(replaced, 100);
    EXPECT_LT(replaced, map.rows() / 3 * map.columns() * 3 / 4);
    const std::vector<std::string> messages = world->takeMessages();
    ASSERT_EQ(messages.size(), 1U);
    for (const char* part :
         {"layer \"field\"", "plugin \"hostile-field\" wrote the height", "87.4999 to 112.5001 m"})
      EXPECT_NE(messages[0].find(part), std::string::npos) << messages[0];
    EXPECT_TRUE(world->failure().has_value());
    EXPECT_FALSE(well->failure().has_value());
  }
}

TEST(WorldFields, ThatGoWrongInPlacesKeepTheBoundOfTheirQueriesTrue) {
  constexpr std::uint64_t kSeed = 204;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const auto world = makeTestWorld(worldOf({hostileField("work", "nan")}));
  int raised = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const SurfacePoint point =
        world->query({below(random, 9), below(random, 9), uniform(random), uniform(random)});
    ASSERT_LE(std::fabs(point.height - point.drawn), point.error);
    raised += point.error > 20.0 ? 1 : 0;
  }
  EXPECT_GT(raised, 100);
  EXPECT_LT(raised, 2000);
}

TEST(WorldFields, ThatThrowBeginNothingOrAreNeverDoneAreTheirMeanAndTheRestGoesOn) {
  for (const char* work : {"throws", "late", "begin-throws", "begin-nothing", "endless"}) {
    SCOPED_TRACE(work);
    const LayerDescription rest = noise(128.0, 3.0, 9, "rest");
    LayerDescription level = rest;
    level.parameters.emplace_back("mean", 100.0);
    WorldDescription with = worldOf({hostileField("work", work), rest}), without = worldOf({level});
    with.samples = without.samples = 5;
    const auto world = makeTestWorld(with), flat = makeTestWorld(without);
    const HeightMap map = baked(*world, {0, 0, 2, 2, 0}), expected = baked(*flat, {0, 0, 2, 2, 0});
    for (std::size_t sample = 0; sample < map.samples().size(); ++sample)
      ASSERT_NEAR(map.samples()[sample], expected.samples()[sample], 1e-4);
    EXPECT_EQ(bits(world->height({1, 0, 0.5, 0.0})), bits(map(3, 0)));
    EXPECT_EQ(world->takeMessages().size(), 1U);
  }
}

TEST(WorldFields, ThatThrowHereAndThereAreBakedTheSameInAnyOrder) {
  const auto world = makeTestWorld(worldOf({hostileField("work", "here-and-there")}));
  const BakeRegion region{-4, -4, 9, 9, 0};
  const HeightMap plain = baked(*world, region);
  const auto [low, high] = std::minmax_element(plain.samples().begin(), plain.samples().end());
  EXPECT_LT(*low, *high);
  for (const int workers : {0, 3}) {
    BakeOptions options;
    options.visitSeed = 17;
    options.workers = workers;
    EXPECT_TRUE(test::sameBits(baked(*world, region, options).view(), plain.view())) << workers << " workers";
  }
}

TEST(WorldFields, OfAGeneratorThatLiesAboutItselfAreRefusedWithASentence) {
  const std::pair<const char*, const char*> cases[] = {
      {"traits-throw", "threw \"no?traits\" when asked for its traits"},
      {"error-throws", "threw something that is no std::exception when asked for its error"},
      {"error-nan", "promises an error of nan m for samples 2 m apart"},
      {"error-negative", "promises an error of -1 m for samples 2 m apart, expected 0 to 1e30"}};
  for (const auto& [way, sentence] : cases) {
    const auto world = World::create(worldOf({hostileField("way", way)}), testRegistry());
    ASSERT_FALSE(world.ok()) << way;
    EXPECT_NE(world.error().message.find(sentence), std::string::npos) << world.error().message;
    EXPECT_EQ(world.error().message.find("layer \"hostile-field\": \"hostile-field\" "), 0U)
        << world.error().message;
  }
}

// ---- Filters ----

TEST(WorldFields, WithFiltersAreBlendedFromFilteredMapsOfTheField) {
  LayerDescription layer = field(64.0, 10.0, 16.0);
  layer.filters = {{"band", {}}};
  const auto world = makeTestWorld(worldOf({layer}, 7));
  const Layer& made = world->layers()[0];
  EXPECT_EQ(made.field(), nullptr);
  // At a lattice point one map has all the weight: what is there is the middle of the filtered map.
  const auto band = testRegistry().makeFilter("band", {}).value();
  const MapRequest request = made.request(3, -2, 0);
  HeightMap map(request.samples, request.samples);
  test::finish(*ValueNoise(3.0, 10.0, 16.0).begin(request, map.view()));
  test::finish(*band->begin(request, map.view()));
  EXPECT_EQ(bits(world->height({3, -2, 0.0, 0.0})), bits(map(32, 32)));
  const HeightMap grid = baked(*world, {-2, 4, 2, 2, 0});
  EXPECT_EQ(bits(world->height({-1, 5, 0.5, 0.25})), bits(grid(48, 40)));
  EXPECT_TRUE(world->takeMessages().empty());
}

// ---- In the engine ----

class Stone final : public Object {
 public:
  explicit Stone(const Position& position) { place.position = position; }
  void update(double, const Ground&) override {}
  Motion motion() const override { return place; }
  Motion place;
};

using Surface = std::map<std::tuple<int, std::int64_t, std::int64_t>, float>;

Surface surfaceOf(const Scene& scene) {
  Surface surface;
  for (const auto& mesh : scene.meshes()) {
    for (const SurfaceVertex& vertex : mesh->vertices) {
      const std::int64_t stride = std::int64_t{1} << mesh->level;
      surface[{mesh->level, mesh->originColumn + vertex.column * stride,
               mesh->originRow + vertex.row * stride}] = vertex.height;
    }
  }
  return surface;
}

TEST(WorldFields, AppearInTheEngineAndComeBackWithTheSameBitsAfterTheyWereDropped) {
  const auto world = mixedWorld();
  for (const int workers : {0, 2}) {
    SCOPED_TRACE(testing::Message() << workers << " workers");
    EngineOptions options;
    options.view = {.level = 1, .radius = 6};
    options.workers = workers;
    options.capBytes = EngineOptions::kLeastCap;
    const std::unique_ptr<Engine> engine = Engine::create(world, options).value();
    const Position home{(std::int64_t{1} << 40) + 5, 6, 0.5, 0.25};
    auto& stone = static_cast<Stone&>(engine->add(std::make_unique<Stone>(home)));
    engine->settle();
    const Surface first = surfaceOf(*engine->scene());
    EXPECT_GT(first.size(), 13U * 13U * 15U * 15U);
    EXPECT_EQ(engine->finestHeight(home), world->query(home).drawn);
    stone.place.position = {-7, 1'000'000, 0.5, 0.25};
    engine->settle();
    EXPECT_FALSE(engine->drawnHeight(home).has_value());
    stone.place.position = home;
    engine->settle();
    EXPECT_EQ(surfaceOf(*engine->scene()), first);
    EXPECT_LE(engine->figures().peakBytes, options.capBytes);
    EXPECT_TRUE(engine->takeMessages().empty());
  }
}

TEST(WorldFields, AreCountedInWhatANodesMakingHolds) {
  WorldDescription flat = worldOf({noise(4096.0, 0.0, 3)}),
                   description = worldOf({field(4096.0, 10.0, 64.0)});
  const auto maps = makeTestWorld(flat), world = makeTestWorld(description);
  const std::size_t node = 33 * 33 * (sizeof(float) + sizeof(double));
  EXPECT_GE(NodeTask::mostBytes(*world, 0), node + 33 * 33 * sizeof(float));
  EXPECT_LE(NodeTask::mostBytes(*world, 0), node + 33 * 33 * sizeof(float) + 2048);
  EXPECT_EQ(NodeTask::mostBytes(*world, 20), NodeTask::mostBytes(*maps, 20))
      << "above the cut nothing is asked for";
}

}  // namespace
}  // namespace teren
