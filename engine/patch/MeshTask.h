// Meshes of nodes, seams and corner pieces of one level: rectangles of vertices over one to four neighbouring
// nodes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>

#include "teren/HeightMap.h"
#include "teren/Scene.h"

#include "patch/NodeKey.h"
#include "patch/PieceTask.h"

namespace teren {

/// A node's heights, shared, and the coarser samples around it, if there are any (NodeTask.h). Vertices of a
/// node that `stays` draw near to nothing; the coarser samples are kept for when it does so no more.
class NodeHeights {
 public:
  NodeHeights() = default;
  NodeHeights(std::nullptr_t) {}
  NodeHeights(std::shared_ptr<const HeightMap> own, std::shared_ptr<const HeightMap> coarser = nullptr,
              bool stays = false)
      : own_(std::move(own)), coarser_(std::move(coarser)), stays_(stays) {}
  NodeHeights(std::shared_ptr<HeightMap> own) : own_(std::move(own)) {}

  const HeightMap& operator*() const noexcept { return *own_; }
  const HeightMap* operator->() const noexcept { return own_.get(); }
  const HeightMap* get() const noexcept { return own_.get(); }
  /// What vertices draw near to; null: nothing.
  const HeightMap* coarser() const noexcept { return stays_ ? nullptr : coarser_.get(); }
  const HeightMap* keptCoarser() const noexcept { return coarser_.get(); }
  explicit operator bool() const noexcept { return own_ != nullptr; }

  std::size_t bytes() const noexcept {
    return own_->bytes() + sizeof(HeightMap) + (coarser_ ? coarser_->bytes() + sizeof(HeightMap) : 0);
  }

 private:
  std::shared_ptr<const HeightMap> own_, coarser_;
  bool stays_ = false;
};

/// Up to 2 x 2 neighbouring nodes of one level, south-west, south-east, north-west, north-east; those a piece
/// does not touch may be null. `key` names the south-west one.
struct NodeBlock {
  NodeKey key;
  std::array<NodeHeights, 4> nodes;
};

/// The pieces that together cover the plane once: a node's mesh leaves out its outermost ring of squares.
/// Between nodes of one level a seam is two squares wide and joins two of them, a corner piece is 2 x 2
/// squares and joins four. Where nodes of different levels meet, what is left out is filled by each node's
/// border.
enum class Piece : std::uint8_t {
  interior,     ///< of the block's south-west node
  eastSeam,     ///< between it and its eastern neighbour
  northSeam,    ///< between it and its northern neighbour
  cornerPiece,  ///< at its north-east corner
  border        ///< of the node: its half of the seams to other levels (BorderTask)
};

/// Vertices of a piece, in samples of the block's level from the south-west corner of its south-west node.
struct PieceExtent {
  int firstColumn = 0, firstRow = 0, columns = 0, rows = 0;  ///< squares, not vertices
};
/// `intervals` >= 2 is n. Of all pieces but a border, whose extent depends on what it joins.
PieceExtent pieceExtent(Piece piece, int intervals) noexcept;
/// Bytes of the mesh of such a piece.
std::size_t pieceBytes(Piece piece, int intervals) noexcept;

/// Index lists of rectangles, made once per shape. Not thread-safe.
class GridIndices {
 public:
  std::shared_ptr<const TriangleIndices> get(int columns, int rows);
  std::size_t bytes() const noexcept { return bytes_; }

 private:
  std::size_t bytes_ = 0;
  std::map<std::pair<int, int>, std::shared_ptr<const TriangleIndices>> lists_;
};

/// Builds a piece between nodes of one level, in slices of rows. Positions are copied from the nodes and
/// normals are central differences over them, so neighbouring pieces - and one big monolithic map - have
/// equal bits at shared vertices.
class MeshTask final : public PieceTask {
 public:
  /// `spacing` [m] of the block's level. A piece of no squares gives an empty mesh. `indices` is used by the
  /// constructor alone, so that steps may run on any thread.
  MeshTask(NodeBlock block, Piece piece, double spacing, GridIndices& indices);
  bool step(const Slice& slice) override;

 private:
  /// Of a line that two nodes share, the south or west one's copy is read: both have the same bits.
  const NodeHeights& nodeAt(int& column, int& row) const;
  float heightAt(int column, int row) const;
  void buildRow(int row);

  NodeBlock block_;
  int intervals_;
  PieceExtent extent_;
  double spacing_;
  int nextRow_ = 0;
};

}  // namespace teren
