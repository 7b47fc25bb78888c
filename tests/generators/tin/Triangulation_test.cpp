#include "generators/tin/Triangulation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

constexpr LatticeFrame kSmall{.x = 0.0, .y = 0.0, .step = 1.0, .width = 100, .height = 60};

/// The whole mesh is what it promises to be.
::testing::AssertionResult valid(const Triangulation& mesh) {
  const Result<void> proof = mesh.validate();
  return proof.ok() ? ::testing::AssertionSuccess() : ::testing::AssertionFailure() << proof.error().message;
}

std::vector<VertexId> neighbours(const Triangulation& mesh, VertexId v) {
  std::vector<VertexId> result;
  mesh.forEachNeighbour(v, [&](VertexId w) { result.push_back(w); });
  return result;
}

TEST(Triangulation, BeginsWithTheBox) {
  for (const LatticeFrame& frame : {kSmall, LatticeFrame{.width = 1, .height = 1}, LatticeFrame{}}) {
    const Triangulation mesh(frame, 3.5);
    EXPECT_TRUE(valid(mesh));
    EXPECT_EQ(mesh.vertexCount(), 4U);
    EXPECT_EQ(mesh.triangleCount(), 2U);
    EXPECT_EQ(mesh.heightAt({frame.width / 2, 0}), 3.5);
  }
}

TEST(Triangulation, PointsThatSnapTogetherAreOneVertexThatKeepsItsHeight) {
  Triangulation mesh(kSmall);
  const Result<Insertion> first = mesh.insert(10.4, 20.0, 5.0);
  const Result<Insertion> second = mesh.insert(9.6, 20.3, 7.0);
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_TRUE(first->isNew);
  EXPECT_FALSE(second->isNew);
  EXPECT_EQ(first->vertex, second->vertex);
  EXPECT_EQ(mesh.height(first->vertex), 5.0);
  EXPECT_EQ(mesh.vertexCount(), 5U);
}

TEST(Triangulation, RefusesPlacesOutsideAndNumbersThatAreNone) {
  Triangulation mesh(kSmall);
  EXPECT_FALSE(mesh.insert(100.1, 20.0, 0.0).ok());
  EXPECT_FALSE(mesh.insert(10.0, -0.1, 0.0).ok());
  EXPECT_FALSE(mesh.insert(NAN, 20.0, 0.0).ok());
  EXPECT_FALSE(mesh.insert(10.0, INFINITY, 0.0).ok());
  EXPECT_FALSE(mesh.insert(10.0, 20.0, NAN).ok());
  EXPECT_EQ(mesh.insert(10.0, 60.5, 0.0).error().message,
            "the place (10.000000, 60.500000) lies outside the mesh");
  EXPECT_EQ(mesh.vertexCount(), 4U);
}

TEST(Triangulation, AFullGridOfCocircularPointsIsTriangulated) {
  Triangulation mesh(LatticeFrame{.width = 20, .height = 20});
  for (std::int32_t n = 0; n < 21 * 21; ++n) {
    const std::int32_t shuffled = n * 100 % 441;
    mesh.insert({shuffled % 21, shuffled / 21}, 0.0);
    ASSERT_TRUE(valid(mesh));
  }
  EXPECT_EQ(mesh.vertexCount(), 441U);
  EXPECT_EQ(mesh.triangleCount(), 800U);
}

