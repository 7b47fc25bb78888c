#include "apps/report/TriangleTable.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "teren/Bake.h"

#include "apps/report/Stopwatch.h"
#include "generators/tin/GridApproximation.h"

namespace teren {
namespace {

constexpr int kMostLevel = 5;

struct Cutting {
  const std::vector<HeightMap>& coarse;
  int intervals;
  double most;
  NodeCut cut;

  void take(int level, int column, int row) {
    const int side = intervals << level;
    const double error = level == 0
                             ? 0.0
                             : largestGap(coarse[0].view(), coarse[static_cast<std::size_t>(level)].view(),
                                          level, column, row, side);
    if (error > most) {
      for (int child = 0; child < 4; ++child) {
        take(level - 1, column + (child & 1) * side / 2, row + (child >> 1) * side / 2);
      }
      return;
    }
    ++cut.nodes;
    cut.triangles += 2 * static_cast<std::size_t>(intervals) * static_cast<std::size_t>(intervals);
    cut.error = std::max(cut.error, error);
  }
};

/// The ground at every level, and what it cost to make [s].
struct GroundLevels {
  std::vector<HeightMap> maps;
  std::vector<double> seconds;
};

Result<GroundLevels> groundOf(const World& world, int intervals, int levels, const GoOn& goOn) {
  GroundLevels ground;
  const std::int64_t patches = intervals / world.intervals();
  for (int level = 0; level < levels; ++level) {
    BakeOptions options;
    options.slice = std::chrono::milliseconds(20);
    options.progress = [&goOn](std::size_t, std::size_t) { return goOn(); };
    std::optional<Result<HeightMap>> map;
    ground.seconds.push_back(processorSecondsOf([&] {
      map = bake(world, {.i = 0, .j = 0, .columns = patches, .rows = patches, .level = level}, options);
    }));
    if (!goOn()) return Error{"interrupted"};
    if (!*map) return map->error();
    ground.maps.push_back(**std::move(map));
  }
  return ground;
}

std::vector<Column> columns() {
  return {{"error", "m",
           "largest distance from the level-0 surface that all three keep, measured at all its samples"},
          {"uniform level", "", "of the coarsest uniform grid that keeps it"},
          {"uniform error", "m", "of that grid, measured"},
          {"uniform triangles", "", "of that grid"},
          {"uniform time", "ms", "processor time of its heights, once"},
          {"chosen nodes", "", "fewest nodes of the quadtree of which none has a larger measured error"},
          {"chosen triangles", "", "of those, without seams"},
          {"chosen error", "m", "largest among them, measured"},
          {"TIN triangles", "", "greedy insertion into a Delaunay triangulation (generators/tin)"},
          {"TIN error", "m", "measured at all samples"},
          {"TIN time", "ms", "processor time of the triangulation, once, without the heights"},
          {"uniform / TIN", "", "triangles"},
          {"chosen / TIN", "", "triangles"}};
}

/// [m] Of the uniform grids, by level.
std::vector<double> uniformErrors(const GroundLevels& ground) {
  std::vector<double> errors;
  const int side = ground.maps[0].columns() - 1;
  for (std::size_t level = 0; level < ground.maps.size(); ++level) {
    errors.push_back(
        largestGap(ground.maps[0].view(), ground.maps[level].view(), static_cast<int>(level), 0, 0, side));
  }
  return errors;
}

/// [m] Those of the uniform grids, some between them, and some below them.
std::vector<double> errorsToKeep(const std::vector<double>& uniform) {
  std::vector<double> errors{uniform[1] / 4.0, uniform[1] / 2.0};
  for (std::size_t level = 1; level < uniform.size(); ++level) {
    errors.push_back(uniform[level]);
    if (level + 1 == uniform.size() || !(uniform[level + 1] > uniform[level])) continue;
    errors.push_back(std::sqrt(uniform[level] * uniform[level + 1]));
  }
  return errors;
}

Result<void> addRow(Table& table, const World& world, const GroundLevels& ground,
                    const std::vector<double>& uniform, double error) {
  const HeightMap& finest = ground.maps[0];
  const int side = finest.columns() - 1;
  std::size_t level = 0;
  for (std::size_t k = 0; k < uniform.size(); ++k) level = uniform[k] <= error ? k : level;
  const NodeCut cut = coarsestCut(ground.maps, world.intervals(), error);
  const LatticeFrame frame{.step = world.spacing(0), .width = side, .height = side};
  std::optional<Result<Triangulation>> mesh;
  const double seconds = processorSecondsOf([&] { mesh = approximateGrid(finest.view(), frame, error); });
  if (!*mesh) return mesh->error();
  const double tin = static_cast<double>((*mesh)->triangleCount());
  const double triangles = 2.0 * std::pow(static_cast<double>(side >> level), 2.0);
  table.add({error, static_cast<double>(level), uniform[level], triangles, 1e3 * ground.seconds[level],
             static_cast<double>(cut.nodes), static_cast<double>(cut.triangles), cut.error, tin,
             worstErrorAtSamples(**mesh, finest.view()), 1e3 * seconds, triangles / tin,
             static_cast<double>(cut.triangles) / tin});
  return {};
}

}  // namespace

double largestGap(ConstHeightView finest, ConstHeightView coarse, int level, int column, int row, int side) {
  const int stride = 1 << level;
  const int last = side >> level;
  double largest = 0.0;
  for (int y = 0; y <= side; ++y) {
    for (int x = 0; x <= side; ++x) {
      const int cellX = std::min(x >> level, last - 1), cellY = std::min(y >> level, last - 1);
      const double u = static_cast<double>(x - cellX * stride) / stride;
      const double v = static_cast<double>(y - cellY * stride) / stride;
      const int c = (column >> level) + cellX, r = (row >> level) + cellY;
      const double southWest = coarse(c, r), northEast = coarse(c + 1, r + 1);
      const double corner = u >= v ? coarse(c + 1, r) : coarse(c, r + 1);
      const double height =
          southWest + std::max(u, v) * (corner - southWest) + std::min(u, v) * (northEast - corner);
      largest = std::max(largest, std::fabs(finest(column + x, row + y) - height));
    }
  }
  return largest;
}

NodeCut coarsestCut(const std::vector<HeightMap>& coarse, int intervals, double most) {
  const int side = coarse[0].columns() - 1, top = static_cast<int>(coarse.size()) - 1;
  Cutting cutting{coarse, intervals, most, {}};
  const int node = intervals << top;
  for (int row = 0; row < side; row += node) {
    for (int column = 0; column < side; column += node) cutting.take(top, column, row);
  }
  return cutting.cut;
}

Result<Table> measureTriangles(const World& world, const Effort& effort, const GoOn& goOn) {
  Table table("triangles", "Triangles for equal measured error",
              "The same " + std::to_string(effort.groundIntervals) + " x " +
                  std::to_string(effort.groundIntervals) +
                  " squares of level-0 ground, drawn three ways that keep the same largest error.",
              columns());
  int levels = 1;
  while (levels <= std::min(kMostLevel, world.topLevel()) &&
         (world.intervals() << levels) <= effort.groundIntervals) {
    ++levels;
  }
  const Result<GroundLevels> ground = groundOf(world, effort.groundIntervals, levels, goOn);
  if (!ground) return ground.error();
  const std::vector<double> uniform = uniformErrors(*ground);
  if (uniform.size() < 2) return Error{"the world has no coarser level to compare with"};
  for (const double error : errorsToKeep(uniform)) {
    if (!goOn()) return Error{"interrupted"};
    if (const Result<void> added = addRow(table, world, *ground, uniform, error); !added) {
      return added.error();
    }
  }
  return table;
}

std::vector<Plot> plotsOfTriangles(const Table& table) {
  Plot plot{"triangles",
            "Triangles for equal measured error",
            "largest error [m]",
            "triangles",
            true,
            true,
            {{"uniform grid", {}}, {"chosen nodes", {}}, {"greedy TIN", {}}}};
  for (std::size_t row = 0; row < table.rows().size(); ++row) {
    const double error = table.number(row, "error");
    plot.curves[0].points.emplace_back(error, table.number(row, "uniform triangles"));
    plot.curves[1].points.emplace_back(error, table.number(row, "chosen triangles"));
    plot.curves[2].points.emplace_back(error, table.number(row, "TIN triangles"));
  }
  return {plot};
}

}  // namespace teren
