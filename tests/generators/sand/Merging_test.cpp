#include "generators/sand/Merging.h"

#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "generators/sand/Sandbox.h"

namespace teren {
namespace {

constexpr int kShift = 10;
constexpr int kSide = 24;
constexpr double kStep = 2.0 / 1024;

/// A surface of closed squares that lie somewhere in its box.
SandSurface closedAt(LatticePoint corner) {
  SandSurface surface({.x = -kStep * corner.x, .y = -kStep * corner.y, .step = kStep}, 0.0, 0.0);
  surface.fence(OpenCells(corner, 4 * kSide, 4 * kSide, kShift));
  return surface;
}

SandSettings settings() {
  SandSettings settings;
  settings.longestEdge = 2.0;
  settings.flatness = 1e-3;
  return settings;
}

/// Rough ground on which sand was poured, 18 m in front of a fence to the east, or so far less.
Sandbox heap(double east = 0.0) {
  RandomSequence random(8);
  HeightMap ground(kSide + 1, kSide + 1);
  for (int y = 0; y <= kSide; ++y) {
    for (int x = 0; x <= kSide; ++x) ground(x, y) = 0.25F * static_cast<float>(random.nextBits(2));
  }
  Sandbox box(closedAt({1 << 20, 1 << 20}), settings());
  std::vector<Opening::Cell> cells;
  forEachCellWithin(box.surface(), 24.0, 24.0, 18.0, [&](Opening::Cell cell) { cells.push_back(cell); });
  box.open(ground.view(), {}, cells);
  box.pour(25.0 + east, 24.0, 6.0, 4.0);
  while (!box.isDone()) box.iterate(1000);
  return box;
}

/// The corners of the triangles around every vertex that came, in the order in which they are found, as
/// places from the first square.
std::vector<LatticePoint> order(const SandSurface& surface, const std::vector<VertexId>& taken) {
  const LatticePoint first = surface.cells().corner();
  std::vector<LatticePoint> found;
  for (const VertexId v : taken) {
    if (v == kNoVertex || surface.isFixed(v)) continue;
    surface.mesh().forEachCorner(v, [&](Link at) {
      for (const VertexId corner : surface.mesh().corners(at.triangle())) {
        const LatticePoint p = surface.mesh().point(corner);
        found.push_back({p.x - first.x, p.y - first.y});
      }
    });
  }
  return found;
}

TEST(Merging, LeavesNoTraceOfWhatLiesOutside) {
  const Sandbox box = heap();
  std::vector<std::vector<LatticePoint>> orders;
  for (const LatticePoint corner :
       {LatticePoint{0, 0}, LatticePoint{1 << 27, 1 << 27}, LatticePoint{262'000 << 10, 3 << 10}}) {
    for (const int others : {0, 1, 2}) {
      SandSurface surface = closedAt(corner);
      if (others > 0) mergeSand(surface, box.surface(), 9, 30, 0);
      if (others > 1) mergeSand(surface, box.surface(), 33, 51, 0);
      const std::vector<VertexId> taken = mergeSand(surface, box.surface(), 30, 30, 0);
      orders.push_back(order(surface, taken));
      EXPECT_TRUE(surface.validate().ok());
    }
  }
  EXPECT_GT(orders.front().size(), 1000U);
  for (const std::vector<LatticePoint>& one : orders) EXPECT_TRUE(one == orders.front());
}

TEST(Merging, KeepsTheIdsOfConstraintsApart) {
  const Sandbox box = heap();
  SandSurface surface = closedAt({5 << 10, 5 << 10});
  const std::vector<VertexId> taken = mergeSand(surface, box.surface(), 0, 0, 100);
  int compared = 0;
  box.surface().mesh().forEachConstraint([&](VertexId a, VertexId b, std::uint32_t id) {
    const auto there = surface.mesh().constraint(taken[a], taken[b]);
    ASSERT_TRUE(there.has_value());
    EXPECT_EQ(*there, id == Opening::kFenceId ? id : id + 100);
    ++compared;
  });
  EXPECT_GT(compared, 30);
  EXPECT_EQ(surface.mesh().constraintCount(), box.surface().mesh().constraintCount());
}

TEST(Merging, RemembersWhereSandLeansOnTheFence) {
  const auto corners = [](const Sandbox& box) {
    std::vector<LatticePoint> found;
    const LatticePoint first = box.surface().cells().corner();
    for (const VertexId v : box.slides().leanedOn().ids()) {
      EXPECT_TRUE(box.surface().isFixed(v));
      const LatticePoint p = box.surface().mesh().point(v);
      found.push_back({p.x - first.x, p.y - first.y});
    }
    return found;
  };
  EXPECT_TRUE(corners(heap()).empty());
  const Sandbox other = heap(9.0);
  Sandbox box(closedAt({7 << kShift, 9 << kShift}), settings());
  box.take(other, 3, 5);
  std::vector<LatticePoint> expected = corners(other);
  EXPECT_GT(expected.size(), 3U);
  for (LatticePoint& p : expected) p = {p.x + (3 << kShift), p.y + (5 << kShift)};
  EXPECT_TRUE(corners(box) == expected);
}

}  // namespace
}  // namespace teren
