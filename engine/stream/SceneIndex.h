// Where the triangles of a snapshot are: a tree of squares down to the meshes that lie over each, and blocks
// of neighbouring triangles within each mesh, with the heights between which they lie.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "teren/Scene.h"

namespace teren {

/// [m] What lies between two heights, both included: of vertices, wherever an eye sees them (Morph.h).
struct HeightSpan {
  float low = 0.0F, high = 0.0F;
};

/// A mesh of the snapshot, in one line of the cache. Places count level-0 samples from the index's corner.
struct alignas(64) IndexedMesh {
  std::int64_t west = 0, south = 0;
  const SurfaceVertex* vertices = nullptr;
  const std::uint32_t* indices = nullptr;
  std::int32_t columns = 0, rows = 0;
  std::uint32_t firstBlock = 0;   ///< in SceneIndex::blockHeights
  std::uint32_t firstBucket = 0;  ///< of a bag of triangles: in SceneIndex::bucket
  HeightSpan heights;
  float error = 0.0F;  ///< [m] as it was handed over
  std::int8_t level = 0;
  std::int8_t blockShift = 0;  ///< a block is 2^blockShift steps a side
  /// Vertices row by row and every square split from south-west to north-east. Others are bags of triangles.
  bool regular = false;

  std::int64_t east() const noexcept { return west + (std::int64_t{columns} << level); }
  std::int64_t north() const noexcept { return south + (std::int64_t{rows} << level); }
  /// Where a vertex is.
  std::int64_t columnOf(const SurfaceVertex& vertex) const noexcept {
    return west + (std::int64_t{vertex.column} << level);
  }
  std::int64_t rowOf(const SurfaceVertex& vertex) const noexcept {
    return south + (std::int64_t{vertex.row} << level);
  }
  /// Whether a square, by its column and row, is one of the mesh's.
  bool holds(std::int64_t column, std::int64_t row) const noexcept {
    return 0 <= column && column < columns && 0 <= row && row < rows;
  }
  int blockColumns() const noexcept { return blocksAlong(columns); }
  int blockRows() const noexcept { return blocksAlong(rows); }
  int blocks() const noexcept { return blockColumns() * blockRows(); }

 private:
  int blocksAlong(int steps) const noexcept { return (steps + (1 << blockShift) - 1) >> blockShift; }
};
static_assert(sizeof(IndexedMesh) == 64);

/// Immutable once made. Built from another of nearly the same meshes it takes over what is known of those.
class SceneIndex {
 public:
  /// `intervals` n >= 1 of a node; `errors` one a mesh, or none. O(meshes), and O(triangles) of those that
  /// `before` (or nullptr) lacks.
  SceneIndex(const Scene& scene, int intervals, std::span<const float> errors, const SceneIndex* before);

  /// World position of the corner that all places are counted from, in level-0 samples.
  std::int64_t cornerColumn() const noexcept { return cornerColumn_; }
  std::int64_t cornerRow() const noexcept { return cornerRow_; }

  /// A branch has 8 x 8 entries, row by row; an entry is a branch, a leaf, or nothing.
  static constexpr int kFanShift = 3, kFan = 1 << kFanShift;
  enum class Kind : std::uint8_t { nothing, leaf, branch };
  struct Entry {
    Kind kind;
    std::uint32_t index;
  };
  struct Branch {
    std::array<Entry, kFan * kFan> entries;
  };
  /// What is known of an entry, for rays.
  struct Extent {
    HeightSpan heights;
    bool covered = false;  ///< there is ground all over its square
  };
  struct Leaf {
    std::uint32_t first = 0, count = 0;  ///< in the list of meshes, that with most of the square first
  };

