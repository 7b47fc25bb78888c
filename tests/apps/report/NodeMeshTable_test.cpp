// Nodes as regular grids and as meshes: how wrong they are, and what that comes to.
#include "apps/report/NodeMeshTable.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/apps/report/SmallWorld.h"

namespace teren {
namespace {

using test::always;
using test::faultWorld;

TEST(NodeMeshes, AreMeasuredAgainstTheGroundAndNotAgainstTheirOwnData) {
  const auto world = faultWorld();
  const std::vector<NodeWay> ways{{}, {false, 0, 0.25}, {false, 0, 1.0}, {false, 2, 0.25}, {false, 2, 1.0}};
  const auto measured = measureNodes(*world, ways, Effort::ofAMinute(), always);
  ASSERT_TRUE(measured) << measured.error().message;
  const std::vector<std::vector<NodeFigures>>& figures = *measured;
  ASSERT_EQ(figures.size(), ways.size());
  const double intervals = world->intervals();
  for (const auto& levels : figures) {
    ASSERT_EQ(levels.size(), static_cast<std::size_t>(world->topLevel()) + 1);
    EXPECT_EQ(levels[0].error, 0.0);
    EXPECT_EQ(levels[0].triangles, 2.0 * intervals * intervals);
  }
  for (std::size_t level = 1; level < figures[0].size(); ++level) {
    const double regular = figures[0][level].error;
    EXPECT_GT(regular, figures[0][level - 1].error);
    for (std::size_t way = 1; way < ways.size(); ++way) {
      const NodeFigures& mesh = figures[way][level];
      const double side =
          intervals * std::exp2(std::min<double>(ways[way].finer, static_cast<double>(level)));
      EXPECT_GE(mesh.triangles, 4.0 * side - 2.0) << "all of the border";
      EXPECT_LE(mesh.triangles, 2.0 * side * side);
      EXPECT_GT(mesh.meshingTime, 0.0);
      EXPECT_GT(mesh.samplesTime, 0.0);
    }
    EXPECT_GT(figures[1][level].error, 0.7 * regular) << "as wrong as its data, but for its tolerance";
    EXPECT_LT(figures[1][level].error, 1.5 * regular);
    EXPECT_LT(figures[3][level].error, figures[1][level].error) << "finer data";
    EXPECT_LE(figures[2][level].triangles, figures[1][level].triangles);
    EXPECT_LE(figures[4][level].triangles, figures[3][level].triangles);
  }
}

TEST(NodeMeshTable, ComparesEveryWayWithRegularNodesAtEachPixelError) {
  const auto world = faultWorld();
  const std::vector<double> pixelErrors{2.0, 32.0};
  const auto table = measureNodeMeshes(*world, pixelErrors, 2.0, Effort::ofAMinute(), always);
  ASSERT_TRUE(table) << table.error().message;
  const std::size_t ways = nodeWays().size();
  ASSERT_EQ(table->rows().size(), 2 * ways);
  for (std::size_t row = 0; row < table->rows().size(); ++row) {
    const std::size_t first = row / ways * ways;
    EXPECT_EQ(table->number(row, "pixel error"), pixelErrors[row / ways]);
    EXPECT_EQ(table->text(row, "way") == "regular grid", row == first);
    EXPECT_NEAR(table->number(row, "regular / this") * table->number(row, "triangles"),
                table->number(first, "triangles"), 1.0);
    EXPECT_NEAR(table->number(row, "nodes needed") / table->number(row, "nodes made"),
                table->number(row, "budget needed") / 100.0, 1e-6);
  }
  EXPECT_NE(table->doc().find("At 2 px the fewest triangles"), std::string::npos) << table->doc();
  EXPECT_NE(table->doc().find("At 32 px the fewest triangles"), std::string::npos) << table->doc();
  EXPECT_GT(table->number(0, "triangles"), table->number(ways, "triangles")) << "a coarser view";
  ASSERT_EQ(plotsOfNodeMeshes(*table).at(0).curves.size(), 2U * 4U)
      << "regular nodes and three kinds of data";
}

TEST(NodeMeshTable, EndsWhenItIsAskedTo) {
  int left = 5;
  const auto table = measureNodeMeshes(*faultWorld(), std::vector<double>{8.0}, 2.0, Effort::ofAMinute(),
                                       [&] { return --left > 0; });
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().message, "interrupted");
}

}  // namespace
}  // namespace teren
