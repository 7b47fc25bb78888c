// Regions and points at the limits of int64, of double and of the world: refused beyond, right up to the end.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Bake.h"

#include "tests/doors/Refusal.h"
#include "tests/doors/Registry.h"

namespace teren {
namespace {

constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();

/// Layers as fine and as coarse as there may be, and a patch of the most intervals.
std::shared_ptr<const World> widestWorld() {
  WorldDescription description;
  description.samples = 1025;
  description.pitch = 1e6;
  for (const double scale : {1.0, 0x1p40}) {
    LayerDescription layer;
    layer.generator = "fault";
    layer.parameters = {{"faults", std::int64_t{3}}};
    layer.pitch = 1e6 * scale;
    layer.samples = 3;
    description.layers.push_back(layer);
  }
  return World::create(description, registryOfAllModules()).value();
}

TEST(WorldsEnd, RegionsBeyondItAreRefusedWhateverTheirNumbers) {
  const auto world = widestWorld();
  const std::vector<BakeRegion> regions = {
      {kMost, 0, 1, 1, 0},
      {kLeast, 0, 1, 1, 0},
      {0, kMost, 1, 1, 0},
      {0, kLeast, 1, 1, 0},
      {kMaxPatch, 0, 1, 1, 0},
      {-kMaxPatch - 1, 0, 1, 1, 0},
      {kMaxPatch - 1, 0, 2, 1, 0},
      {0, 0, kMost, 1, 0},
      {0, 0, 1, kMost, 0},
      {-kMaxPatch, -kMaxPatch, kMost, kMost, 0},
      {-kMaxPatch, -kMaxPatch, 2 * kMaxPatch, 2 * kMaxPatch, 0},
      {-kMaxPatch, -kMaxPatch, 2 * kMaxPatch, 2 * kMaxPatch, world->topLevel()},
      {0, 0, kLeast, 1, 0},
      {0, 0, 0, 1, 0},
      {0, 0, 1, -1, 0},
      {0, 0, 1, 1, -1},
      {0, 0, 1, 1, world->topLevel() + 1},
      {0, 0, 1, 1, std::numeric_limits<int>::max()},
      {0, 0, 1, 1, std::numeric_limits<int>::min()}};
  for (const BakeRegion& region : regions) {
    const Result<HeightMap> baked = bake(*world, region);
    ASSERT_FALSE(baked.ok()) << region.i << ", " << region.j << ", " << region.columns << ", " << region.rows;
    expectOneSentence(baked.error().message, {});
  }
}

TEST(WorldsEnd, IsTheLastPatchThatCanBeBakedAndAsked) {
  const auto world = widestWorld();
  const double n = world->intervals();
  for (const std::int64_t i : {-kMaxPatch, kMaxPatch - 1}) {
    for (const std::int64_t j : {-kMaxPatch, kMaxPatch - 1}) {
      const Result<HeightMap> baked = bake(*world, {i, j, 1, 1, 0});
      ASSERT_TRUE(baked.ok()) << baked.error().message;
      for (const int sample : {0, 1, 255, 511}) {
        const Position place{i, j, sample / n, (511 - sample) / n};
        ASSERT_EQ((*baked)(sample, 511 - sample), static_cast<float>(world->height(place)));
      }
      const SurfacePoint point = world->query({i, j, 1.0 - 0x1p-53, 1.0 - 0x1p-53});
      EXPECT_TRUE(std::isfinite(point.height) && std::isfinite(point.drawn) && std::isfinite(point.error));
      EXPECT_LE(std::fabs(point.height - point.drawn), point.error);
    }
  }
}

TEST(WorldsEnd, CanBeBakedAtEveryLevel) {
  const auto world = widestWorld();
  for (int level = 0; level <= world->topLevel(); ++level) {
    // The smallest region that fits the level, at the north-eastern end.
    const std::int64_t side = level <= 9 ? 1 : std::int64_t{1} << (level - 9);
    const Result<HeightMap> baked = bake(*world, {kMaxPatch - side, kMaxPatch - side, side, side, level});
    ASSERT_TRUE(baked.ok()) << level << ": " << baked.error().message;
    for (const float height : baked->samples()) ASSERT_TRUE(std::isfinite(height));
  }
}

TEST(WorldsEnd, IsNamedByTheProgram) {
  const auto patches = [](const Arguments& numbers) {
    Arguments all = {"bake", "--generator", "fault", "-o", "never.r32", "--patches"};
    all.insert(all.end(), numbers.begin(), numbers.end());
    return all;
  };
  for (const std::string wide : {"9223372036854775807", "9223372036854775808", "-9223372036854775808",
                                 "-9223372036854775809", "18446744073709551616", "4503599627370497"}) {
    expectRefused(patches({wide, "0", "1", "1"}), 2,
                  {"I of --patches is \"" + wide + "\"", "4503599627370496"});
    expectRefused(patches({"0", wide, "1", "1"}), 2, {"J of --patches is \"" + wide + "\""});
    expectRefused(patches({"0", "0", wide, "1"}), 2, {"COLUMNS of --patches is \"" + wide + "\""});
    expectRefused(patches({"0", "0", "1", wide}), 2, {"ROWS of --patches is \"" + wide + "\""});
  }
  expectRefused(patches({"4503599627370496", "0", "1", "1"}), 2, {"columns", "+-2^52"});
  expectRefused(patches({"0", "4503599627370495", "1", "2"}), 2, {"rows", "+-2^52"});
  for (const std::string& far : {std::string("1e300"), std::string("-1e300"),
                                 std::string("1.7976931348623157e308"), std::string("288230376151711744")}) {
    expectRefused({"query", "--generator", "fault", far, "0"}, 2, {"x = ", "+-2^52"});
    expectRefused({"query", "--generator", "fault", "0", far}, 2, {"y = ", "+-2^52"});
  }
  expectRefused({"query", "--generator", "fault", "0", "1e309"}, 2, {"\"1e309\""});
  expectRefused({"query", "--generator", "fault", "--pitch", "0.001", "1e13", "0"}, 2, {"x = 1e+13 m"});
}

}  // namespace
}  // namespace teren
