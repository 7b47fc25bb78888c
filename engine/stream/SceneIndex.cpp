#include "stream/SceneIndex.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

namespace teren {

namespace {

/// A regular block is 8 x 8 squares: 5 % of a mesh's bytes, and a ray that comes near the ground walks over
/// few.
constexpr int kRegularBlockShift = 3;
/// Other meshes have up to so many blocks a side.
constexpr int kMostBlocks = 8;
/// Squares of the tree are not divided further where so few meshes lie over them: a node's own, and those
/// that join it to its eight neighbours.
constexpr std::size_t kMostInLeaf = 9;

constexpr HeightSpan kNoHeights{std::numeric_limits<float>::infinity(),
                                -std::numeric_limits<float>::infinity()};

void widen(HeightSpan& span, float height) {
  span.low = std::min(span.low, height);
  span.high = std::max(span.high, height);
}
void widen(HeightSpan& span, const HeightSpan& other) {
  span.low = std::min(span.low, other.low);
  span.high = std::max(span.high, other.high);
}
/// By all that what is moved between two heights may come to.
void widenBetween(HeightSpan& span, float low, float high) {
  const float beyond = kMorphRounding * std::max(std::fabs(low), std::fabs(high));
  widen(span, low - beyond);
  widen(span, high + beyond);
}
/// Wherever an eye sees the vertex (Morph.h).
void widen(HeightSpan& span, const SurfaceVertex& vertex) {
  if (vertex.level() == SurfaceVertex::kFixed) return widen(span, vertex.height);
  widenBetween(span, std::min(vertex.height, vertex.coarserHeight),
               std::max(vertex.height, vertex.coarserHeight));
}

/// The index list of a rectangle of squares, each split from south-west to north-east, row by row.
bool isGrid(const TriangleIndices& indices, int columns, int rows) {
  const auto across = static_cast<std::uint32_t>(columns + 1);
  std::size_t at = 0;
  if (indices.size() != std::size_t{6} * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {
    return false;
  }
  for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row) {
    for (std::uint32_t column = 0; column < static_cast<std::uint32_t>(columns); ++column, at += 6) {
      const std::uint32_t southWest = row * across + column, northWest = southWest + across;
      const std::array<std::uint32_t, 6> wanted{southWest, southWest + 1, northWest + 1,
                                                southWest, northWest + 1, northWest};
      if (!std::equal(wanted.begin(), wanted.end(), indices.begin() + static_cast<std::ptrdiff_t>(at))) {
        return false;
      }
    }
  }
  return true;
}

/// Whether the vertices stand row by row.
bool standsInRows(const Mesh& mesh) {
  std::size_t at = 0;
  if (mesh.vertices.size() !=
      static_cast<std::size_t>(mesh.columns + 1) * static_cast<std::size_t>(mesh.rows + 1)) {
    return false;
  }
  for (int row = 0; row <= mesh.rows; ++row) {
    for (int column = 0; column <= mesh.columns; ++column, ++at) {
      if (mesh.vertices[at].column != column || mesh.vertices[at].row != row) return false;
    }
  }
  return true;
}

}  // namespace

/// A square of the tree: from its south-west corner, 2^shift samples a side.
struct SceneIndex::Square {
  std::int64_t west = 0, south = 0;
  int shift = 0;