TEST(Triangulation, ManyPointsAtOnceMakeTheMeshThatOneByOneMakes) {
  RandomSequence random(5);
  Triangulation many(LatticeFrame{}), single(LatticeFrame{});
  std::vector<LatticePoint> points;
  for (int n = 0; n < 3000; ++n) {
    points.push_back(
        {static_cast<std::int32_t>(random.nextBits(28)), static_cast<std::int32_t>(random.nextBits(28))});
  }
  points[1000] = points[10];
  for (const int n : {7, 300, 301, 302, 1500, 2999}) points[n] = points[2];
  std::vector<double> heights;
  for (std::size_t i = 0; i < points.size(); ++i) heights.push_back(static_cast<double>(i));
  const std::vector<VertexId> ids = many.insert(points, heights);
  for (std::size_t i = 0; i < points.size(); ++i) single.insert(points[i], heights[i]);
  ASSERT_TRUE(valid(many));
  ASSERT_EQ(many.vertexCount(), single.vertexCount());
  EXPECT_EQ(ids[1000], ids[10]);
  EXPECT_EQ(many.height(ids[1000]), 10.0);
  EXPECT_EQ(ids[301], ids[2]);
  EXPECT_EQ(many.height(ids[2]), 2.0);
  // No four of these points lie on a circle, so there is one Delaunay triangulation.
  for (TriangleId t = 0; t < many.triangleSlots(); ++t) {
    const std::array<VertexId, 3>& corners = many.corners(t);
    const VertexId a = single.vertexAt(many.point(corners[0])), b = single.vertexAt(many.point(corners[1]));
    ASSERT_TRUE(single.isEdge(a, b));
    ASSERT_EQ(single.height(a), many.height(corners[0]));
  }
}

TEST(Triangulation, NeighboursComeCounterClockwiseAndOnTheBorderFromBorderToBorder) {
  Triangulation mesh(LatticeFrame{.width = 4, .height = 4});
  const VertexId centre = mesh.insert({2, 2}, 0.0).vertex;
  const VertexId south = mesh.insert({2, 0}, 0.0).vertex;
  const std::vector<VertexId> around = neighbours(mesh, centre);
  ASSERT_EQ(around.size(), 5U);
  for (std::size_t i = 0; i < around.size(); ++i) {
    EXPECT_GT(orientation({2, 2}, mesh.point(around[i]), mesh.point(around[(i + 1) % 5])), 0);
  }
  EXPECT_EQ(neighbours(mesh, south), (std::vector<VertexId>{1, centre, 0}));
  EXPECT_EQ(neighbours(mesh, 1), (std::vector<VertexId>{2, centre, south}));
}

TEST(Triangulation, FindsTheSameWhereverItExpectsItsVertices) {
  const LatticeFrame frame{.width = 1 << 20, .height = 1 << 20};
  Triangulation plain(frame), expecting(frame);
  expecting.expectWithin({1000, 300000}, 5000, 7000);
  RandomSequence random(3);
  const auto place = [&] {
    return LatticePoint{static_cast<std::int32_t>(500 + random.nextBits(13)),
                        static_cast<std::int32_t>(299000 + random.nextBits(13))};
  };
  for (int n = 0; n < 500; ++n) {
    const LatticePoint p = place();
    EXPECT_EQ(plain.insert(p, n).vertex, expecting.insert(p, n).vertex);
  }
  for (int n = 0; n < 500; ++n) {
    const LatticePoint p = n % 2 == 0 ? place() : LatticePoint{n * 2000, n * 1000};
    EXPECT_EQ(plain.heightAt(p), expecting.heightAt(p));
  }
  expecting.moveTo(-50.0, 7.0);
  EXPECT_EQ(expecting.frame().snap(-50.0, 7.0), (LatticePoint{0, 0}));
  EXPECT_TRUE(expecting.validate().ok());
}

TEST(Triangulation, HeightsAreExactAtVerticesAndTheSameFromBothSidesOfAnEdge) {
  RandomSequence random(6);
  Triangulation mesh(LatticeFrame{.width = 4096, .height = 4096});
  std::vector<VertexId> ids;
  for (int n = 0; n < 200; ++n) {
    const LatticePoint p{static_cast<std::int32_t>(random.nextBits(8)) * 16,
                         static_cast<std::int32_t>(random.nextBits(8)) * 16};
    ids.push_back(mesh.insert(p, static_cast<double>(random.nextBits(20)) / 7.0).vertex);
  }
  int onEdges = 0;
  for (const VertexId v : ids) {
    EXPECT_EQ(mesh.heightAt(mesh.point(v)), mesh.height(v));
    mesh.forEachNeighbour(v, [&](VertexId w) {
      const LatticePoint a = mesh.point(v), b = mesh.point(w);
      const LatticePoint middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
      if (orientation(a, b, middle) != 0) return;
      ++onEdges;
      // From either side, found through either hint: the same bits, and half way between the ends.
      const double height = mesh.heightAt(middle, mesh.triangleAt(v));
      EXPECT_EQ(height, mesh.heightAt(middle, mesh.triangleAt(w)));
      EXPECT_NEAR(height, (mesh.height(v) + mesh.height(w)) / 2, 1e-9);
    });
  }
  EXPECT_GT(onEdges, 500);
}

