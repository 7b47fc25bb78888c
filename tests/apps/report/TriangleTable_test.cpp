// Errors of coarser grids and cuts through a quadtree, on grids that are known.
#include "apps/report/TriangleTable.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "teren/World.h"

namespace teren {
namespace {

/// (side + 1)^2 samples by a formula, and every 2^L-th of them.
template <class Formula>
std::vector<HeightMap> levelsOf(int side, int levels, const Formula& formula) {
  std::vector<HeightMap> maps;
  for (int level = 0; level < levels; ++level) {
    HeightMap& map = maps.emplace_back((side >> level) + 1, (side >> level) + 1);
    for (int y = 0; y < map.rows(); ++y) {
      for (int x = 0; x < map.columns(); ++x) map(x, y) = formula(x << level, y << level);
    }
  }
  return maps;
}

TEST(LargestGap, OfAPlaneIsNoneAndOfASpikeItsHeight) {
  const auto plane = levelsOf(16, 3, [](int x, int y) { return 2.0F * static_cast<float>(x - y); });
  EXPECT_EQ(largestGap(plane[0].view(), plane[2].view(), 2, 0, 0, 16), 0.0);
  const auto spike = levelsOf(16, 3, [](int x, int y) { return x == 9 && y == 5 ? -3.0F : 0.0F; });
  EXPECT_EQ(largestGap(spike[0].view(), spike[1].view(), 1, 0, 0, 16), 3.0);
  EXPECT_EQ(largestGap(spike[0].view(), spike[1].view(), 1, 0, 0, 8), 0.0) << "the spike is beyond";
  EXPECT_EQ(largestGap(spike[0].view(), spike[1].view(), 1, 8, 0, 8), 3.0);
}

TEST(LargestGap, SplitsSquaresFromSouthWestToNorthEast) {
  // The coarse square's corners: 0 and 0 on the diagonal, 4 in the south-east: the plane there is 2 halfway.
  auto maps = levelsOf(2, 2, [](int x, int y) { return x == 2 && y == 0 ? 4.0F : 0.0F; });
  EXPECT_EQ(largestGap(maps[0].view(), maps[1].view(), 1, 0, 0, 2), 2.0);
  maps[0](1, 0) = maps[0](2, 1) = 2.0F;
  EXPECT_EQ(largestGap(maps[0].view(), maps[1].view(), 1, 0, 0, 2), 0.0);
}

TEST(NodeCut, IsCoarseWhereTheLandAllowsIt) {
  const auto maps = levelsOf(32, 3, [](int x, int y) { return x == 3 && y == 1 ? 1.0F : 0.0F; });
  const NodeCut flat = coarsestCut(maps, 8, 1.0);
  EXPECT_EQ(flat.nodes, 1U);
  EXPECT_EQ(flat.triangles, 2U * 8 * 8);
  EXPECT_EQ(flat.error, 1.0);
  const NodeCut cut = coarsestCut(maps, 8, 0.5);
  EXPECT_EQ(cut.nodes, 7U) << "three quarters of the whole, and four of the quarter with the spike";
  EXPECT_EQ(cut.triangles, 7U * 2 * 8 * 8);
  EXPECT_EQ(cut.error, 0.0);
}

TEST(TriangleTable, KeepsItsErrorInEveryWay) {
  const auto world = World::create(WorldDescription::standard(), *PluginRegistry::standard());
  ASSERT_TRUE(world);
  Effort effort = Effort::ofAMinute();
  effort.groundIntervals = 256;
  const auto table = measureTriangles(**world, effort, [] { return true; });
  ASSERT_TRUE(table) << table.error().message;
  ASSERT_GE(table->rows().size(), 5U);
  for (std::size_t row = 0; row < table->rows().size(); ++row) {
    const double error = table->number(row, "error");
    EXPECT_LE(table->number(row, "uniform error"), error);
    EXPECT_LE(table->number(row, "chosen error"), error);
    EXPECT_LE(table->number(row, "TIN error"), error);
    EXPECT_LE(table->number(row, "chosen triangles"), table->number(row, "uniform triangles"));
    EXPECT_GT(table->number(row, "TIN triangles"), 0.0);
    if (row == 0) continue;
    EXPECT_LE(table->number(row, "TIN triangles"), table->number(row - 1, "TIN triangles"));
  }
}

}  // namespace
}  // namespace teren
