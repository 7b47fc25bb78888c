// The generators that are plugins and nothing else: constant and slope.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"
#include "teren/PluginRegistry.h"
#include "teren/World.h"

#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

using Entries = std::vector<Values::Entry>;

HeightMap made(const char* id, const Entries& entries, std::uint64_t seed, int samples) {
  const auto generator = PluginRegistry::standard()->makeGenerator(id, entries).value();
  HeightMap map(samples, samples);
  test::finish(*generator->begin({.seed = seed, .samples = samples}, map.view()));
  return map;
}

std::shared_ptr<const World> worldOf(const char* generator, const Entries& entries, BlendKernel blend,
                                     bool preserveVariance) {
  LayerDescription layer;
  layer.generator = generator;
  layer.parameters = entries;
  layer.blend = blend;
  layer.preserveVariance = preserveVariance;
  WorldDescription description;
  description.seed = 5;
  description.layers.push_back(std::move(layer));
  return World::create(description, *PluginRegistry::standard()).value();
}

TEST(Constant, IsItsHeightEverywhereHoweverMapsAreBlended) {
  for (const BlendKernel blend : {BlendKernel::linear, BlendKernel::smooth}) {
    const auto world = worldOf("constant", {{"height", -123.4375}}, blend, true);
    for (double u = 0.0; u < 1.0; u += 0.0625) {
      const Position position{.i = -3, .j = 7, .u = u, .v = 1.0 - 0.0625 - u};
      EXPECT_EQ(world->height(position), -123.4375) << u;
    }
  }
}

TEST(Constant, PromisesTheFloatThatItWrites) {
  const auto generator = PluginRegistry::standard()->makeGenerator("constant", {{{"height", 0.1}}}).value();
  EXPECT_EQ(generator->range().mean, 0.1f);
  EXPECT_EQ(made("constant", {{"height", 0.1}}, 1, 3)(1, 1), 0.1f);
}

TEST(Slope, TiltsEachWayFromItsLatticePointAlikeOften) {
  int east = 0, north = 0, both = 0;
  constexpr int seeds = 4000;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const HeightMap map = made("slope", {{"east", 8.0}, {"north", 2.0}}, mixBits(seed), 5);
    const float toEast = map(4, 2), toNorth = map(2, 4);
    ASSERT_EQ(std::fabs(toEast), 8.0f);
    ASSERT_EQ(std::fabs(toNorth), 2.0f);
    for (int row = 0; row < 5; ++row) {
      for (int column = 0; column < 5; ++column) {
        ASSERT_EQ(map(column, row),
                  toEast * static_cast<float>(column - 2) / 2 + toNorth * static_cast<float>(row - 2) / 2);
      }
    }
    east += toEast > 0.0f;
    north += toNorth > 0.0f;
    both += toEast > 0.0f && toNorth > 0.0f;
  }
  EXPECT_NEAR(east, seeds / 2, 4 * std::sqrt(seeds / 4.0));
  EXPECT_NEAR(north, seeds / 2, 4 * std::sqrt(seeds / 4.0));
  EXPECT_NEAR(both, seeds / 4, 4 * std::sqrt(seeds * 3 / 16.0));
}

TEST(Slope, PromisesTheDeviationOverItsArea) {
  const Entries entries = {{"east", 8.0}, {"north", 2.0}};
  const HeightMap map = made("slope", entries, 1, 129);
  double square = 0.0;  // cell by cell: the middle of each
  for (int row = 0; row < 128; ++row) {
    for (int column = 0; column < 128; ++column) {
      const double height = (map(column, row) + map(column + 1, row + 1)) / 2.0;
      square += height * height / (128.0 * 128.0);
    }
  }
  const auto generator = PluginRegistry::standard()->makeGenerator("slope", entries).value();
  EXPECT_NEAR(std::sqrt(square), generator->range().deviation, 0.001 * generator->range().deviation);
  EXPECT_EQ(generator->range().max, std::max(std::fabs(map(0, 0)), std::fabs(map(128, 0))));
}

TEST(Slope, IsGradientNoiseWhenBlendedSmoothly) {
  const auto world = worldOf("slope", {{"east", 8.0}, {"north", 2.0}}, BlendKernel::smooth, false);
  // The gradient at a lattice point, read off near it.
  const auto gradient = [&](std::int64_t i, std::int64_t j) {
    const double west = world->height({.i = i, .j = j, .u = 0x1p-20});
    const double south = world->height({.i = i, .j = j, .v = 0x1p-20});
    return std::pair(west > 0.0 ? 8.0 : -8.0, south > 0.0 ? 2.0 : -2.0);
  };
  const auto fade = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  std::set<std::pair<double, double>> gradients;
  for (std::int64_t i = -4; i < 4; ++i) {
    for (double u : {0.0, 0.125, 0.3, 0.5, 0.9}) {
      const double v = 0.9 - u;
      double noise = 0.0;
      for (int east : {0, 1}) {
        for (int north : {0, 1}) {
          const auto [x, y] = gradient(i + east, 3 + north);
          gradients.emplace(x, y);
          noise += (east == 1 ? fade(u) : 1 - fade(u)) * (north == 1 ? fade(v) : 1 - fade(v)) *
                   (x * (u - east) + y * (v - north));
        }
      }
      EXPECT_NEAR(world->height({.i = i, .j = 3, .u = u, .v = v}), noise, 1e-5) << i << ", " << u;
    }
  }
  EXPECT_EQ(gradients.size(), 4u);
}

}  // namespace
}  // namespace teren