TEST(Triangulation, APlaneIsInterpolatedAsAPlane) {
  RandomSequence random(7);
  Triangulation mesh(LatticeFrame{.width = 1 << 20, .height = 1 << 20});
  const auto plane = [](LatticePoint p) { return 3.0 + 1e-3 * p.x - 2e-3 * p.y; };
  for (VertexId v = 0; v < 4; ++v) mesh.setHeight(v, plane(mesh.point(v)));
  const auto anywhere = [&random] {
    return LatticePoint{static_cast<std::int32_t>(random.nextBits(20)),
                        static_cast<std::int32_t>(random.nextBits(20))};
  };
  for (int n = 0; n < 500; ++n) {
    const LatticePoint p = anywhere();
    mesh.insert(p, plane(p));
  }
  for (int n = 0; n < 5000; ++n) {
    const LatticePoint p = anywhere();
    EXPECT_NEAR(mesh.heightAt(p), plane(p), 8 * 2100.0 * 0x1p-52);
  }
}

TEST(Triangulation, HeightsBetweenLatticePointsLieOnTheTrianglesAndJoinAtEdges) {
  RandomSequence random(17);
  const LatticeFrame frame{.x = -8.0, .y = 4.0, .step = 0.25, .width = 64, .height = 64};
  Triangulation mesh(frame);
  for (int n = 0; n < 300; ++n) {
    mesh.insert(
        {static_cast<std::int32_t>(random.next() % 65), static_cast<std::int32_t>(random.next() % 65)},
        static_cast<double>(random.nextBits(20)) / 7.0);
  }
  for (TriangleId t = 0; t < mesh.triangleSlots(); ++t) {
    const auto& [a, b, c] = mesh.corners(t);
    const LatticePoint p = mesh.point(a), q = mesh.point(b), r = mesh.point(c);
    EXPECT_EQ(mesh.heightAt(frame.placeX(p), frame.placeY(p), t), mesh.height(a));
    // Weights of eighths, so that places are exact; a quarter from each of two corners lies on their edge.
    const auto at = [&](int u, int v, TriangleId hint) {
      const int w = 8 - u - v;
      return mesh.heightAt(frame.x + (u * p.x + v * q.x + w * r.x) / 8.0 * frame.step,
                           frame.y + (u * p.y + v * q.y + w * r.y) / 8.0 * frame.step, hint);
    };
    EXPECT_NEAR(*at(3, 1, t), (3 * mesh.height(a) + mesh.height(b) + 4 * mesh.height(c)) / 8, 1e-9);
    EXPECT_NEAR(*at(2, 6, t), (mesh.height(a) + 3 * mesh.height(b)) / 4, 1e-9);
    const TriangleId over = mesh.neighbour(t, 2);
    EXPECT_EQ(at(2, 6, t), at(2, 6, over == kNoTriangle ? t : over));
  }
  EXPECT_EQ(mesh.heightAt(0.0, 8.0), mesh.heightAt(LatticePoint{32, 16}));
  EXPECT_FALSE(mesh.heightAt(-8.01, 5.0));
  EXPECT_FALSE(mesh.heightAt(std::nan(""), 5.0));
}

TEST(Triangulation, RemovingEveryVertexLeavesTheBox) {
  RandomSequence random(8);
  Triangulation mesh(LatticeFrame{.width = 64, .height = 64});
  std::vector<VertexId> ids;
  for (int n = 0; n < 600; ++n) {
    const Insertion insertion = mesh.insert(
        {static_cast<std::int32_t>(random.next() % 65), static_cast<std::int32_t>(random.next() % 65)}, 0.0);
    if (insertion.isNew) ids.push_back(insertion.vertex);
  }
  while (!ids.empty()) {
    std::swap(ids[random.next() % ids.size()], ids.back());
    ASSERT_TRUE(mesh.remove(ids.back()));
    ids.pop_back();
    ASSERT_TRUE(valid(mesh));
  }
  EXPECT_EQ(mesh.vertexCount(), 4U);
  EXPECT_EQ(mesh.triangleCount(), 2U);
  for (VertexId v = 0; v < 4; ++v) EXPECT_FALSE(mesh.remove(v));
}

