#include "teren/Bake.h"

#include <bit>
#include <cassert>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "teren/EditedGround.h"
#include "teren/Hash.h"
#include "teren/HeightMapOperations.h"
#include "teren/Parameter.h"

#include "patch/NodeTask.h"
#include "schedule/TaskRunner.h"

namespace teren {

namespace {

constexpr std::int64_t kMaxSamples = std::int64_t{1} << 28;
constexpr std::size_t kBakeBytes = std::size_t{128} << 20;

/// Samples of one axis, counted at the region's level.
struct Extent {
  std::int64_t first = 0, count = 0;
};

Result<Extent> extent(std::int64_t patch, std::int64_t patches, int intervals, int level, const char* axis) {
  if (patches < 1)
    return Error{std::string("the region has ") + std::to_string(patches) + " " + axis +
                 ", expected at least 1"};
  if (patch < -kMaxPatch || patch >= kMaxPatch || patches > kMaxPatch - patch) {
    return Error{std::string("the region's ") + axis +
                 " reach beyond the world, which ends at +-2^52 patches"};
  }
  const std::int64_t stride = std::int64_t{1} << level;
  const std::int64_t first = patch * intervals, length = patches * intervals;
  if (first % stride != 0 || length % stride != 0) {
    return Error{std::string("the region's ") + axis + " do not fit level " + std::to_string(level) +
                 ": patch indices times " + std::to_string(intervals) + " must be multiples of " +
                 std::to_string(stride)};
  }
  return Extent{first / stride, length / stride + 1};
}

std::vector<NodeKey> coveringNodes(const Extent& columns, const Extent& rows, int level, int nodeBits) {
  const auto last = [&](const Extent& e) { return (e.first + e.count - 2) >> nodeBits; };
  std::vector<NodeKey> nodes;
  for (std::int64_t j = rows.first >> nodeBits; j <= last(rows); ++j) {
    for (std::int64_t i = columns.first >> nodeBits; i <= last(columns); ++i) nodes.push_back({level, i, j});
  }
  return nodes;
}

void shuffle(std::vector<NodeKey>& nodes, std::uint64_t seed) {
  RandomSequence random(seed);
  for (std::size_t left = nodes.size(); left > 1; --left) {
    std::swap(nodes[left - 1], nodes[random.next() % left]);
  }
}

/// Copies the part of the node that lies in the region. A line that two nodes share is the south or west
/// one's, as in meshes: their bits are the same, but where a plugin fails for one of them.
void place(const HeightMap& node, const NodeKey& key, const Extent& columns, const Extent& rows,
           HeightMap& target) {
  const int side = node.columns(), n = side - 1;
  const std::int64_t column = key.i * n - columns.first, row = key.j * n - rows.first;
  const int west = column > 0 ? 1 : 0, south = row > 0 ? 1 : 0;  // the first of its own
  const MatchedParts parts =
      matchedParts(node.view(), {west, south, side - west, side - south}, target.view(),
                   static_cast<int>(column) + west, static_cast<int>(row) + south);
  copyHeights(parts.source, parts.target);
}

/// What one bake works on.
struct Bake {
  const World& world;
  const BakeOptions& options;
  const Extent& columns;
  const Extent& rows;
  std::vector<NodeKey> nodes;
  HeightMap result;
  BaseMapStore store{kBakeBytes};
  std::size_t done = 0;

  bool goesOn() const { return !options.progress || options.progress(done, nodes.size()); }
  void finish(const NodeTask& task) {
    place(task.heights(), task.key(), columns, rows, result);
    ++done;
  }
};

bool bakeHere(Bake& bake) {
  const std::chrono::microseconds slice = bake.options.slice;
  for (const NodeKey& key : bake.nodes) {
    NodeTask task(bake.world, key, bake.store);
    for (bool finished = false; !finished;) {
      if (!bake.goesOn()) return false;
      finished = task.step(slice.count() > 0 ? Slice::lasting(slice) : Slice::unlimited());
    }
    bake.finish(task);
  }
  return true;
}

/// Neighbours share base maps, so each worker had better have a stretch of the list to itself: the first
/// nodes of all stretches, then the second ones, and so on.
std::vector<NodeKey> inStretches(const std::vector<NodeKey>& nodes, std::size_t stretches) {
  const std::size_t length = (nodes.size() + stretches - 1) / stretches;
  std::vector<NodeKey> ordered;
  ordered.reserve(nodes.size());
  for (std::size_t k = 0; k < length; ++k) {
    for (std::size_t node = k; node < nodes.size(); node += length) ordered.push_back(nodes[node]);
  }
  return ordered;
}

/// A task holds its node's heights, so only a few are on their way at a time.
bool bakeOnWorkers(Bake& bake) {
  constexpr std::chrono::milliseconds kBetweenReports(100);
  constexpr std::size_t kTasksAWorker = 4;
  const auto workers = static_cast<std::size_t>(bake.options.workers);
  const std::vector<NodeKey> nodes = inStretches(bake.nodes, workers);
  TaskRunner runner(bake.options.workers);
  std::size_t begun = 0;
  while (bake.done < nodes.size()) {
    if (!bake.goesOn()) return false;
    for (; begun < nodes.size() && begun < bake.done + workers * kTasksAWorker; ++begun) {
      runner.submit(std::make_unique<NodeTask>(bake.world, nodes[begun], bake.store), 0);
    }
    runner.waitForFinished(kBetweenReports);
    for (const TaskRunner::Finished& finished : runner.takeFinished()) {
      bake.finish(static_cast<const NodeTask&>(*finished.task));
    }
  }
  return true;
}

}  // namespace

Result<HeightMap> bake(const World& world, const BakeRegion& region, const BakeOptions& options) {
  if (region.level < 0 || region.level > world.topLevel()) {
    return Error{"level is " + std::to_string(region.level) + ", expected 0 to " +
                 std::to_string(world.topLevel()) + ", the world's top level"};
  }
  const int n = world.intervals();
  const Result<Extent> columns = extent(region.i, region.columns, n, region.level, "columns");
  if (!columns) return columns.error();
  const Result<Extent> rows = extent(region.j, region.rows, n, region.level, "rows");
  if (!rows) return rows.error();
  if (columns->count > kMaxSamples || rows->count > kMaxSamples / columns->count) {
    return Error{"the region has " + std::to_string(columns->count) + " x " + std::to_string(rows->count) +
                 " samples, more than the 2^28 that one bake may have"};
  }
  if (options.workers < 0 || options.workers > BakeOptions::kMostWorkers) {
    return Error{"the workers are " + std::to_string(options.workers) + ", expected 0 to " +
                 std::to_string(BakeOptions::kMostWorkers)};
  }
  Bake bake{world,
            options,
            *columns,
            *rows,
            coveringNodes(*columns, *rows, region.level, std::countr_zero(static_cast<unsigned>(n))),
            HeightMap(static_cast<int>(columns->count), static_cast<int>(rows->count))};
  if (options.visitSeed != 0) shuffle(bake.nodes, options.visitSeed);
  const bool finished = options.workers == 0 ? bakeHere(bake) : bakeOnWorkers(bake);
  if (!finished) return Error{"cancelled"};
  if (options.edits != nullptr) {
    assert(&options.edits->world() == &world);
    options.edits->overlay(region.level, columns->first, rows->first, bake.result.view());
  }
  if (options.progress) options.progress(bake.done, bake.nodes.size());
  return std::move(bake.result);
}

}  // namespace teren
