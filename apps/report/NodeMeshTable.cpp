#include "apps/report/NodeMeshTable.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "teren/Bake.h"
#include "teren/Engine.h"
#include "teren/PixelError.h"
#include "teren/SurfaceVertex.h"

#include "apps/report/FlownNodes.h"
#include "apps/report/Stopwatch.h"
#include "apps/report/TriangleTable.h"
#include "generators/tin/GridApproximation.h"

namespace teren {
namespace {

constexpr double kUpdatesPerSecond = 60.0;
constexpr int kMostFiner = 2;

/// A square of so many nodes of one level, sampled as finely as its nodes' ways want.
struct NodeBlock {
  const World& world;
  int level = 0, nodes = 0;       // nodes along a side
  std::map<int, HeightMap> maps;  // by level
  std::map<int, double> seconds;  // to make a node's share of those

  int truthLevel() const { return std::max(0, level - kTruthLevels); }
  int intervals(int atLevel) const { return world.intervals() << (level - atLevel); }
  ConstHeightView part(int atLevel, int node) const {
    const int side = intervals(atLevel);
    return maps.at(atLevel).view().part(node % nodes * side, node / nodes * side, side + 1, side + 1);
  }
};

Result<void> sample(NodeBlock& block, int level, const GoOn& goOn) {
  if (block.maps.contains(level)) return {};
  BakeOptions options;
  options.slice = std::chrono::milliseconds(20);
  options.progress = [&goOn](std::size_t, std::size_t) { return goOn(); };
  const std::int64_t patches = static_cast<std::int64_t>(block.nodes) << block.level;
  std::optional<Result<HeightMap>> map;
  const double seconds = processorSecondsOf([&] {
    map = bake(block.world, {.i = 0, .j = 0, .columns = patches, .rows = patches, .level = level}, options);
  });
  if (!goOn()) return Error{"interrupted"};
  if (!*map) return map->error();
  block.seconds[level] = seconds / (static_cast<double>(block.nodes) * block.nodes);
  block.maps.emplace(level, **std::move(map));
  return {};
}

NodeFigures regularNode(const NodeBlock& block, int node) {
  const int truth = block.truthLevel(), side = block.intervals(truth), own = block.intervals(block.level);
  NodeFigures figures;
  figures.error =
      largestGap(block.part(truth, node), block.part(block.level, node), block.level - truth, 0, 0, side);
  figures.triangles = 2.0 * own * own;
  figures.bytes = (own + 1.0) * (own + 1.0) * sizeof(SurfaceVertex);  // indices are shared by all nodes
  figures.samplesTime = block.seconds.at(block.level);
  return figures;
}

Result<NodeFigures> meshedNode(const NodeBlock& block, int node, int dataLevel, double tolerance) {
  const int truth = block.truthLevel(), side = block.intervals(truth);
  const LatticeFrame frame{.step = block.world.spacing(truth), .width = side, .height = side};
  std::optional<Result<Triangulation>> mesh;
  NodeFigures figures;
  figures.meshingTime = processorSecondsOf(
      [&] { mesh = approximateGrid(block.part(dataLevel, node), frame, tolerance, GridBorder::all); });
  if (!*mesh) return mesh->error();
  figures.error = worstErrorAtSamples(**mesh, block.part(truth, node));
  figures.triangles = static_cast<double>((*mesh)->triangleCount());
  figures.bytes = static_cast<double>((*mesh)->vertexCount()) * sizeof(SurfaceVertex) +
                  figures.triangles * 3 * sizeof(std::uint16_t);
  figures.samplesTime = block.seconds.at(dataLevel);
  return figures;
}

void add(NodeFigures& sum, const NodeFigures& figures, double share) {
  sum.error += share * figures.error;
  sum.triangles += share * figures.triangles;
  sum.bytes += share * figures.bytes;
  sum.samplesTime += share * figures.samplesTime;
  sum.meshingTime += share * figures.meshingTime;
}

/// The nodes of one level in every way.
Result<std::vector<NodeFigures>> measureLevel(const World& world, int level, std::span<const NodeWay> ways,
                                              int nodes, const GoOn& goOn) {
  NodeBlock block{world, level, nodes, {}, {}};
  if (const Result<void> sampled = sample(block, block.truthLevel(), goOn); !sampled) return sampled.error();
  for (int finer = 0; finer <= kMostFiner; ++finer) {
    const Result<void> sampled = sample(block, std::max(0, level - finer), goOn);
    if (!sampled) return sampled.error();
  }
  const int count = nodes * nodes;
  NodeFigures regular;
  for (int node = 0; node < count; ++node) add(regular, regularNode(block, node), 1.0 / count);
  std::vector<NodeFigures> figures(ways.size());
  for (std::size_t way = 0; way < ways.size(); ++way) {
    const bool isRegular = ways[way].regular || level == 0;
    if (isRegular) figures[way] = regular;
    for (int node = 0; node < (isRegular ? 0 : count); ++node) {
      if (!goOn()) return Error{"interrupted"};
      const Result<NodeFigures> one =
          meshedNode(block, node, std::max(0, level - ways[way].finer), ways[way].tolerance * regular.error);
      if (!one) return one.error();
      add(figures[way], *one, 1.0 / count);
    }
  }
  return figures;
}

std::string nameOf(const NodeWay& way) {
  if (way.regular) return "regular grid";
  const std::string finer = way.finer == 0   ? "its own data"
                            : way.finer == 1 ? "data 1 level finer"
                                             : "data " + std::to_string(way.finer) + " levels finer";
  return "mesh of " + finer + " within " + rounded(way.tolerance, 3);
}

std::vector<Column> columns(double budget) {
  const std::string ms = rounded(budget, 3) + " ms";
  return {
      {"pixel error", "px", "wanted: a node is split where its measured error is seen as more"},
      {"way", "",
       "what a node is made into; `within`: the mesh's own tolerance, as a share of the regular "
       "node's error of the level"},
      {"nodes", "", "of a view of 20 km, on average over ten seconds of flight"},
      {"triangles", "", "of those, without what is drawn between levels"},
      {"regular / this", "", "triangles"},
      {"memory", "MiB", "of vertices (20 bytes) and of indices (16 bits) that no other node shares"},
      {"samples", "us", "processor time of a new node's samples, base maps included, on average in flight"},
      {"meshing", "us",
       "processor time of its triangulation, without normals and what is drawn between nodes"},
      {"nodes made", "1/s", "that 60 updates of " + ms + " a second make, of samples and meshing alone"},
      {"nodes needed", "1/s", "new ones at 300 m/s, none kept from before"},
      {"budget needed", "%", "of 60 updates of " + ms + " a second: needed over made"},
      {"time to fill", "s", "processor time of samples and meshing of the whole view"},
      {"nodes measured", "", "of each level"}};
}

void addRow(Table& table, double pixelError, double budget, const NodeWay& way,
            const std::vector<NodeFigures>& levels, FlownView view, double regularTriangles, int measured) {
  std::vector<double> errors;
  for (const NodeFigures& level : levels) errors.push_back(level.error);
  view.pixelError = pixelError;
  const FlownNodes flown = flownNodes(errors, view);
  double nodes = 0.0, needed = 0.0, fill = 0.0;
  NodeFigures inView, fresh;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    nodes += flown.inView[level];
    needed += flown.newASecond[level];
    add(inView, levels[level], flown.inView[level]);
    add(fresh, levels[level], flown.newASecond[level]);
    fill += flown.inView[level] * (levels[level].samplesTime + levels[level].meshingTime);
  }
  const double work = fresh.samplesTime + fresh.meshingTime, room = 1e-3 * budget * kUpdatesPerSecond;
  const double some = std::max(needed, 1e-9);
  table.add({pixelError, nameOf(way), nodes, inView.triangles,
             (regularTriangles > 0.0 ? regularTriangles : inView.triangles) / inView.triangles,
             inView.bytes / (1 << 20), 1e6 * fresh.samplesTime / some, 1e6 * fresh.meshingTime / some,
             work > 0.0 ? Cell(room * needed / work) : Cell(), needed, 100.0 * work / room, fill,
             static_cast<double>(measured)});
}

Table emptyTable(double budget, const std::string& conclusion) {
  return Table(
      "node-meshes", "Regular nodes and error-bounded meshes",
      "A view of 20 km of the world shipped at the same measured error: nodes of regular samples, as "
      "they are drawn, and nodes that were triangulated from their own or finer data until they keep "
      "a tolerance. How wrong each level is in each way is measured; which nodes a flight chooses by "
      "that is counted." +
          conclusion,
      columns(budget));
}

/// Of each pixel error, whose first row is that of regular nodes, what the mesh with the fewest triangles
/// takes.
std::string conclusionOf(const Table& table, std::size_t ways) {
  std::string text;
  for (std::size_t first = 0; first + ways <= table.rows().size(); first += ways) {
    std::size_t best = first;
    for (std::size_t row = first; row < first + ways; ++row) {
      if (table.number(row, "triangles") < table.number(best, "triangles")) best = row;
    }
    text += " At " + table.text(first, "pixel error") + " px the fewest triangles, " +
            rounded(table.number(best, "regular / this"), 3) +
            " times fewer than those of regular nodes, has " + table.text(best, "way") +
            ", and its new nodes take " + rounded(table.number(best, "budget needed"), 3) +
            " % of the budget in place of " + rounded(table.number(first, "budget needed"), 3) + " %.";
  }
  return text;
}

}  // namespace

