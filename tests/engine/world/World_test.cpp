#include "teren/World.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Bake.h"
#include "teren/Hash.h"

#include "tests/engine/world/RandomDraws.h"
#include "tests/engine/world/TestWorld.h"
#include "world/Layer.h"

namespace teren {
namespace {

LayerDescription noise(double pitch, double deviation, int samples = 65, const std::string& name = "") {
  LayerDescription layer;
  layer.name = name;
  layer.generator = "noise";
  layer.parameters = {{"deviation", deviation}};
  layer.pitch = pitch;
  layer.samples = samples;
  return layer;
}

LayerDescription fault(double pitch, double deviation, int samples = 65) {
  LayerDescription layer = noise(pitch, deviation, samples);
  layer.generator = "fault";
  return layer;
}

WorldDescription worldOf(std::vector<LayerDescription> layers, std::uint64_t seed = 1) {
  WorldDescription world;
  world.seed = seed;
  world.layers = std::move(layers);
  return world;
}

std::string refusal(const WorldDescription& description) {
  const auto world = World::create(description, testRegistry());
  return world.ok() ? "(accepted)" : world.error().message;
}

// ---- What is refused (law 8) ----

struct Refused {
  std::string name;
  std::function<void(WorldDescription&)> spoil;
  std::vector<std::string> needles;
};

std::vector<Refused> refusedWorlds() {
  std::vector<Refused> cases;
  for (const int samples :
       {64, 66, 4, 3, 2, 1, 0, -65, 2049, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()}) {
    cases.push_back({"world samples",
                     [=](WorldDescription& w) { w.samples = samples; },
                     {"samples is " + std::to_string(samples), "2^k + 1 from 5 to 1025"}});
  }
  for (const int samples : {64, 2, 1, 0, -3, 4097, std::numeric_limits<int>::min()}) {
    cases.push_back({"layer samples",
                     [=](WorldDescription& w) { w.layers[1].samples = samples; },
                     {"layer \"noise\"", "samples is " + std::to_string(samples), "2^k + 1 from 3 to 2049"}});
  }
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(),
                   kInfinity = std::numeric_limits<double>::infinity();
  const std::pair<double, const char*> worldPitches[] = {{0.0, "0"},         {-64.0, "-64"},  {kNaN, "nan"},
                                                         {kInfinity, "inf"}, {1e-4, "1e-04"}, {2e6, "2e+06"}};
  for (const auto& [pitch, text] : worldPitches) {
    cases.push_back({"world pitch",
                     [p = pitch](WorldDescription& w) { w.pitch = p; },
                     {std::string("pitch is ") + text, "0.001"}});
  }
  const std::pair<double, const char*> layerPitches[] = {
      {32.0, "32"},  {96.0, "96"},       {64.0 + 1e-10, "64.0000000001"},   {0.0, "0"}, {-64.0, "-64"},
      {kNaN, "nan"}, {kInfinity, "inf"}, {64.0 * 0x1p41, "140737488355328"}};
  for (const auto& [pitch, text] : layerPitches) {
    cases.push_back({"layer pitch",
                     [p = pitch](WorldDescription& w) { w.layers[0].pitch = p; },
                     {"layer \"fault\"", std::string("pitch is ") + text, "64 m times 2^m"}});
  }
  cases.push_back({"no layers", [](WorldDescription& w) { w.layers.clear(); }, {"no layers"}});
  cases.push_back({"unknown generator",
                   [](WorldDescription& w) { w.layers[1].generator = "fualt"; },
                   {"layer \"fualt\"", "\"fualt\"", "fault"}});
  cases.push_back(
      {"no generator", [](WorldDescription& w) { w.layers[1].generator = ""; }, {"layer \"\"", "\"\""}});
  cases.push_back(
      {"filter as generator", [](WorldDescription& w) { w.layers[1].generator = "band"; }, {"band"}});
  cases.push_back({"unknown filter",
                   [](WorldDescription& w) {
                     w.layers[1].filters = {{"bend", {}}};
                   },
                   {"layer \"noise\"", "\"bend\"", "band"}});
  cases.push_back({"generator as filter",
                   [](WorldDescription& w) {
                     w.layers[1].filters = {{"fault", {}}};
                   },
                   {"fault"}});
  cases.push_back({"unknown parameter",
                   [](WorldDescription& w) {
                     w.layers[1].parameters = {{"hurst", 1.0}};
                   },
                   {"layer \"noise\"", "hurst"}});
  cases.push_back({"parameter outside",
                   [](WorldDescription& w) {
                     w.layers[0].parameters = {{"faults", std::int64_t{0}}};
                   },
                   {"layer \"fault\"", "faults", "0"}});
  cases.push_back({"filter parameter",
                   [](WorldDescription& w) {
                     w.layers[0].filters = {{"band", {{"k", 2.0}}}};
                   },
                   {"layer \"fault\"", "k", "2"}});
  cases.push_back({"equal names",
                   [](WorldDescription& w) { w.layers[0].name = w.layers[1].name = "hills\nand dales"; },
                   {"two layers", "\"hills?and dales\""}});
  for (const char* way : {"throws", "throws-int", "nan", "infinite", "huge", "reversed", "negative"}) {
    cases.push_back({"generator's range",
                     [=](WorldDescription& w) {
                       w.layers[1].generator = "hostile";
                       w.layers[1].parameters = {{"way", std::string(way)}};
                     },
                     {"layer \"hostile\"", "range"}});
    cases.push_back({"filter's range",
                     [=](WorldDescription& w) {
                       w.layers[1].filters = {{"band", {}}, {"liar", {{"way", std::string(way)}}}};
                     },
                     {"layer \"noise\"", "\"liar\"", "range"}});
  }
  return cases;
}

TEST(World, IsRefusedWithOneSentenceThatNamesLayerFieldAndValue) {
  for (const Refused& refused : refusedWorlds()) {
    SCOPED_TRACE(refused.name);
    WorldDescription description = worldOf({fault(64.0, 4.0), noise(64.0, 1.0)});
    ASSERT_EQ(refusal(description), "(accepted)");
    refused.spoil(description);
    const std::string sentence = refusal(description);
    for (const std::string& needle : refused.needles) {
      EXPECT_NE(sentence.find(needle), std::string::npos) << "no '" << needle << "' in: " << sentence;
    }
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    EXPECT_NE(sentence.back(), '.') << sentence;
  }
}

TEST(World, TakesTheSmallestAndTheLargestOfEverything) {
  WorldDescription small = worldOf({noise(0.001, 1.0, 3)});
  small.pitch = 0.001;
  small.samples = 5;
  EXPECT_EQ(makeTestWorld(small)->intervals(), 2);
  EXPECT_TRUE(std::isfinite(makeTestWorld(small)->height({0, 0, 0.3, 0.7})));
  WorldDescription large = worldOf({noise(1e6 * 0x1p40, 1.0, 2049)});
  large.pitch = 1e6;
  large.samples = 1025;
  const auto world = makeTestWorld(large);
  EXPECT_EQ(world->intervals(), 512);
  EXPECT_EQ(world->topLevel(), 9 + 40 - 2);
  EXPECT_TRUE(std::isfinite(world->height({kMaxPatch - 1, -kMaxPatch, 0.99, 0.01})));
  const SurfacePoint last = world->query({kMaxPatch - 1, kMaxPatch - 1, 1.0 - 0x1p-53, 1.0 - 0x1p-53});
  EXPECT_LE(std::fabs(last.height - last.drawn), last.error);
}

// ---- Names ----

std::vector<std::string> names(const WorldDescription& description) {
  std::vector<std::string> result;
  const auto world = makeTestWorld(description);
  for (const Layer& layer : world->layers()) result.push_back(layer.name());
  return result;
}

TEST(World, NamesLayersAfterTheirGeneratorAndNumbersRepetitions) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(worldOf({noise(64, 1), fault(64, 1), noise(64, 1), noise(128, 1), fault(64, 1)})),
            (Names{"noise", "fault", "noise-2", "noise-3", "fault-2"}));
  EXPECT_EQ(names(worldOf({noise(64, 1), noise(64, 1, 65, "hills"), noise(64, 1)})),
            (Names{"noise", "hills", "noise-2"}));
  EXPECT_EQ(
      names(worldOf({noise(64, 1), noise(64, 1, 65, "noise"), noise(64, 1, 65, "noise-2"), noise(64, 1)})),
      (Names{"noise-3", "noise", "noise-2", "noise-4"}));
}