TEST(Triangulation, AHubOfThousandsOfTrianglesCanBeRemoved) {
  Triangulation mesh(LatticeFrame{.width = 1 << 20, .height = 1 << 20});
  constexpr std::int32_t kCentre = 1 << 19;
  const VertexId hub = mesh.insert({kCentre, kCentre}, 0.0).vertex;
  for (int n = 0; n < 3000; ++n) {
    const double turn = 6.283185307179586 * n / 3000;
    mesh.insert({kCentre + static_cast<std::int32_t>(500000 * std::cos(turn)),
                 kCentre + static_cast<std::int32_t>(500000 * std::sin(turn))},
                0.0);
  }
  ASSERT_GT(neighbours(mesh, hub).size(), 2000U);
  EXPECT_TRUE(mesh.remove(hub));
  EXPECT_TRUE(valid(mesh));
}

TEST(Triangulation, AConstraintThroughVerticesIsMadeOfItsPieces) {
  Triangulation mesh(kSmall);
  const VertexId a = mesh.insert({10, 30}, 0.0).vertex;
  const VertexId middle = mesh.insert({50, 30}, 0.0).vertex;
  const VertexId b = mesh.insert({90, 30}, 0.0).vertex;
  for (std::int32_t x = 15; x < 90; x += 10) {
    mesh.insert({x, 29}, 0.0);
    mesh.insert({x + 3, 31}, 0.0);
  }
  EXPECT_EQ(mesh.constrain(a, b, 7), 0);
  EXPECT_TRUE(valid(mesh));
  EXPECT_EQ(mesh.constraint(a, middle), 7U);
  EXPECT_EQ(mesh.constraint(b, middle), 7U);
  EXPECT_FALSE(mesh.constraint(a, b));
  EXPECT_EQ(mesh.constraintCount(), 2U);
  EXPECT_FALSE(mesh.remove(middle));
  EXPECT_TRUE(mesh.unconstrain(a, middle));
  EXPECT_FALSE(mesh.unconstrain(a, middle));
  EXPECT_TRUE(mesh.unconstrain(middle, b));
  EXPECT_TRUE(mesh.remove(middle));
  EXPECT_TRUE(valid(mesh));
}

TEST(Triangulation, CrossingConstraintsMeetInAVertexOnTheOlderSurface) {
  Triangulation mesh(kSmall);
  const VertexId a = mesh.insert({10, 10}, 0.0).vertex, b = mesh.insert({60, 50}, 40.0).vertex;
  const VertexId c = mesh.insert({10, 50}, -3.0).vertex, d = mesh.insert({60, 10}, 5.0).vertex;
  EXPECT_EQ(mesh.constrain(a, b, 1), 0);
  EXPECT_EQ(mesh.constrain(c, d, 2), 1);
  EXPECT_TRUE(valid(mesh));
  const VertexId crossing = mesh.vertexAt({35, 30});
  ASSERT_NE(crossing, kNoVertex);
  EXPECT_EQ(mesh.height(crossing), 20.0);
  EXPECT_EQ(mesh.constraint(a, crossing), 1U);
  EXPECT_EQ(mesh.constraint(crossing, b), 1U);
  EXPECT_EQ(mesh.constraint(c, crossing), 2U);
  EXPECT_EQ(mesh.constraint(crossing, d), 2U);
}

