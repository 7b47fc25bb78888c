#include "generators/sand/Stamper.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

#include <gtest/gtest.h>

#include "teren/ProcessorTime.h"

#include "tests/generators/sand/Heaps.h"

namespace teren {
namespace {

double hills(double x, double y) {
  return 0.1 * (x - 0.3) * (x - 0.3) - 0.15 * y * y;
}
double level(double, double) {
  return 0.0;
}

const ToolShape kRound = *ToolShape::disc(0.04, 0.1);

SixfoldVolume sizeOfOwed(const SandSurface& surface) {
  return surface.owed() < 0 ? -surface.owed() : surface.owed();
}

TEST(Stamper, KeepsTheVolumeOfEveryStampExactly) {
  SandSurface surface = scatteredSand(2'000, 31, 5.0, hills);
  const SixfoldVolume all = surface.volume();
  Stamper stamper({});
  RandomSequence random(32);
  const std::vector<ToolPoint> hook{{-0.04, -0.04}, {0.04, -0.04}, {0.04, 0.04},  {-0.04, 0.04},
                                    {-0.04, 0.02},  {0.02, 0.02},  {0.02, -0.02}, {-0.04, -0.02}};
  const ToolShape tools[] = {kRound,
                             *ToolShape::square(0.06, 0.05),
                             *ToolShape::rake(0.1, 0.05, 3),
                             *ToolShape::wedge(0.06, 0.08),
                             *ToolShape::ball(0.06, 0.04),
                             *ToolShape::polygon(hook, 0.05)};
  for (int n = 0; n < 120; ++n) {
    StampPlace place{0.2 + 0.6 * uniform(random.next()), 0.2 + 0.6 * uniform(random.next()), 0.0, 0.0, 0.0};
    if (n % 3 != 0) {
      place.directionX = n % 3 == 1 ? 0.6 : -0.28;
      place.directionY = n % 3 == 1 ? -0.8 : 0.96;
    }
    const Result<StampReport> report = stamper.stamp(surface, tools[n % 6], place);
    ASSERT_TRUE(report) << report.error().message;
    ASSERT_TRUE(surface.volume() + surface.owed() == all) << n;
    std::int64_t most = 0;
    for (VertexId v = 0; v < surface.mesh().vertexSlots(); ++v) {
      if (surface.mesh().isVertex(v)) most = std::max(most, surface.weight(v));
    }
    ASSERT_TRUE(2 * sizeOfOwed(surface) <= most) << n;
    const Result<void> sound = surface.validate();
    ASSERT_TRUE(sound) << n << ": " << sound.error().message;
  }
}

TEST(Stamper, PressesItsFormIntoLevelGround) {
  SandSurface surface = scatteredSand(3'000, 33, 5.0, level);
  Stamper stamper({});
  const Result<StampReport> report = stamper.stamp(surface, kRound, {0.5, 0.5, 0.0});
  ASSERT_TRUE(report);
  EXPECT_GT(report->removed, 5);
  const double disc = 12 * 0.5 * 0.04 * 0.04 * 0.5;  // twelve triangles of 30 degrees
  EXPECT_GT(report->displaced, 0.9 * disc * 0.1);
  EXPECT_LT(report->displaced, disc * 0.1);
  for (const double r : {0.0, 0.01, 0.02, 0.03, 0.036}) {
    const auto p = surface.mesh().frame().snap(0.5 + 0.8 * r, 0.5 - 0.6 * r);
    EXPECT_NEAR(metresFromTicks(surface.heightAt(*p, 0)), -0.1, 1e-9) << r;
  }
  for (VertexId v = 0; v < surface.mesh().vertexSlots(); ++v) {
    if (!surface.mesh().isVertex(v)) continue;
    const double x = surface.mesh().frame().placeX(surface.mesh().point(v)) - 0.5;
    const double y = surface.mesh().frame().placeY(surface.mesh().point(v)) - 0.5;
    const double distance = std::sqrt(x * x + y * y);
    if (distance > 0.12) {
      ASSERT_EQ(surface.height(v), 0) << "far ground moved";
    } else if (distance > 0.0399) {
      ASSERT_GE(surface.height(v), 0) << "a berm rises";
    }
  }
}

TEST(Stamper, HeapsUpAheadMoreThanBesideAndNothingBehind) {
  SandSurface surface = scatteredSand(5'000, 34, 5.0, level);
  Stamper stamper({});
  ASSERT_TRUE(stamper.stamp(surface, kRound, {0.5, 0.5, 0.0, 1.0, 0.0}));
  double ahead = 0.0, beside = 0.0, behind = 0.0;
  for (VertexId v = 0; v < surface.mesh().vertexSlots(); ++v) {
    if (!surface.mesh().isVertex(v) || surface.height(v) <= 0) continue;
    const double x = surface.mesh().frame().placeX(surface.mesh().point(v)) - 0.5;
    const double y = std::fabs(surface.mesh().frame().placeY(surface.mesh().point(v)) - 0.5);
    double& sum = x > y ? ahead : x < -y ? behind : beside;
    sum += metresFromTicks(surface.height(v)) * static_cast<double>(surface.weight(v));
  }
  EXPECT_GT(ahead, beside);
  EXPECT_GT(beside, 0.0);
  EXPECT_EQ(behind, 0.0);
}

TEST(Stamper, HeapsUpWhatItDisplacedAndNoOldDebt) {
  SandSurface clean = scatteredSand(3'000, 42, 5.0, hills);
  SandSurface indebted = clean;
  runUpADebt(indebted, ticksFromMetres(100.0));
  Stamper one({}), other({});
  for (const double x : {0.4, 0.47, 0.6}) {
    ASSERT_TRUE(one.stamp(clean, kRound, {x, 0.5, 0.0}));
    ASSERT_TRUE(other.stamp(indebted, kRound, {x, 0.5, 0.0}));
  }
  for (VertexId v = 4; v < clean.mesh().vertexSlots(); ++v) {
    ASSERT_EQ(clean.mesh().isVertex(v), indebted.mesh().isVertex(v)) << v;
    if (!clean.mesh().isVertex(v)) continue;
    ASSERT_LE(std::abs(clean.height(v) - indebted.height(v)), 5) << v;
  }
}

TEST(Stamper, DigsAndNeverFills) {
  SandSurface surface = scatteredSand(1'000, 35, 5.0, [](double x, double) { return x < 0.5 ? -1.0 : 0.0; });
  Stamper stamper({});
  const Result<StampReport> report = stamper.stamp(surface, kRound, {0.25, 0.5, 0.0});
  ASSERT_TRUE(report);
  EXPECT_NEAR(report->displaced, 0.0, 1e-12);
  EXPECT_NEAR(metresFromTicks(surface.heightAt(*surface.mesh().frame().snap(0.25, 0.5), 0)), -1.0, 1e-12);
}

TEST(Stamper, KeepsWhatIsDeeperThanTheTool) {
  SandSurface surface = scatteredSand(300, 36, 5.0, level);
  const VertexId pit = surface.insert(*surface.mesh().frame().snap(0.51, 0.5));
  surface.raise(pit, ticksFromMetres(-0.3));
  const LatticePoint at = surface.mesh().point(pit);
  Stamper stamper({});
  ASSERT_TRUE(stamper.stamp(surface, kRound, {0.5, 0.5, 0.0}));
  ASSERT_TRUE(surface.mesh().isVertex(pit));
  EXPECT_EQ(surface.mesh().point(pit), at);
  EXPECT_EQ(surface.height(pit), ticksFromMetres(-0.3));
}

TEST(Stamper, LoosensWhatItCutsAndNothingElse) {
  SandSurface surface = scatteredSand(2'000, 37, 0.0, level);
  Stamper stamper({});
  ASSERT_TRUE(stamper.stamp(surface, kRound, {0.5, 0.5, 0.0}));
  const auto bottom = surface.mesh().locate(*surface.mesh().frame().snap(0.5, 0.5));
  for (const VertexId v : surface.mesh().corners(bottom.triangle)) {
    EXPECT_EQ(surface.loose(v), ticksFromMetres(StampSettings{}.loosening));
    EXPECT_LT(surface.solid(v), ticksFromMetres(-0.1));
  }
  EXPECT_EQ(surface.loose(0), 0);
}

TEST(Stamper, DissolvesTheConstraintsOfOlderStampsUnderIt) {
  SandSurface surface = scatteredSand(500, 38, 5.0, level);
  Stamper stamper({});
  ASSERT_TRUE(stamper.stamp(surface, *ToolShape::disc(0.02, 0.05), {0.5, 0.5, 0.0}));
  const std::size_t small = surface.mesh().constraintCount();
  ASSERT_TRUE(stamper.stamp(surface, kRound, {0.5, 0.5, 0.0}));
  EXPECT_EQ(surface.mesh().constraintCount(), small) << "the outlines of the second alone";
}

TEST(Stamper, SaysWhatEachPartOfAStampCost) {
  SandSurface surface = scatteredSand(5'000, 41, 5.0, hills);
  Stamper stamper({});
  StampTimes sum;
  const std::chrono::nanoseconds begin = threadProcessorTime();
  for (int n = 0; n < 200; ++n) {
    const Result<StampReport> report = stamper.stamp(surface, kRound, {0.2 + 0.003 * n, 0.5, 0.0});
    ASSERT_TRUE(report);
    for (const double part :
         {report->times.insertion, report->times.constraints, report->times.removal, report->times.berm}) {
      ASSERT_GE(part, 0.0) << n;
    }
    sum.insertion += report->times.insertion;
    sum.constraints += report->times.constraints;
    sum.removal += report->times.removal;
    sum.berm += report->times.berm;
  }
  const double all = std::chrono::duration<double>(threadProcessorTime() - begin).count();
  for (const double part : {sum.insertion, sum.constraints, sum.removal, sum.berm}) EXPECT_GT(part, 0.0);
  const double parts = sum.insertion + sum.constraints + sum.removal + sum.berm;
  EXPECT_LE(parts, all);
  EXPECT_GT(parts, 0.5 * all) << "nearly all that a stamp does belongs to a part";
}

TEST(Stamper, DividesItsOutlineWhereTheGroundBends) {
  SandSurface flat = scatteredSand(3'000, 39, 5.0, level);
  SandSurface rough =
      scatteredSand(3'000, 39, 5.0, [](double x, double y) { return (x < 0.5) == (y < 0.5) ? 0.05 : 0.0; });
  Stamper one({}), other({});
  const ToolShape large = *ToolShape::square(0.3, 0.1);
  EXPECT_EQ(one.stamp(flat, large, {0.5, 0.5, 0.0})->contour, 8);
  EXPECT_GT(other.stamp(rough, large, {0.5, 0.5, 0.0})->contour, 20);
}

double heightAt(const SandSurface& surface, double x, double y) {
  return *surface.mesh().heightAt(x, y);
}

TEST(Stamper, CutsToolsOffAtTheBorder) {
  SandSurface surface = scatteredSand(3'000, 43, 5.0, level);
  const SixfoldVolume all = surface.volume();
  Stamper stamper({});
  const Result<StampReport> side = stamper.stamp(surface, kRound, {0.01, 0.5, 0.0});
  ASSERT_TRUE(side) << side.error().message;
  EXPECT_NEAR(heightAt(surface, 0.0, 0.5), -0.1, 1e-9) << "the groove ends at the border";
  EXPECT_NEAR(heightAt(surface, 0.02, 0.48), -0.1, 1e-9);
  EXPECT_GE(heightAt(surface, 0.0, 0.55), 0.0);
  const double disc = 12 * 0.5 * 0.04 * 0.04 * 0.5;
  EXPECT_GT(side->displaced, 0.5 * disc * 0.1);
  EXPECT_LT(side->displaced, 0.75 * disc * 0.1);
  ASSERT_TRUE(stamper.stamp(surface, kRound, {1.0, 1.0, 0.0, 0.6, 0.8}));
  EXPECT_NEAR(heightAt(surface, 1.0, 1.0), -0.1, 1e-9) << "a corner of the box is dug up, too";
  EXPECT_TRUE(stamper.stamp(surface, *ToolShape::rake(0.2, 0.05, 3), {0.5, 0.98, 0.0, 1.0, 0.0}));
  EXPECT_TRUE(surface.volume() + surface.owed() == all);
  EXPECT_TRUE(surface.due() == 0);
  const Result<void> sound = surface.validate();
  EXPECT_TRUE(sound) << sound.error().message;
}

TEST(Stamper, PutsOutlinesThatRunNextToTheBorderOnIt) {
  const ToolShape square = *ToolShape::square(0.08, 0.05);
  const double wall = square.parts().front().wall;
  for (int n = 0; n < 60; ++n) {
    SandSurface surface = scatteredSand(500, 44, 5.0, level);
    const SixfoldVolume all = surface.volume();
    Stamper stamper({});
    const Result<StampReport> report = stamper.stamp(surface, square, {0.031 + n * 0.0002, 0.5, 0.0});
    ASSERT_TRUE(report) << report.error().message;
    for (const std::span<const VertexId> outline : {stamper.rim(), stamper.inside()}) {
      for (const VertexId v : outline) {
        const double beside = surface.mesh().frame().placeX(surface.mesh().point(v));
        ASSERT_TRUE(beside == 0.0 || beside > 0.49 * wall) << beside << " in " << n;
      }
    }
    ASSERT_TRUE(surface.volume() + surface.owed() == all) << n;
    const Result<void> sound = surface.validate();
    ASSERT_TRUE(sound) << n << ": " << sound.error().message;
  }
}

TEST(Stamper, HeapsUpInsideWhatIsPushedBeyondTheBorder) {
  for (const double x : {1.01, 1.02, 1.03}) {
    SandSurface surface = scatteredSand(3'000, 45, 5.0, level);
    const SixfoldVolume all = surface.volume();
    Stamper stamper({});
    ASSERT_TRUE(stamper.stamp(surface, kRound, {x, 0.5, 0.0, 1.0, 0.0})) << x;
    EXPECT_TRUE(surface.volume() + surface.owed() == all) << x;
    EXPECT_TRUE(surface.due() == 0) << x;
    double highest = 0.0;
    for (VertexId v = 0; v < surface.mesh().vertexSlots(); ++v) {
      if (surface.mesh().isVertex(v)) highest = std::max(highest, surface.mesh().height(v));
    }
    EXPECT_GT(highest, 0.0) << x;
    EXPECT_LT(highest, 0.7 * kRound.depth()) << "a spike instead of a berm at " << x;
  }
}

TEST(Stamper, MeasuresWallsStraightAcross) {
  SandSurface surface = scatteredSand(100, 46, 5.0, level);
  Stamper stamper({});
  const double step = surface.step();
  const auto triangle = [&](double wall) {  // its corners are twice as far apart as its walls are thick
    return *ToolShape::disc(wall / (0.025 * std::sqrt(3.0)), 1e-5, 3);
  };
  EXPECT_NEAR(triangle(1.0).parts().front().wall, 1.0, 1e-9);
  EXPECT_FALSE(stamper.stamp(surface, triangle(7.0 * step), {0.5, 0.5, 0.0}));
  EXPECT_EQ(surface.mesh().vertexCount(), 100U);
  EXPECT_TRUE(stamper.stamp(surface, triangle(9.0 * step), {0.5, 0.5, 0.0}));
}

TEST(Stamper, RefusesImpossiblePlacesAndChangesNothing) {
  SandSurface surface = scatteredSand(100, 40, 5.0, level);
  Stamper stamper({});
  const double nan = std::nan("");
  for (const StampPlace& place : {StampPlace{-0.1, 0.5, 0.0},
                                  {0.5, 2.0, 0.0},
                                  {nan, 0.5, 0.0},
                                  {0.5, 0.5, nan},
                                  {0.5, 0.5, 0.0, 1.0, 1.0},
                                  {1e300, -1e308, 0.0}}) {
    EXPECT_FALSE(stamper.stamp(surface, kRound, place));
  }
  EXPECT_FALSE(stamper.stamp(surface, *ToolShape::disc(2e-6, 1.0), {0.5, 0.5, 0.0}))
      << "smaller than the lattice";
  EXPECT_FALSE(stamper.stamp(surface, *ToolShape::square(3.0, 0.1), {0.5, 0.5, 0.0})) << "covers all";
  EXPECT_FALSE(stamper.stamp(surface, *ToolShape::square(1.05, 0.1), {0.5, 0.5, 0.0}))
      << "covers all but for its walls";
  EXPECT_EQ(surface.mesh().vertexCount(), 100U);
  EXPECT_TRUE(surface.changedVertices().ids().empty());
}

TEST(Stamper, SpacesStampsByTheSpeedOfTheDrag) {
  EXPECT_EQ(stampSpacing(0.0, kRound), kRound.reach() / 8);
  EXPECT_NEAR(stampSpacing(0.6, kRound), 0.01, 1e-15);
  EXPECT_EQ(stampSpacing(100.0, kRound), kRound.reach() / 2);
  const std::vector<StampPlace> places = stampsAlong({0.0, 0.0, 1.0}, {0.3, 0.4, 2.0}, 0.11);
  ASSERT_EQ(places.size(), 5U);
  EXPECT_EQ(places.back().x, 0.3);
  EXPECT_EQ(places.back().height, 2.0);
  EXPECT_NEAR(places.front().y, 0.08, 1e-15);
  EXPECT_NEAR(places[2].directionX, 0.6, 1e-15);
  EXPECT_TRUE(stampsAlong({}, {}, 0.1).empty());
}

}  // namespace
}  // namespace teren
