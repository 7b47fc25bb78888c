#include "generators/sand/CleanUp.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/generators/sand/Heaps.h"

namespace teren {
namespace {

constexpr std::uint32_t kKeepNone = ~std::uint32_t{0};

/// Looks at every vertex until nothing goes any more.
CleanUpCount cleanAll(SandSurface& surface, double tolerance, int passes = 4) {
  CleanUp cleanUp(tolerance);
  Slides slides(reposeOf(), std::numeric_limits<double>::infinity());
  for (int pass = 0; pass < passes; ++pass) {
    for (VertexId v = 0; v < surface.mesh().vertexSlots(); ++v) {
      if (surface.mesh().isVertex(v)) cleanUp.add(v);
    }
    cleanUp.run(surface, slides, kKeepNone, cleanUp.waiting());
  }
  return cleanUp.count();
}

TEST(CleanUp, RemovesEveryVertexOfAPlaneHoweverInclined) {
  SandSurface surface = scatteredSand(2'000, 41, 0.0, [](double x, double y) { return 3.0 * x - 2.0 * y; });
  const SixfoldVolume all = surface.volume();
  const CleanUpCount count = cleanAll(surface, 1e-6);
  EXPECT_LE(surface.mesh().vertexCount(), 8U);
  EXPECT_LE(count.largestError, 1e-6);
  EXPECT_TRUE(surface.volume() + surface.owed() == all);
}

TEST(CleanUp, KeepsVerticesWhereLooseMaterialMaySlide) {
  SandSurface surface = scatteredSand(500, 41, 1.0, [](double x, double y) { return 3.0 * x - 2.0 * y; });
  EXPECT_EQ(cleanAll(surface, 1e-6).removed, 0U) << "steeper than sand lies";
  SandSurface gentle = scatteredSand(500, 41, 1.0, [](double x, double y) { return 0.3 * x - 0.2 * y; });
  EXPECT_GT(cleanAll(gentle, 1e-6).removed, 480U);
}

TEST(CleanUp, MovesNoPlaceByMoreThanItsTolerance) {
  const auto waves = [](double x, double y) {
    const double u = x - 0.5, v = y - 0.4;
    return 0.3 * u * u - 0.2 * v * v + (x > 0.7 ? 0.4 * (x - 0.7) : 0.0);
  };
  for (const double tolerance : {1e-4, 1e-3, 1e-2}) {
    SandSurface surface = scatteredSand(3'000, 42, 1.0, waves);
    const SandSurface before = surface;
    const CleanUpCount count = cleanAll(surface, tolerance);
    double largest = 0.0;
    RandomSequence random(43);
    for (int n = 0; n < 20'000; ++n) {
      const LatticePoint p{static_cast<std::int32_t>(random.nextBits(20)),
                           static_cast<std::int32_t>(random.nextBits(20))};
      largest = std::max(largest, std::fabs(metresFromTicks(surface.heightAt(p, 0) - before.heightAt(p, 0))));
    }
    EXPECT_GT(count.removed, 100U) << tolerance;
    EXPECT_LE(largest, count.largestError);
    EXPECT_LE(count.largestError, tolerance);
    EXPECT_GT(largest, 0.02 * tolerance) << "a bound that far off bounds nothing";
    EXPECT_TRUE(surface.volume() + surface.owed() == before.volume());
    const Result<void> sound = surface.validate();
    EXPECT_TRUE(sound) << sound.error().message;
  }
}

TEST(CleanUp, MovesNoPlaceByMoreThanItSaysWhereConstraintsDissolve) {
  std::uint64_t dissolved = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomSequence random(seed);
    SandSurface surface(boxOf(20, 0x1p-20), 0.0, 1.0);
    std::vector<VertexId> vertices;
    for (int n = 0; n < 60; ++n) {
      vertices.push_back(surface.insert(
          {static_cast<std::int32_t>(random.nextBits(20)), static_cast<std::int32_t>(random.nextBits(20))}));
      if (n % 4 == 0) surface.raise(vertices.back(), random.nextBits(32));  // up to 16 mm
    }
    for (int n = 0; n < 4; ++n) {
      surface.constrain(vertices[random.next() % vertices.size()], vertices[random.next() % vertices.size()],
                        1);
    }
    surface.settle(vertices);
    const SandSurface before = surface;
    const CleanUpCount count = cleanAll(surface, 1e-4, 1);
    dissolved += count.dissolved;
    for (int n = 0; n < 2'000; ++n) {
      const LatticePoint p{static_cast<std::int32_t>(random.nextBits(20)),
                           static_cast<std::int32_t>(random.nextBits(20))};
      ASSERT_LE(std::fabs(metresFromTicks(surface.heightAt(p, 0) - before.heightAt(p, 0))),
                count.largestError + 1e-9)
          << "seed " << seed;
    }
  }
  EXPECT_GT(dissolved, 60U);
}

TEST(CleanUp, KeepsRidgesAndPits) {
  SandSurface surface = scatteredSand(1'000, 44, 1.0, [](double x, double) { return std::fabs(x - 0.5); });
  const VertexId pit = surface.insert({700'000, 300'000});
  surface.raise(pit, ticksFromMetres(-0.01));
  const std::int64_t depth = surface.height(pit);
  cleanAll(surface, 1e-3);
  ASSERT_TRUE(surface.mesh().isVertex(pit));
  EXPECT_NEAR(metresFromTicks(surface.height(pit) - depth), 0.0, 1e-3);
}

TEST(CleanUp, DissolvesConstraintsThatHoldNothing) {
  SandSurface surface = scatteredSand(500, 45, 1.0, [](double, double) { return 2.0; });
  const VertexId a = surface.insert({100'000, 500'000}), b = surface.insert({900'000, 510'000});
  surface.constrain(a, b, 5);
  ASSERT_EQ(surface.mesh().constraintCount(), 1U);
  const CleanUpCount count = cleanAll(surface, 1e-6);
  EXPECT_EQ(count.dissolved, 1U);
  EXPECT_EQ(surface.mesh().constraintCount(), 0U);
}

TEST(CleanUp, KeepsConstraintsThatHoldAnEdge) {
  SandSurface surface(boxOf(20, 0x1p-20), 0.0, 1.0);
  const VertexId south = surface.insert({500'000, 450'000}), north = surface.insert({500'000, 550'000});
  const VertexId west = surface.insert({100'000, 500'000}), east = surface.insert({900'000, 500'000});
  surface.constrain(west, east, 5);
  for (const VertexId v : {west, east}) surface.raise(v, ticksFromMetres(0.1));
  for (const VertexId v : {south, north}) surface.raise(v, ticksFromMetres(-0.1));
  cleanAll(surface, 1e-3);
  EXPECT_TRUE(surface.mesh().constraint(west, east).has_value());
}

}  // namespace
}  // namespace teren