  std::int64_t side() const { return std::int64_t{1} << shift; }
  Square child(std::size_t number) const {
    const auto x = static_cast<std::int64_t>(number % kFan), y = static_cast<std::int64_t>(number / kFan);
    const int below = shift - kFanShift;
    return {west + (x << below), south + (y << below), below};
  }
  /// Level-0 squares that it shares with a mesh's rectangle.
  double shared(const IndexedMesh& mesh) const {
    const std::int64_t across = std::min(mesh.east(), west + side()) - std::max(mesh.west, west);
    const std::int64_t up = std::min(mesh.north(), south + side()) - std::max(mesh.south, south);
    return across > 0 && up > 0 ? static_cast<double>(across) * static_cast<double>(up) : 0.0;
  }
};

SceneIndex::SceneIndex(const Scene& scene, int intervals, std::span<const float> errors,
                       const SceneIndex* before) {
  assert(intervals >= 1 && (errors.empty() || errors.size() == scene.meshes().size()));
  if (scene.meshes().empty()) return;
  placeCorner(scene, intervals);
  addMeshes(scene, before);
  for (std::size_t k = 0; k < errors.size(); ++k) meshes_[k].error = errors[k];
  std::int64_t reach = 0;
  for (const IndexedMesh& mesh : meshes_) reach = std::max({reach, mesh.east(), mesh.north()});
  rootShift_ = leastShift_;
  while (reach > std::int64_t{1} << rootShift_) rootShift_ += kFanShift;
  std::vector<std::uint32_t> all(meshes_.size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<std::uint32_t>(k);
  root_ = build({0, 0, rootShift_}, all, rootExtent_);
}

/// Nodes lie at multiples of their size, and so does the corner: then no node lies over a border of the tree
/// that it does not have to.
void SceneIndex::placeCorner(const Scene& scene, int intervals) {
  int finest = std::numeric_limits<int>::max(), coarsest = 0;
  cornerColumn_ = cornerRow_ = std::numeric_limits<std::int64_t>::max();
  for (const auto& mesh : scene.meshes()) {
    finest = std::min(finest, mesh->level);
    coarsest = std::max(coarsest, mesh->level);
    cornerColumn_ = std::min(cornerColumn_, mesh->originColumn);
    cornerRow_ = std::min(cornerRow_, mesh->originRow);
  }
  const int nodeShift = std::bit_width(static_cast<unsigned>(intervals)) - 1;
  leastShift_ = nodeShift + finest;
  cornerColumn_ = cornerColumn_ >> (nodeShift + coarsest) << (nodeShift + coarsest);
  cornerRow_ = cornerRow_ >> (nodeShift + coarsest) << (nodeShift + coarsest);
}

void SceneIndex::addMeshes(const Scene& scene, const SceneIndex* before) {
  if (before != nullptr) grids_ = before->grids_;
  const std::size_t known = before != nullptr ? before->ids_.size() : 0;
  meshes_.reserve(scene.meshes().size());
  ids_.reserve(scene.meshes().size());
  areas_.reserve(scene.meshes().size());
  std::size_t next = 0;
  for (const auto& mesh : scene.meshes()) {
    while (next < known && before->ids_[next] < mesh->id) ++next;
    IndexedMesh indexed;
    if (next < known && before->ids_[next] == mesh->id) {
      takeOver(*before, next, indexed);
    } else {
      measure(*mesh, indexed);
      ++measured_;
    }
    indexed.west = mesh->originColumn - cornerColumn_;
    indexed.south = mesh->originRow - cornerRow_;
    meshes_.push_back(indexed);
    ids_.push_back(mesh->id);
  }
}

void SceneIndex::measure(const Mesh& mesh, IndexedMesh& indexed) {
  indexed.vertices = mesh.vertices.data();
  indexed.indices = mesh.indices->data();
  indexed.heights = kNoHeights;
  widenBetween(indexed.heights, mesh.minHeight, mesh.maxHeight);
  indexed.columns = mesh.columns;
  indexed.rows = mesh.rows;
  indexed.level = static_cast<std::int8_t>(mesh.level);
  indexed.regular = isRegular(mesh);
  indexed.firstBlock = static_cast<std::uint32_t>(blockHeights_.size());
  if (indexed.regular) {
    indexed.blockShift = kRegularBlockShift;
    measureGrid(mesh, indexed);
  } else {
    while (std::max(mesh.columns, mesh.rows) > kMostBlocks << indexed.blockShift) ++indexed.blockShift;
    measureBag(mesh, indexed);
  }
}

bool SceneIndex::isRegular(const Mesh& mesh) {
  if (!standsInRows(mesh)) return false;
  if (std::find(grids_.begin(), grids_.end(), mesh.indices) != grids_.end()) return true;
  if (!isGrid(*mesh.indices, mesh.columns, mesh.rows)) return false;
  grids_.push_back(mesh.indices);
  return true;
}

void SceneIndex::takeOver(const SceneIndex& before, std::size_t known, IndexedMesh& indexed) {
  const IndexedMesh& old = before.meshes_[known];
  const auto blocks = static_cast<std::size_t>(old.blocks());
  indexed = old;
  areas_.push_back(before.areas_[known]);
  indexed.firstBlock = static_cast<std::uint32_t>(blockHeights_.size());
  const auto heights = before.blockHeights_.begin() + old.firstBlock;
  blockHeights_.insert(blockHeights_.end(), heights, heights + static_cast<std::ptrdiff_t>(blocks));
  if (old.regular) return;
  indexed.firstBucket = static_cast<std::uint32_t>(bucketStarts_.size());
  const std::uint32_t first = before.bucketStarts_[old.firstBucket];
  const std::uint32_t last = before.bucketStarts_[old.firstBucket + blocks];
  const auto here = static_cast<std::uint32_t>(bucketTriangles_.size());
  for (std::size_t k = 0; k <= blocks; ++k) {
    bucketStarts_.push_back(before.bucketStarts_[old.firstBucket + k] - first + here);
  }
  bucketTriangles_.insert(bucketTriangles_.end(), before.bucketTriangles_.begin() + first,
                          before.bucketTriangles_.begin() + last);
}

void SceneIndex::measureGrid(const Mesh& mesh, const IndexedMesh& indexed) {
  const double step = static_cast<double>(std::int64_t{1} << mesh.level);
  areas_.push_back(mesh.columns * step * (mesh.rows * step));
  constexpr int kSide = 1 << kRegularBlockShift;
  const std::size_t across = static_cast<std::size_t>(mesh.columns) + 1;
  for (int y = 0; y < indexed.blockRows() * kSide; y += kSide) {
    for (int x = 0; x < indexed.blockColumns() * kSide; x += kSide) {
      HeightSpan span = kNoHeights;
      for (int row = y; row <= std::min(y + kSide, mesh.rows); ++row) {
        const SurfaceVertex* const line = mesh.vertices.data() + static_cast<std::size_t>(row) * across;
        for (int column = x; column <= std::min(x + kSide, mesh.columns); ++column) {
          widen(span, line[column]);
        }
      }
      blockHeights_.push_back(span);
    }
  }
}

namespace {

using Corners = std::array<const SurfaceVertex*, 3>;

/// Calls visit(the triangle's first place in the indices, its corners) for all of a mesh's.
template <class Visit>
void forEachTriangle(const Mesh& mesh, const Visit& visit) {
  const TriangleIndices& indices = *mesh.indices;
  for (std::size_t at = 0; at + 2 < indices.size(); at += 3) {
    visit(static_cast<std::uint32_t>(at),
          Corners{&mesh.vertices[indices[at]], &mesh.vertices[indices[at + 1]],
                  &mesh.vertices[indices[at + 2]]});
  }
}

/// Calls visit(block) for the blocks that the rectangle around a triangle has a point in common with.
template <class Visit>
void forEachBlock(const IndexedMesh& mesh, const Corners& corners, const Visit& visit) {
  const auto [left, right] = std::minmax({corners[0]->column, corners[1]->column, corners[2]->column});
  const auto [bottom, top] = std::minmax({corners[0]->row, corners[1]->row, corners[2]->row});
  const int lastColumn = std::min(right >> mesh.blockShift, mesh.blockColumns() - 1);
  const int lastRow = std::min(top >> mesh.blockShift, mesh.blockRows() - 1);
  for (int y = bottom >> mesh.blockShift; y <= lastRow; ++y) {
    for (int x = left >> mesh.blockShift; x <= lastColumn; ++x) {
      visit(static_cast<std::size_t>(y * mesh.blockColumns() + x));
    }
  }
}

}  // namespace

void SceneIndex::measureBag(const Mesh& mesh, IndexedMesh& indexed) {
  const auto blocks = static_cast<std::size_t>(indexed.blocks());
  blockHeights_.resize(blockHeights_.size() + blocks, kNoHeights);
  std::vector<std::uint32_t> ends(blocks + 1, static_cast<std::uint32_t>(bucketTriangles_.size()));
  std::int64_t twice = 0;
  forEachTriangle(mesh, [&](std::uint32_t, const Corners& corners) {
    const auto& [a, b, c] = corners;
    twice += std::int64_t{b->column - a->column} * (c->row - a->row) -
             std::int64_t{c->column - a->column} * (b->row - a->row);
    forEachBlock(indexed, corners, [&](std::size_t block) {
      ++ends[block + 1];
      for (const SurfaceVertex* corner : corners) {
        widen(blockHeights_[indexed.firstBlock + block], *corner);
      }
    });
  });
  const double step = static_cast<double>(std::int64_t{1} << mesh.level);
  areas_.push_back(0.5 * static_cast<double>(twice) * step * step);
  for (std::size_t k = 1; k <= blocks; ++k) ends[k] += ends[k - 1] - ends[0];
  indexed.firstBucket = static_cast<std::uint32_t>(bucketStarts_.size());
  bucketStarts_.insert(bucketStarts_.end(), ends.begin(), ends.end());
  bucketTriangles_.resize(ends.back());
  forEachTriangle(mesh, [&](std::uint32_t triangle, const Corners& corners) {
    forEachBlock(indexed, corners, [&](std::size_t block) { bucketTriangles_[ends[block]++] = triangle; });
  });
}

SceneIndex::Entry SceneIndex::build(const Square& square, std::span<const std::uint32_t> meshes,
                                    Extent& extent) {
  if (meshes.empty()) {
    extent = {kNoHeights, false};
    return {Kind::nothing, 0};
  }
  if (meshes.size() > kMostInLeaf && square.shift > leastShift_) return buildBranch(square, meshes, extent);
  extent = leafExtent(square, meshes);
  return buildLeaf(square, meshes);
}

SceneIndex::Entry SceneIndex::buildBranch(const Square& square, std::span<const std::uint32_t> meshes,
                                          Extent& extent) {
  constexpr std::size_t kEntries = std::size_t{kFan} * kFan;
  // Meshes by the entries they lie over: counted, then sorted in.
  std::array<std::uint32_t, kEntries + 1> starts{};
  const int below = square.shift - kFanShift;
  const auto forEachEntry = [&](std::uint32_t number, const auto& visit) {
    const IndexedMesh& mesh = meshes_[number];
    const auto clamped = [&](std::int64_t at) { return std::clamp<std::int64_t>(at >> below, 0, kFan - 1); };
    const std::int64_t left = clamped(mesh.west - square.west),
                       right = clamped(mesh.east() - 1 - square.west);
    const std::int64_t top = clamped(mesh.north() - 1 - square.south);
    for (std::int64_t y = clamped(mesh.south - square.south); y <= top; ++y) {
      for (std::int64_t x = left; x <= right; ++x) visit(static_cast<std::size_t>(y * kFan + x));
    }
  };
  for (const std::uint32_t number : meshes) {
    forEachEntry(number, [&](std::size_t entry) { ++starts[entry + 1]; });
  }
  for (std::size_t k = 1; k <= kEntries; ++k) starts[k] += starts[k - 1];
  std::vector<std::uint32_t> sorted(starts.back());
  std::array<std::uint32_t, kEntries + 1> next = starts;
  for (const std::uint32_t number : meshes) {
    forEachEntry(number, [&](std::size_t entry) { sorted[next[entry]++] = number; });
  }
  const std::size_t index = branches_.size();
  branches_.emplace_back();
  extents_.resize(extents_.size() + kEntries);
  extent = {kNoHeights, true};
  for (std::size_t k = 0; k < kEntries; ++k) {
    Extent below8;
    const std::span<const std::uint32_t> over(sorted.data() + starts[k], starts[k + 1] - starts[k]);
    const Entry entry = build(square.child(k), over, below8);
    branches_[index].entries[k] = entry;
    extents_[index * kEntries + k] = below8;
    widen(extent.heights, below8.heights);
    extent.covered = extent.covered && below8.covered;
  }
  return {Kind::branch, static_cast<std::uint32_t>(index)};
}

SceneIndex::Entry SceneIndex::buildLeaf(const Square& square, std::span<const std::uint32_t> meshes) {
  Leaf leaf;
  leaf.first = static_cast<std::uint32_t>(lists_.size());
  leaf.count = static_cast<std::uint32_t>(meshes.size());
  lists_.insert(lists_.end(), meshes.begin(), meshes.end());
  const auto most =
      std::max_element(lists_.begin() + leaf.first, lists_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::min(square.shared(meshes_[a]), areas_[a]) <
               std::min(square.shared(meshes_[b]), areas_[b]);
      });
  std::iter_swap(lists_.begin() + leaf.first, most);
  leaves_.push_back(leaf);
  return {Kind::leaf, static_cast<std::uint32_t>(leaves_.size() - 1)};
}

/// Meshes do not overlap, so a square is covered where areas add up to its own. A bag of triangles counts
/// where all of it lies in the square.
SceneIndex::Extent SceneIndex::leafExtent(const Square& square, std::span<const std::uint32_t> meshes) const {
  Extent extent{kNoHeights, false};
  double area = 0.0;
  for (const std::uint32_t number : meshes) {
    const IndexedMesh& mesh = meshes_[number];
    widen(extent.heights, mesh.heights);
    const bool inside = square.west <= mesh.west && mesh.east() <= square.west + square.side() &&
                        square.south <= mesh.south && mesh.north() <= square.south + square.side();
    if (mesh.regular) {
      area += square.shared(mesh);
    } else if (inside) {
      area += areas_[number];
    }
  }
  extent.covered = area == static_cast<double>(square.side()) * static_cast<double>(square.side());
  return extent;
}

std::size_t SceneIndex::bytes() const noexcept {
  const auto held = [](const auto& list) { return list.capacity() * sizeof(list[0]); };
  return sizeof(*this) + held(branches_) + held(extents_) + held(leaves_) + held(lists_) + held(meshes_) +
         held(ids_) + held(areas_) + held(blockHeights_) + held(bucketStarts_) + held(bucketTriangles_) +
         held(grids_);
}

}  // namespace teren