TEST(Triangulation, ABundleOfAlmostEqualConstraintsMeetsInFewVertices) {
  RandomSequence random(18);
  constexpr std::int32_t kSide = 1 << 24;
  Triangulation mesh(LatticeFrame{.width = kSide, .height = kSide});
  int added = 0;
  for (std::uint32_t n = 0; n < 40; ++n) {
    const auto some = [&random] { return static_cast<std::int32_t>(random.next() % 8); };
    const VertexId a = mesh.insert({1000 + some(), kSide / 3 + some()}, 0.0).vertex;
    const VertexId b = mesh.insert({kSide - 1000 - some(), kSide / 2 + some()}, 0.0).vertex;
    added += mesh.constrain(a, b, n);
  }
  EXPECT_TRUE(valid(mesh));
  EXPECT_LT(added, 40 * 40);
  EXPECT_GT(added, 10);
}

TEST(Triangulation, APieceOfAnOlderConstraintTakesNoEdgeFromANewerOne) {
  Triangulation mesh(LatticeFrame{.width = 4096, .height = 4096});
  const auto at = [&mesh](std::int32_t x, std::int32_t y) { return mesh.insert({x, y}, 0.0).vertex; };
  const VertexId west = at(100, 100);
  mesh.constrain(west, at(700, 101), 1);
  const VertexId square[] = {west, at(300, 100), at(300, 300), at(100, 300)};
  // The crossing with the second side rounds to the square's corner, and the older one comes along its first.
  for (std::size_t n = 0; n < 4; ++n) mesh.constrain(square[n], square[(n + 1) % 4], 2);
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_EQ(mesh.constraint(square[n], square[(n + 1) % 4]), 2U) << "side " << n;
  }
  EXPECT_TRUE(valid(mesh));
}

TEST(Triangulation, AVertexOnAConstraintDividesItIntoTwoOfItsKind) {
  Triangulation mesh(kSmall);
  const VertexId a = mesh.insert({10, 30}, 0.0).vertex, b = mesh.insert({90, 30}, 8.0).vertex;
  mesh.constrain(a, b, 9);
  mesh.constrain(0, 1, 4);
  const Insertion inside = mesh.insertOnSurface({30, 30});
  const Insertion onBorder = mesh.insertOnSurface({50, 0});
  EXPECT_TRUE(valid(mesh));
  EXPECT_EQ(mesh.height(inside.vertex), 2.0);
  EXPECT_EQ(mesh.constraint(a, inside.vertex), 9U);
  EXPECT_EQ(mesh.constraint(inside.vertex, b), 9U);
  EXPECT_EQ(mesh.constraint(0, onBorder.vertex), 4U);
  EXPECT_EQ(mesh.constraint(onBorder.vertex, 1), 4U);
  EXPECT_EQ(mesh.constraintCount(), 4U);
}

TEST(Triangulation, TakesAtMostNinetyBytesAVertex) {
  RandomSequence random(9);
  const auto anywhere = [&random] {
    return LatticePoint{static_cast<std::int32_t>(random.nextBits(28)),
                        static_cast<std::int32_t>(random.nextBits(28))};
  };
  Triangulation single(LatticeFrame{});
  double worst = 0.0;
  for (int n = 0; n < 100000; ++n) {
    const Insertion insertion = single.insert(anywhere(), 0.0);
    if (n > 5000)
      worst =
          std::max(worst, static_cast<double>(single.bytes()) / static_cast<double>(single.vertexCount()));
    ASSERT_TRUE(insertion.isNew || n > 0);
  }
  EXPECT_LE(worst, 90.0);
  std::vector<LatticePoint> points(100000);
  for (LatticePoint& p : points) p = anywhere();
  Triangulation many(LatticeFrame{});
  many.insert(points, std::vector<double>(points.size()));
  EXPECT_LE(static_cast<double>(many.bytes()) / static_cast<double>(many.vertexCount()), 80.0);
}

TEST(Triangulation, ACopyIsIndependent) {
  Triangulation mesh(kSmall);
  mesh.insert({20, 20}, 1.0);
  Triangulation copy = mesh;
  mesh.insert({30, 30}, 1.0);
  mesh.constrain(0, 2, 1);
  EXPECT_TRUE(valid(copy));
  EXPECT_EQ(copy.vertexCount(), 5U);
  EXPECT_EQ(copy.constraintCount(), 0U);
}

}  // namespace
}  // namespace teren
