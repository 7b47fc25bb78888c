#include "generators/sand/SandSurface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

#include "tests/generators/sand/Heaps.h"

namespace teren {
namespace {

double ripples(double x, double y) {
  const double u = 8.0 * x - std::floor(8.0 * x) - 0.5, v = 5.0 * y - std::floor(5.0 * y) - 0.5;
  return u * u - 0.3 * v;
}

/// Any vertex of the surface.
VertexId anyVertex(const SandSurface& surface, RandomSequence& random) {
  for (;;) {
    const auto v = static_cast<VertexId>(random.next() % surface.mesh().vertexSlots());
    if (surface.mesh().isVertex(v)) return v;
  }
}

void change(SandSurface& surface, RandomSequence& random) {
  const VertexId v = anyVertex(surface, random), w = anyVertex(surface, random);
  switch (random.next() % 8) {
    case 0:
    case 1:
    case 2:
      surface.insert(
          {static_cast<std::int32_t>(random.nextBits(20)), static_cast<std::int32_t>(random.nextBits(20))});
      break;
    case 3:
    case 4:
      surface.remove(v);
      break;
    case 5:
      surface.raise(v, random.nextBits(36) - (std::int64_t{1} << 35));
      break;
    case 6:
      if (surface.mesh().constraintCount() < 12) surface.constrain(v, w, 7);
      break;
    default: {
      VertexId a = kNoVertex, b = kNoVertex;
      surface.mesh().forEachConstraint([&](VertexId one, VertexId other, std::uint32_t) {
        a = one;
        b = other;
      });
      if (a != kNoVertex) surface.unconstrain(a, b);
    }
  }
}

TEST(SandSurface, AccountsForEveryChangeOfItsVolumeExactly) {
  SandSurface surface = scatteredSand(120, 11, 0.1, ripples);
  RandomSequence random(12);
  const SixfoldVolume all = surface.volume();
  for (int n = 0; n < 4'000; ++n) {
    change(surface, random);
    ASSERT_TRUE(surface.volume() + surface.owed() == all) << "after change " << n;
  }
  const Result<void> sound = surface.validate();
  EXPECT_TRUE(sound) << sound.error().message;
}

SixfoldVolume sizeOf(SixfoldVolume owed) {
  return owed < 0 ? -owed : owed;
}

TEST(SandSurface, PaysWhatAnOperationChangedToHalfTheHeaviestWeight) {
  SandSurface surface = scatteredSand(300, 13, 0.1, ripples);
  RandomSequence random(14);
  const SixfoldVolume all = surface.volume();
  SixfoldVolume most = 0;  // half of it is what may be owed
  for (int n = 0; n < 1'000; ++n) {
    const VertexId v = surface.insert(
        {static_cast<std::int32_t>(random.nextBits(20)), static_cast<std::int32_t>(random.nextBits(20))});
    surface.settle({&v, 1});
    most = std::max<SixfoldVolume>(most, surface.weight(v));
    ASSERT_TRUE(2 * sizeOf(surface.owed()) <= most) << n;
    ASSERT_TRUE(surface.due() == 0) << n;
  }
  for (VertexId v = 4; v < surface.mesh().vertexSlots(); v += 2) {
    if (!surface.remove(v)) continue;
    const std::vector<VertexId> ring(surface.lastTouched().begin(), surface.lastTouched().end());
    surface.settle(ring);
    for (const VertexId w : ring) most = std::max<SixfoldVolume>(most, surface.weight(w));
    ASSERT_TRUE(2 * sizeOf(surface.owed()) <= most) << v;
  }
  EXPECT_TRUE(surface.volume() + surface.owed() == all);
}

TEST(SandSurface, PaysAnOldDebtATickAtATime) {
  for (const std::int64_t debt : {-5'000'000, 5'000'000}) {
    SandSurface surface(boxOf(28, 0x1p-28), 0.0, 1.0);
    constexpr std::int32_t kAt = 90'000'000, kSide = 64;
    for (const LatticePoint p : {LatticePoint{0, 0}, {kSide, 0}, {kSide, kSide}, {0, kSide}}) {
      surface.insert({kAt + p.x, kAt + p.y});
    }
    const SixfoldVolume all = surface.volume();
    runUpADebt(surface, debt);
    EXPECT_TRUE(surface.due() == 0);
    const SixfoldVolume owed = sizeOf(surface.owed());
    RandomSequence random(18);
    for (int n = 0; n < 100; ++n) {
      const VertexId v = surface.insert({kAt + 24 + static_cast<std::int32_t>(random.nextBits(4)),
                                         kAt + 24 + static_cast<std::int32_t>(random.nextBits(4))});
      surface.settle({&v, 1});
      ASSERT_LE(std::abs(surface.height(v)), n + 2) << "a tick each at most, and rounding";
      ASSERT_TRUE(sizeOf(surface.owed()) <= owed) << n;
    }
    EXPECT_TRUE(surface.volume() + surface.owed() == all);
  }
}

TEST(SandSurface, LeavesLevelGroundAloneWhateverIsInserted) {
  SandSurface surface(boxOf(20, 0x1p-20), 3.25, 1.0);
  RandomSequence random(15);
  for (int n = 0; n < 300; ++n) {
    const VertexId v = surface.insert(
        {static_cast<std::int32_t>(random.nextBits(20)), static_cast<std::int32_t>(random.nextBits(20))});
    surface.settle({&v, 1});
    ASSERT_EQ(surface.height(v), ticksFromMetres(3.25));
    ASSERT_EQ(surface.loose(v), ticksFromMetres(1.0));
  }
  EXPECT_TRUE(surface.owed() == 0);
}

TEST(SandSurface, KeepsItsAccountWhereHeightsComeToTheirLimits) {
  constexpr std::int64_t kEnd = std::numeric_limits<std::int64_t>::max();
  SandSurface surface(boxOf(28, 0x1p-28), 0.0, 1.0);
  const SixfoldVolume all = surface.volume();
  surface.raise(2, kEnd);
  EXPECT_EQ(surface.height(2), kHighestTick);
  surface.raise(2, 1);
  EXPECT_EQ(surface.height(2), kHighestTick);
  surface.raise(0, -kEnd - 1);
  EXPECT_EQ(surface.height(0), -kHighestTick);
  surface.raise(0, kEnd);
  EXPECT_EQ(surface.height(0), kHighestTick);

  std::vector<VertexId> tiny;  // what raised the corners is due, and more than these can pay
  for (const LatticePoint p : {LatticePoint{0, 0}, {8, 0}, {8, 8}, {0, 8}, {3, 3}, {3, 4}, {4, 4}}) {
    tiny.push_back(surface.insert({90'000'000 + p.x, 150'000'000 + p.y}));
  }
  surface.settle({&tiny[5], 1});
  EXPECT_EQ(surface.height(tiny[5]), -kHighestTick);
  EXPECT_TRUE(surface.due() == 0);
  EXPECT_TRUE(surface.volume() + surface.owed() == all);
  surface.raise(2, -kEnd);
  surface.settle({&tiny[5], 1});
  EXPECT_EQ(surface.height(tiny[5]), kHighestTick);
  EXPECT_TRUE(surface.volume() + surface.owed() == all);
  const Result<void> sound = surface.validate();
  EXPECT_TRUE(sound) << sound.error().message;
}

TEST(SandSurface, LosesLooseMaterialBeforeSolid) {
  SandSurface surface(boxOf(10, 0x1p-10), 1.0, 0.25);
  surface.raise(0, -ticksFromMetres(0.125));
  EXPECT_EQ(surface.solid(0), ticksFromMetres(0.75));
  surface.raise(0, -ticksFromMetres(0.5));
  EXPECT_EQ(surface.loose(0), 0);
  EXPECT_EQ(surface.solid(0), ticksFromMetres(0.375));
  surface.raise(0, ticksFromMetres(0.5));
  EXPECT_EQ(surface.loose(0), ticksFromMetres(0.5));
  EXPECT_EQ(surface.solid(0), ticksFromMetres(0.375));
}

TEST(SandSurface, DividesAConstrainedEdgeIntoConstrainedEdges) {
  SandSurface surface(boxOf(20, 0x1p-20), 0.0, 1.0);
  const VertexId a = surface.insert({100'001, 200'002}), b = surface.insert({700'006, 900'001});
  surface.constrain(a, b, 9);
  const VertexId between = surface.divide(a, b);
  ASSERT_NE(between, kNoVertex);
  EXPECT_TRUE(surface.mesh().point(between) == (LatticePoint{400'003, 550'001}));
  EXPECT_TRUE(surface.middle(a, b) == surface.mesh().point(between));
  EXPECT_EQ(surface.mesh().constraint(a, between), 9U);
  EXPECT_EQ(surface.mesh().constraint(between, b), 9U);
  EXPECT_EQ(surface.mesh().constraintCount(), 2U);
  const VertexId beside = surface.insert({100'002, 200'002});
  EXPECT_EQ(surface.divide(a, beside), kNoVertex) << "there is no room between neighbours on the lattice";
}

TEST(SandSurface, TellsOfEveryTriangleThatADivisionChanged) {
  int flipped = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SandSurface surface = scatteredSand(60, seed, 0.1, ripples);
    RandomSequence random(seed);
    const VertexId a = anyVertex(surface, random), b = anyVertex(surface, random);
    if (a == b) continue;
    surface.constrain(a, b, 3);
    VertexId from = kNoVertex, to = kNoVertex;
    surface.mesh().forEachConstraint([&](VertexId one, VertexId other, std::uint32_t) {
      from = one;
      to = other;
    });
    const SandSurface before = surface;
    if (surface.divide(from, to) == kNoVertex) continue;
    std::vector<bool> told(surface.mesh().triangleSlots(), false);
    for (const TriangleChange& change : surface.lastChanges()) told[change.triangle] = true;
    for (TriangleId t = 0; t < surface.mesh().triangleSlots(); ++t) {
      const bool same = before.mesh().isTriangle(t) && before.mesh().corners(t) == surface.mesh().corners(t);
      ASSERT_TRUE(same || told[t]) << t << ", seed " << seed;
    }
    flipped += surface.lastChanges().size() > 12 ? 1 : 0;
  }
  EXPECT_GT(flipped, 10) << "the constraints held nothing";
}

TEST(SandSurface, PutsCrossingsOnTheSurfaceInSlotsThatEqualPointsLeftFree) {
  constexpr std::int32_t kEnd = 1 << 20;
  const std::vector<LatticePoint> points = {{0, 0},
                                            {kEnd, 0},
                                            {kEnd, kEnd},
                                            {0, kEnd},  // the box has these already
                                            {100'000, 500'000},
                                            {900'000, 510'001},
                                            {500'000, 100'000},
                                            {510'003, 900'000}};
  const std::vector<double> heights = {0.0, 0.1, 0.3, 0.7, 0.1234567, 0.31234567, 0.7, 0.2};
  SandSurface surface(boxOf(20, 0x1p-20), points, heights, 0.25);
  const auto at = [&](std::size_t n) { return surface.mesh().vertexAt(points[n]); };
  surface.constrain(at(4), at(5), 1);
  surface.constrain(at(6), at(7), 2);
  EXPECT_EQ(surface.mesh().vertexCount(), 9U) << "one crossing";
  const Result<void> sound = surface.validate();
  EXPECT_TRUE(sound) << sound.error().message;
}

TEST(SandSurface, SaysWhenItHasNoRoomForMoreVertices) {
  EXPECT_TRUE(SandSurface::hasRoom(1'440'000));
  const Result<void> full = SandSurface::hasRoom(SandSurface::kMostVertices);
  ASSERT_FALSE(full);
  EXPECT_NE(full.error().message.find("264241152"), std::string::npos) << full.error().message;
  EXPECT_LT(2 * SandSurface::kMostVertices, Link::outside().triangle()) << "ids of triangles";
}

TEST(SandSurface, CountsItselfAmongItsBytes) {
  const SandSurface surface(boxOf(20, 0x1p-20), 0.0, 1.0);
  constexpr std::size_t kLeast = 64;  // room in a new array
  EXPECT_GE(surface.bytes() - surface.mesh().bytes(),
            sizeof(SandSurface) - sizeof(Triangulation) + kLeast * sizeof(std::int64_t));
}

TEST(SandSurface, TellsOfWhatBecameLoose) {
  SandSurface surface = scatteredSand(100, 19, 0.1, ripples);
  surface.clearChanges();
  surface.loosen(50, surface.loose(50));
  EXPECT_TRUE(surface.changedVertices().ids().empty()) << "it was so before";
  surface.loosen(50, surface.loose(50) + 1);
  EXPECT_TRUE(surface.changedVertices().contains(50));
  surface.mesh().forEachCorner(50, [&](Link at) {
    EXPECT_TRUE(surface.changedTriangles().contains(at.triangle())) << "it may slide now";
  });
}

TEST(SandSurface, TellsOfSidesThatBecomeAndCeaseToBeConstrainedWhereNoTriangleChanges) {
  SandSurface surface = scatteredSand(100, 20, 0.1, ripples);
  const VertexId from = 50;
  VertexId to = kNoVertex;
  surface.mesh().forEachNeighbour(from, [&](VertexId n) { to = n; });
  const auto expectBothSidesTold = [&](const char* what) {
    int sides = 0;
    surface.mesh().forEachCorner(from, [&](Link at) {
      const std::array<VertexId, 3>& corners = surface.mesh().corners(at.triangle());
      if (std::ranges::find(corners, to) == corners.end()) return;
      EXPECT_TRUE(surface.changedTriangles().contains(at.triangle())) << what;
      ++sides;
    });
    EXPECT_EQ(sides, 2);
  };
  surface.clearChanges();
  surface.constrain(from, to, 1);
  ASSERT_TRUE(surface.lastChanges().empty()) << "the edge is there already";
  expectBothSidesTold("constrained");
  surface.clearChanges();
  ASSERT_TRUE(surface.unconstrain(from, to));
  ASSERT_TRUE(surface.lastChanges().empty()) << "and is a Delaunay edge";
  expectBothSidesTold("free again");
}

TEST(SandSurface, ListsEveryVertexAndTriangleThatChanged) {
  SandSurface surface = scatteredSand(100, 16, 0.1, ripples);
  RandomSequence random(17);
  for (int n = 0; n < 500; ++n) {
    const SandSurface before = surface;
    surface.clearChanges();
    change(surface, random);
    for (VertexId v = 0; v < surface.mesh().vertexSlots(); ++v) {
      const bool was = before.mesh().isVertex(v), is = surface.mesh().isVertex(v);
      const bool same = was == is && (!is || (before.height(v) == surface.height(v) &&
                                              before.mesh().point(v) == surface.mesh().point(v)));
      ASSERT_TRUE(same || surface.changedVertices().contains(v)) << v << " in " << n;
    }
    for (TriangleId t = 0; t < surface.mesh().triangleSlots(); ++t) {
      const bool was = before.mesh().isTriangle(t), is = surface.mesh().isTriangle(t);
      const bool same = was == is && (!is || before.mesh().corners(t) == surface.mesh().corners(t));
      ASSERT_TRUE(same || surface.changedTriangles().contains(t)) << t << " in " << n;
    }
  }
}

}  // namespace
}  // namespace teren
