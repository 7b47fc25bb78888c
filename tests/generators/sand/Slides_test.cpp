#include "generators/sand/Slides.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "generators/numbers/Tangent.h"
#include "tests/generators/sand/Heaps.h"

namespace teren {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr std::uint64_t kNoLimit = ~std::uint64_t{0};
const double kSteepestAllowed = tangentOfDegrees(kDryRepose + kReposeTolerance);

std::vector<std::int64_t> heightsOf(const SandSurface& surface) {
  std::vector<std::int64_t> heights;
  for (VertexId v = 0; v < surface.mesh().vertexSlots(); ++v) {
    heights.push_back(surface.mesh().isVertex(v) ? surface.height(v) : -1);
  }
  return heights;
}

TEST(Slides, BringHeapsToTheAngleOfReposeEverywhereAndKeepTheirVolume) {
  for (const int count : {1'000, 4'000}) {
    SandSurface surface = scatteredSand(count, 21, 10.0, cone);
    const SixfoldVolume all = surface.volume();
    ASSERT_GT(steepestLooseSlope(surface), 1.1);
    Slides slides(reposeOf(), kNever);
    slides.addAll(surface);
    ASSERT_TRUE(slides.advance(surface, 100'000'000));
    EXPECT_LE(steepestLooseSlope(surface), kSteepestAllowed);
    EXPECT_TRUE(surface.volume() + surface.owed() == all);
    RecordProperty("sweeps_" + std::to_string(count), static_cast<int>(slides.count().sweeps));
    EXPECT_LT(slides.count().sweeps, 5'000U);
  }
}

TEST(Slides, ComputeTheSameHoweverTheyAreSliced) {
  SandSurface whole = scatteredSand(500, 22, 10.0, cone);
  SandSurface sliced = whole;
  Slides once(reposeOf(), 0.1), often(reposeOf(), 0.1);
  once.addAll(whole);
  often.addAll(sliced);
  ASSERT_TRUE(once.advance(whole, kNoLimit));
  for (std::uint64_t n = 0; !often.advance(sliced, 1 + n % 13); ++n) {
  }
  EXPECT_EQ(heightsOf(whole), heightsOf(sliced));
  EXPECT_EQ(once.count().moves, often.count().moves);
  EXPECT_EQ(once.count().sweeps, often.count().sweeps);
}

TEST(Slides, NeverCutSolidGround) {
  SandSurface surface = scatteredSand(1'000, 23, 0.02, cone);
  std::vector<std::int64_t> solid;
  for (VertexId v = 0; v < surface.mesh().vertexSlots(); ++v) solid.push_back(surface.solid(v));
  const SixfoldVolume all = surface.volume();
  Slides slides(reposeOf(), kNever);
  slides.addAll(surface);
  ASSERT_TRUE(slides.advance(surface, 100'000'000));
  int bare = 0;
  for (VertexId v = 0; v < surface.mesh().vertexSlots(); ++v) {
    if (!surface.mesh().isVertex(v)) continue;
    ASSERT_EQ(surface.solid(v), solid[v]) << v;
    ASSERT_GE(surface.loose(v), 0) << v;
    bare += surface.loose(v) <= kBareTicks ? 1 : 0;
  }
  EXPECT_GT(bare, 20) << "nothing slid off";
  EXPECT_LE(steepestLooseSlope(surface), kSteepestAllowed);
  EXPECT_TRUE(surface.volume() + surface.owed() == all);
}

TEST(Slides, LeaveSolidGroundHoweverSteep) {
  SandSurface surface = scatteredSand(500, 24, 0.0, cone);
  const std::vector<std::int64_t> before = heightsOf(surface);
  Slides slides(reposeOf(), 0.01);
  slides.addAll(surface);
  ASSERT_TRUE(slides.advance(surface, kNoLimit));
  EXPECT_EQ(heightsOf(surface), before);
  EXPECT_EQ(slides.count().moves, 0U);
}

TEST(Slides, DivideLongEdgesWhereSandSlidesAndNowhereElse) {
  SandSurface surface(boxOf(20, 0x1p-20), 0.0, 10.0);
  for (const LatticePoint p :
       {LatticePoint{9 << 15, 1 << 18}, {7 << 15, 1 << 18}, {1 << 18, 9 << 15}, {1 << 18, 7 << 15}}) {
    surface.raise(surface.insert(p), ticksFromMetres(0.03));
  }
  surface.raise(surface.insert({1 << 18, 1 << 18}), ticksFromMetres(0.08));
  const SixfoldVolume all = surface.volume() + surface.owed();
  Slides slides(reposeOf(), 0.03);
  slides.addAll(surface);
  ASSERT_TRUE(slides.advance(surface, 100'000'000));
  EXPECT_GT(slides.count().splits, 50U);
  EXPECT_LE(steepestLooseSlope(surface), kSteepestAllowed);
  EXPECT_TRUE(surface.volume() + surface.owed() == all);
  EXPECT_EQ(surface.height(2), 0) << "the far corner of the box moved";
  const Result<void> sound = surface.validate();
  EXPECT_TRUE(sound) << sound.error().message;
}

/// The least height of a triangle over its longest side [steps].
double narrowestFace(const SandSurface& surface) {
  double least = kNever;
  for (TriangleId t = 0; t < surface.mesh().triangleSlots(); ++t) {
    if (!surface.mesh().isTriangle(t)) continue;
    const Face face = surface.unweighedFace(t);
    double longest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const LatticePoint a = face[i].place, b = face[(i + 1) % 3].place;
      const double x = b.x - a.x, y = b.y - a.y;
      longest = std::max(longest, std::sqrt(x * x + y * y));
    }
    const auto area = orientation(face[0].place, face[1].place, face[2].place);
    least = std::min(least, static_cast<double>(area) / longest);
  }
  return least;
}

TEST(Slides, DivideWithoutSliversBesideWhatStays) {
  SandSurface surface(boxOf(20, 0x1p-20), 0.0, 10.0);
  surface.raise(surface.insert({1 << 18, 1 << 12}), ticksFromMetres(0.3));
  Slides slides(reposeOf(), 0.05);
  slides.addAll(surface);
  ASSERT_TRUE(slides.advance(surface, 1'000'000));
  EXPECT_GT(slides.count().splits, 50U);
  EXPECT_GT(narrowestFace(surface), 512.0) << "an eighth of what there was";
  EXPECT_LE(steepestLooseSlope(surface), kSteepestAllowed);
}

}  // namespace
}  // namespace teren