std::vector<NodeWay> nodeWays() {
  std::vector<NodeWay> ways{{}};
  for (int finer = 0; finer <= kMostFiner; ++finer) {
    for (const double tolerance : {0.25, 0.5, 1.0, 2.0}) ways.push_back({false, finer, tolerance});
  }
  return ways;
}

Result<std::vector<std::vector<NodeFigures>>> measureNodes(const World& world, std::span<const NodeWay> ways,
                                                           const Effort& effort, const GoOn& goOn) {
  std::vector<std::vector<NodeFigures>> figures(ways.size());
  for (int level = 0; level <= world.topLevel(); ++level) {
    const Result<std::vector<NodeFigures>> some = measureLevel(world, level, ways, effort.meshedNodes, goOn);
    if (!some) return some.error();
    for (std::size_t way = 0; way < ways.size(); ++way) figures[way].push_back((*some)[way]);
  }
  return figures;
}

Result<Table> measureNodeMeshes(const World& world, std::span<const double> pixelErrors, double budget,
                                const Effort& effort, const GoOn& goOn) {
  Table table = emptyTable(budget, "");
  const std::vector<NodeWay> ways = nodeWays();
  const auto figures = measureNodes(world, ways, effort, goOn);
  if (!figures) return figures.error();
  const DetailSettings picture;
  FlownView view;
  view.nodeSide = world.pitch();
  view.distance = kFlownDistance;
  view.lensPixels = lensPixels(picture.lines, picture.fieldOfView);
  for (const double pixelError : pixelErrors) {
    double regularTriangles = 0.0;
    for (std::size_t way = 0; way < ways.size(); ++way) {
      if (!goOn()) return Error{"interrupted"};
      addRow(table, pixelError, budget, ways[way], (*figures)[way], view, regularTriangles,
             effort.meshedNodes * effort.meshedNodes);
      if (way == 0) regularTriangles = table.number(table.rows().size() - 1, "triangles");
    }
  }
  Table told = emptyTable(budget, conclusionOf(table, ways.size()));
  for (const std::vector<Cell>& row : table.rows()) told.add(row);
  return told;
}

std::vector<Plot> plotsOfNodeMeshes(const Table& table) {
  Plot plot{"node-meshes",
            "Triangles and work of a 20 km view, one mark a tolerance",
            "share of the budget that new nodes need at 300 m/s [%]",
            "triangles",
            true,
            true};
  for (std::size_t row = 0; row < table.rows().size(); ++row) {
    const std::string way = table.text(row, "way");
    const std::string title = table.text(row, "pixel error") + " px, " + way.substr(0, way.find(" within"));
    if (plot.curves.empty() || plot.curves.back().title != title) plot.curves.push_back({title, {}});
    plot.curves.back().points.emplace_back(table.number(row, "budget needed"),
                                           table.number(row, "triangles"));
  }
  return {plot};
}

}  // namespace teren
