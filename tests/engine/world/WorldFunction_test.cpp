// The landscape as a function (law 0): continuous and C1 with smooth blending, the same bits by every route
// and for every thread, as rough between lattice points as at them (law 3).
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"
#include "teren/World.h"

#include "tests/engine/world/RandomDraws.h"
#include "tests/engine/world/TestWorld.h"
#include "tests/engine/world/WorldDescriptions.h"

namespace teren {
namespace {

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
  for (const char* generator : {"fault", "hash-noise"}) {
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
  for (const char* generator : {"fault", "hash-noise"}) {
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

/// Places that leap between far cells of every layer, some the same; of a world with a field among its
/// layers.
struct ManyPlaces {
  ManyPlaces() {
    LayerDescription field;
    field.generator = "value-noise";
    field.pitch = 256.0;
    world = makeTestWorld(worldOf({fault(64.0, 4.0), field, fault(1024.0, 40.0)}));
    RandomSequence random(93);
    for (int k = 0; k < 300; ++k) {
      const std::int64_t far = k % 2 == 0 ? 1000 : -1000;
      places.push_back({far + below(random, 20), far - below(random, 20), uniform(random), uniform(random)});
      if (k % 7 == 0) places.push_back(places[places.size() / 2]);
    }
  }
  std::shared_ptr<const World> world;
  std::vector<Position> places;
};

TEST(World, AnswersManyPlacesAtOnceAsOneByOne) {
  const ManyPlaces many;
  std::vector<double> heights(many.places.size());
  many.world->heights(many.places, heights);
  std::vector<SurfacePoint> points(many.places.size());
  many.world->query(many.places, points);
  for (std::size_t k = 0; k < many.places.size(); ++k) {
    const SurfacePoint expected = many.world->query(many.places[k]);
    ASSERT_EQ(heights[k], many.world->height(many.places[k]));
    ASSERT_EQ(points[k].height, expected.height);
    ASSERT_EQ(points[k].drawn, expected.drawn);
    ASSERT_EQ(points[k].normal, expected.normal);
    ASSERT_EQ(points[k].error, expected.error);
  }
  many.world->heights({}, {});
  many.world->query(std::span<const Position>{}, {});
}

TEST(World, MakesNoMapTwiceForPlacesThatLeapBetweenCellsThatDoNotFitTogether) {
  const auto world = makeTestWorld(worldOf({noise(64.0, 4.0, 2049)}));  // four maps are more than is kept
  std::vector<Position> places;
  for (int k = 0; k < 8; ++k) places.push_back({k % 2 * 100, 0, 0.125 * k, 0.5});
  std::vector<double> heights(places.size());
  const int before = noiseMapsBegun();
  world->heights(places, heights);
  EXPECT_EQ(noiseMapsBegun() - before, 8);
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

}  // namespace
}  // namespace teren
