#include "teren/Bake.h"

#include <bit>
#include <string>
#include <vector>

#include "teren/Hash.h"
#include "teren/HeightMapOperations.h"
#include "teren/Parameter.h"

#include "patch/NodeTask.h"

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

/// Copies the part of the node that lies in the region.
void place(const HeightMap& node, const NodeKey& key, const Extent& columns, const Extent& rows,
           HeightMap& target) {
  const std::int64_t n = node.columns() - 1;
  const MatchedParts parts =
      matchedParts(node.view(), target.view(), static_cast<int>(key.i * n - columns.first),
                   static_cast<int>(key.j * n - rows.first));
  copyHeights(parts.source, parts.target);
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
  HeightMap result(static_cast<int>(columns->count), static_cast<int>(rows->count));
  std::vector<NodeKey> nodes =
      coveringNodes(*columns, *rows, region.level, std::countr_zero(static_cast<unsigned>(n)));
  if (options.visitSeed != 0) shuffle(nodes, options.visitSeed);
  BaseMapStore store(kBakeBytes);
  std::size_t done = 0;
  for (const NodeKey& key : nodes) {
    NodeTask task(world, key, store);
    for (bool finished = false; !finished;) {
      if (options.progress && !options.progress(done, nodes.size())) return Error{"cancelled"};
      finished = task.step(options.slice.count() > 0 ? Slice::lasting(options.slice) : Slice::unlimited());
    }
    place(task.heights(), key, *columns, *rows, result);
    ++done;
  }
  if (options.progress) options.progress(done, nodes.size());
  return result;
}

}  // namespace teren