  Entry root() const noexcept { return root_; }
  const Extent& rootExtent() const noexcept { return rootExtent_; }
  int rootShift() const noexcept { return rootShift_; }  ///< the root's square has 2^rootShift samples a side
  const Branch& branch(Entry entry) const noexcept { return branches_[entry.index]; }
  std::span<const Extent, kFan * kFan> extents(Entry branch) const noexcept {
    return std::span<const Extent, kFan * kFan>(extents_.data() + std::size_t{branch.index} * kFan * kFan,
                                                kFan * kFan);
  }
  /// The numbers of the meshes over a leaf's square.
  std::span<const std::uint32_t> meshesOf(Entry leaf) const noexcept {
    const Leaf& one = leaves_[leaf.index];
    return {lists_.data() + one.first, one.count};
  }
  /// The leaf that a place lies in; nothing outside the root.
  Entry leafAt(std::int64_t column, std::int64_t row) const noexcept {
    if (((column | row) >> rootShift_) != 0) return {Kind::nothing, 0};  // negative, or beyond
    Entry entry = root_;
    for (int shift = rootShift_; entry.kind == Kind::branch;) {
      shift -= kFanShift;
      const auto x = static_cast<std::size_t>(column >> shift) & (kFan - 1);
      const auto y = static_cast<std::size_t>(row >> shift) & (kFan - 1);
      entry = branches_[entry.index].entries[y * kFan + x];
    }
    return entry;
  }

  std::span<const IndexedMesh> meshes() const noexcept { return meshes_; }
  const HeightSpan& blockHeights(const IndexedMesh& mesh, int column, int row) const noexcept {
    return blockHeights_[mesh.firstBlock + static_cast<std::size_t>(row * mesh.blockColumns() + column)];
  }
  /// Of a mesh that is not regular: where in its indices the triangles over a block begin.
  std::span<const std::uint32_t> bucket(const IndexedMesh& mesh, int column, int row) const noexcept {
    const std::size_t at = mesh.firstBucket + static_cast<std::size_t>(row * mesh.blockColumns() + column);
    return {bucketTriangles_.data() + bucketStarts_[at], bucketStarts_[at + 1] - bucketStarts_[at]};
  }

  std::size_t bytes() const noexcept;
  std::size_t measured() const noexcept { return measured_; }  ///< meshes that `before` lacked

 private:
  struct Square;
  void addMeshes(const Scene& scene, const SceneIndex* before);
  void placeCorner(const Scene& scene, int intervals);
  bool isRegular(const Mesh& mesh);
  void measure(const Mesh& mesh, IndexedMesh& indexed);
  void measureGrid(const Mesh& mesh, const IndexedMesh& indexed);
  void measureBag(const Mesh& mesh, IndexedMesh& indexed);
  void takeOver(const SceneIndex& before, std::size_t known, IndexedMesh& indexed);
  Entry build(const Square& square, std::span<const std::uint32_t> meshes, Extent& extent);
  Entry buildBranch(const Square& square, std::span<const std::uint32_t> meshes, Extent& extent);
  Entry buildLeaf(const Square& square, std::span<const std::uint32_t> meshes);
  Extent leafExtent(const Square& square, std::span<const std::uint32_t> meshes) const;

  std::int64_t cornerColumn_ = 0, cornerRow_ = 0;
  int rootShift_ = 0, leastShift_ = 0;
  Entry root_{Kind::nothing, 0};
  Extent rootExtent_;
  std::vector<Branch> branches_;
  std::vector<Extent> extents_;  // of every branch's entries
  std::vector<Leaf> leaves_;
  std::vector<std::uint32_t> lists_;  // of mesh numbers, leaf by leaf
  std::vector<IndexedMesh> meshes_;   // by id
  std::vector<std::uint64_t> ids_;    // of the meshes
  std::vector<double> areas_;         // of all triangles of each mesh, in level-0 squares
  std::vector<HeightSpan> blockHeights_;
  std::vector<std::uint32_t> bucketStarts_, bucketTriangles_;
  std::size_t measured_ = 0;
  std::vector<std::shared_ptr<const TriangleIndices>> grids_;  // index lists that are regular
};

}  // namespace teren