TEST(World, NamesThousandsOfLayersAtOnce) {
  // Trying every number against every layer would take hours; this ends within a second.
  const WorldDescription many = worldOf(std::vector<LayerDescription>(20'000, noise(64.0, 1.0)));
  EXPECT_EQ(names(many).back(), "noise-20000");
}

TEST(World, IsNotReshuffledByALayerInBetween) {
  constexpr std::uint64_t kSeed = 71;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const LayerDescription first = noise(64.0, 4.0, 65, "a"), last = noise(512.0, 40.0, 33, "b");
  const auto before = makeTestWorld(worldOf({first, last}));
  const auto after = makeTestWorld(worldOf({first, noise(128.0, 0.0, 17, "flat"), last}));
  for (int trial = 0; trial < 200; ++trial) {
    const Position at{below(random, 200) - 100, below(random, 200) - 100, uniform(random), uniform(random)};
    ASSERT_EQ(before->height(at), after->height(at));
  }
}

TEST(World, DependsOnItsSeedAndOnItsLayersNames) {
  const Position at{3, 4, 0.3, 0.7};
  const double height = makeTestWorld(worldOf({noise(64.0, 4.0, 65, "a")}, 1))->height(at);
  EXPECT_EQ(makeTestWorld(worldOf({noise(64.0, 4.0, 65, "a")}, 1))->height(at), height);
  EXPECT_NE(makeTestWorld(worldOf({noise(64.0, 4.0, 65, "a")}, 2))->height(at), height);
  EXPECT_NE(makeTestWorld(worldOf({noise(64.0, 4.0, 65, "b")}, 1))->height(at), height);
}

// ---- Law 0: the landscape is a function, C1 with smooth blending ----

/// `at` moved by a whole number of 2^-14 patches along one axis; exact.
Position nudged(Position at, bool east, int steps) {
  std::int64_t& patch = east ? at.i : at.j;
  double& fraction = east ? at.u : at.v;
  const double moved = fraction + steps * 0x1p-14, whole = std::floor(moved);
  patch += static_cast<std::int64_t>(whole);
  fraction = moved - whole;
  return at;
}

/// By how much the slope [m/m] jumps at a place, going east or north: one-sided difference quotients of
/// second order, so that a C1 function shows only h^2 times its third derivative.
double kink(const World& world, const Position& at, bool east) {
  const auto height = [&](int steps) { return world.height(nudged(at, east, steps)); };
  const double h = world.pitch() * 0x1p-14, here = height(0);
  const double ahead = (-3.0 * here + 4.0 * height(1) - height(2)) / (2.0 * h);
  const double behind = (3.0 * here - 4.0 * height(-1) + height(-2)) / (2.0 * h);
  return std::fabs(ahead - behind);
}

constexpr double kSmoothKink = 2e-3;  // [m/m]; creases are a hundred times larger

struct ThreeLayers {
  std::vector<double> pitches = {8192.0, 512.0, 64.0};
  std::vector<double> deviations = {500.0, 40.0, 4.0};
};

/// Layers at 8192, 512 and 64 m with smooth blending; the layer `creased`, if any, with linear.
std::shared_ptr<const World> threeLayers(const std::string& generator, bool preserveVariance,
                                         int creased = -1) {
  WorldDescription world;
  world.seed = 2024;
  const ThreeLayers three;
  for (int k = 0; k < 3; ++k) {
    const auto at = static_cast<std::size_t>(k);
    LayerDescription layer = noise(three.pitches[at], three.deviations[at]);
    layer.generator = generator;
    layer.preserveVariance = preserveVariance;
    if (k == creased) layer.blend = BlendKernel::linear;
    world.layers.push_back(layer);
  }
  return makeTestWorld(world);
}

/// A random place on a line, one of every `spacing` patches (a power of two; below 1: inside patches too).
/// Every third near the origin, every third with negative indices near it, every third at lattice index
/// `far` of the layer whose pitch is `patches` patches.
Position onLine(RandomSequence& random, int trial, bool east, double spacing, std::int64_t patches) {
  const std::int64_t base[] = {0, -1000 * patches, ((std::int64_t{1} << 40) - 50) * patches};
  const double line = std::floor(uniform(random) * 100.0 * static_cast<double>(patches) / spacing) * spacing;
  Position at{base[trial % 3], base[(trial / 3) % 3], 0.0, 0.0};
  (east ? at.i : at.j) += static_cast<std::int64_t>(std::floor(line));
  (east ? at.u : at.v) = line - std::floor(line);
  (east ? at.j : at.i) += below(random, static_cast<int>(100 * patches));
  (east ? at.v : at.u) = uniform(random);
  return at;
}

/// Jumps of the slope across random lines of one layer.
std::vector<double> kinks(const World& world, RandomSequence& random, double spacing, std::int64_t patches) {
  std::vector<double> result;
  for (int trial = 0; trial < 60; ++trial) {
    const bool east = trial % 2 == 0;
    result.push_back(kink(world, onLine(random, trial / 2, east, spacing, patches), east));
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST(World, IsC1AcrossTheLatticeLinesOfEveryLayer) {
  constexpr std::uint64_t kSeed = 72;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  for (const char* generator : {"fault", "noise"}) {
    for (const bool preserve : {true, false}) {
      const auto world = threeLayers(generator, preserve);
      for (const std::int64_t patches : {128, 8, 1}) {
        SCOPED_TRACE(testing::Message()
                     << generator << ", preserveVariance " << preserve << ", pitch " << 64 * patches);
        EXPECT_LE(kinks(*world, random, static_cast<double>(patches), patches).back(), kSmoothKink);
      }
    }
  }
}

TEST(World, IsC1AcrossTheLinesOfSamplesOfEveryLayer) {
  constexpr std::uint64_t kSeed = 73;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  for (const char* generator : {"fault", "noise"}) {
    const auto world = threeLayers(generator, true);
    for (const std::int64_t patches : {128, 8, 1}) {
      SCOPED_TRACE(testing::Message() << generator << ", pitch " << 64 * patches);
      EXPECT_LE(kinks(*world, random, static_cast<double>(patches) / 32.0, patches).back(), kSmoothKink);
    }
  }
}

TEST(World, IsCreasedAlongTheLatticeLinesOfALayerThatBlendsLinearly) {
  constexpr std::uint64_t kSeed = 74;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const std::int64_t patches[] = {128, 8, 1};
  for (int creased = 0; creased < 3; ++creased) {
    const std::int64_t pitch = patches[creased];
    SCOPED_TRACE(testing::Message() << "pitch " << 64 * pitch);
    const auto world = threeLayers("fault", true, creased);
    const std::vector<double> jumps = kinks(*world, random, static_cast<double>(pitch), pitch);
    EXPECT_GE(jumps[jumps.size() / 2], 10.0 * kSmoothKink);
  }
}

TEST(World, IsContinuousAcrossPatchBordersToTheLastBits) {
  constexpr std::uint64_t kSeed = 75;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const auto world = threeLayers("fault", true);
  for (int trial = 0; trial < 200; ++trial) {
    const std::int64_t bias = trial % 2 == 0 ? 0 : std::int64_t{1} << 47;
    const Position on{bias + 128 * below(random, 5), below(random, 500) - 250, 0.0, uniform(random)};
    const Position west{on.i - 1, on.j, 1.0 - 0x1p-53, on.v};
    ASSERT_NEAR(world->height(on), world->height(west), 1e-9);
  }
}

TEST(World, IsStraightOverMicrometresHoweverFarAway) {
  // The slope over 2^-30 of a patch (60 nm) is the slope over 2^-20: no place is rounded on the way.
  constexpr std::uint64_t kSeed = 80;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const auto world = threeLayers("fault", true);
  for (int trial = 0; trial < 100; ++trial) {
    const std::int64_t bias = trial % 2 == 0 ? 0 : std::int64_t{1} << 51;
    const Position at{bias + below(random, 1000), bias - below(random, 1000), 0.99 * uniform(random),
                      uniform(random)};
    const auto slope = [&](double step) {
      Position beside = at;
      beside.u += step;
      return (world->height(beside) - world->height(at)) / ((beside.u - at.u) * 64.0);
    };
    ASSERT_NEAR(slope(0x1p-30), slope(0x1p-20), 2e-4);
  }
}

TEST(World, GivesEveryRouteToAPointTheSameBits) {
  constexpr std::uint64_t kSeed = 76;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const WorldDescription description = WorldDescription::standard();
  const auto world = makeTestWorld(description), other = makeTestWorld(description);
  for (int trial = 0; trial < 200; ++trial) {
    // Multiples of 2^-10 m: every route is exact.
    const double x = std::ldexp(static_cast<double>(random.nextBits(30)) - 0x1p29, -10);
    const double y = std::ldexp(static_cast<double>(random.nextBits(30)) - 0x1p29, -10);
    const double dx = std::ldexp(static_cast<double>(random.nextBits(22)) - 0x1p21, -10);
    const Position direct = *Position::fromMetres(x, y, world->pitch());
    const Position moved =
        *Position::fromMetres(x - dx, y + dx, world->pitch())->movedBy(dx, -dx, world->pitch());
    ASSERT_EQ(direct, moved);
    const double height = world->height(direct);
    ASSERT_EQ(world->height(moved), height);
    ASSERT_EQ(world->query(direct).height, height);
    if (trial % 10 == 0) {
      ASSERT_EQ(other->height(direct), height) << "another world of the same description";
    }
  }
}

TEST(World, AnswersManyThreadsWithTheSameBits) {
  const auto world = makeTestWorld(worldOf({fault(64.0, 4.0), fault(512.0, 40.0)})),
             alone = makeTestWorld(worldOf({fault(64.0, 4.0), fault(512.0, 40.0)}));
  std::vector<std::vector<double>> found(4);
  std::vector<std::thread> threads;
  for (std::size_t thread = 0; thread < found.size(); ++thread) {
    threads.emplace_back([&, thread] {
      RandomSequence random(77);
      for (int k = 0; k < 300; ++k)
        found[thread].push_back(world->height({below(random, 6), below(random, 6), uniform(random), 0.5}));
    });
  }
  for (std::thread& thread : threads) thread.join();
  RandomSequence random(77);
  for (std::size_t k = 0; k < 300; ++k) {
    const int i = below(random, 6), j = below(random, 6);
    const double height = alone->height({i, j, uniform(random), 0.5});
    for (const auto& heights : found) ASSERT_EQ(heights[k], height);
  }
}

// ---- Law 0: a grid samples the function ----

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

TEST(World, SumsTheMeansAndTheSquaresOfItsLayersPromises) {
  LayerDescription a = noise(64.0, 3.0), b = noise(512.0, 4.0);
  a.parameters.emplace_back("mean", 100.0);
  b.parameters.emplace_back("mean", -30.0);
  const auto world = makeTestWorld(worldOf({a, b}));
  EXPECT_DOUBLE_EQ(world->mean(), 70.0);
  EXPECT_DOUBLE_EQ(world->deviation(), 5.0);
  EXPECT_EQ(world->spacing(0), 2.0);
  EXPECT_EQ(world->spacing(3), 16.0);
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

// ---- Law 3: preserveVariance ----

/// Standard deviations over 4,000 worlds, at lattice points and at patch centres of four far patches a world.
struct Deviations {
  double latticePoint = 0.0, centre = 0.0;
};

Deviations deviationsOver4000Worlds(bool preserveVariance) {
  LayerDescription layer = fault(64.0, 10.0, 9);
  layer.preserveVariance = preserveVariance;
  double point = 0.0, centre = 0.0;
  constexpr int kWorlds = 4000, kPatches = 4;
  for (std::uint64_t seed = 0; seed < kWorlds; ++seed) {
    const auto world = makeTestWorld(worldOf({layer}, seed));
    for (int patch = 0; patch < kPatches; ++patch) {
      const double a = world->height({10 * patch, 0, 0.0, 0.0}), b = world->height({10 * patch, 0, 0.5, 0.5});
      point += a * a / (kWorlds * kPatches);
      centre += b * b / (kWorlds * kPatches);
    }
  }
  return {std::sqrt(point), std::sqrt(centre)};  // the mean of fault formation is 0
}

TEST(World, KeepsTheVarianceOfFaultsAtThePatchCentreWhereItIsAskedTo) {
  const Deviations found = deviationsOver4000Worlds(true);
  RecordProperty("ratio_permille", static_cast<int>(1000.0 * found.centre / found.latticePoint));
  EXPECT_NEAR(found.latticePoint, 10.0, 0.3);
  EXPECT_NEAR(found.centre / found.latticePoint, 1.0, 0.03);
}

TEST(World, HasHalfTheDeviationAtThePatchCentreWithoutPreservingIt) {
  const Deviations found = deviationsOver4000Worlds(false);
  RecordProperty("ratio_permille", static_cast<int>(1000.0 * found.centre / found.latticePoint));
  EXPECT_NEAR(found.centre / found.latticePoint, 0.5, 0.015);
}

// ---- Law 8: plugins that fail at work ----

TEST(World, GoesOnWithTheMeanOfALayerThatFailsAndSaysSoOnce) {
  LayerDescription broken = noise(64.0, 1.0);
  broken.generator = "hostile";
  broken.parameters = {};
  const LayerDescription sound = noise(512.0, 40.0, 65, "sound");
  const auto world = makeTestWorld(worldOf({broken, sound})), without = makeTestWorld(worldOf({sound}));
  for (int k = 0; k < 50; ++k) {
    const Position at{k, -k, 0.3, 0.6};
    ASSERT_EQ(world->height(at), without->height(at));
  }
  const std::vector<std::string> messages = world->takeMessages();
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_NE(messages[0].find("layer \"hostile\""), std::string::npos) << messages[0];
  EXPECT_TRUE(world->takeMessages().empty());
  EXPECT_TRUE(without->takeMessages().empty());
  EXPECT_FALSE(without->failure().has_value());
  ASSERT_TRUE(world->failure().has_value()) << "taking the messages does not take the failure";
  EXPECT_EQ(messages[0], *world->failure() + "; the layer's mean takes its place there");
}

TEST(World, StandardIsValidAndHasRangesHillsAndDetail) {
  const auto world = makeTestWorld(WorldDescription::standard());
  ASSERT_EQ(world->layers().size(), 3U);
  EXPECT_EQ(world->layers()[0].pitch(), 8192.0);
  EXPECT_EQ(world->layers()[1].pitch(), 512.0);
  EXPECT_EQ(world->layers()[2].pitch(), 64.0);
  EXPECT_TRUE(std::isfinite(world->height({})));
  EXPECT_TRUE(world->takeMessages().empty());
}

}  // namespace
}  // namespace teren
