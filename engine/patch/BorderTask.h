// Seams and corner pieces between nodes of different levels: a node's border, its own half of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "teren/HeightMap.h"

#include "height/Surface.h"
#include "patch/MeshTask.h"
#include "patch/NodeKey.h"
#include "patch/PieceTask.h"

namespace teren {

/// A node and its heights.
struct HeldNode {
  NodeKey key;
  NodeHeights heights;
};

/// How far apart the levels of nodes that touch may be: a mesh counts its columns in 16 bits.
int mostLevelDifference(int intervals) noexcept;

/// What of a node's outermost ring of squares its border has to fill, from the nodes around it: everything
/// that seams and corner pieces between nodes of its own level leave open, but where nothing is drawn on the
/// other side. Sides: south, north, west, east. Corners: south-west, south-east, north-west, north-east.
class BorderPlan {
 public:
  /// `around`: all nodes drawn whose squares touch that of `node`, which is not among them; no two overlap.
  BorderPlan(const NodeKey& node, const std::vector<NodeKey>& around, int intervals);

  bool side(std::size_t side) const noexcept { return sides_[side]; }
  bool corner(std::size_t corner) const noexcept { return corners_[corner]; }
  bool empty() const noexcept;
  /// [bytes] at most, its index list included.
  std::size_t bytes() const noexcept { return bytes_; }

 private:
  std::array<bool, 4> sides_{}, corners_{};
  std::size_t bytes_ = 0;
};

/// Builds a node's border in slices of squares. Every triangle lies in the node's own square. The points on
/// the line between two nodes have the finer one's spacing; what a vertex there says depends on its place and
/// the nodes that meet in it alone, so all borders, seams and corner pieces that share it have equal bits:
/// the height is stored in the finest node, and the normal is a central difference over the coarsest one's
/// spacing, in each direction over the coarsest node there; what it draws near to is the finest node's next
/// coarser surface. A square of the ring is a fan: along a side from
/// its two inner corners, at a corner of the node from its one; where the line has no more points than the
/// node itself, it is split as squares are everywhere. Any levels may meet, and any number of nodes along a
/// side.
class BorderTask final : public PieceTask {
 public:
  /// `node` first, then all that touch it, as in BorderPlan; levels at most mostLevelDifference() apart.
  /// `spacing` [m] of level 0.
  BorderTask(std::vector<HeldNode> nodes, double spacing);
  bool step(const Slice& slice) override;

 private:
  /// In steps of the finest node, from the south-west corner of the border's own.
  struct Place {
    std::int64_t x = 0, y = 0;
  };
  struct Square {
    std::int64_t x = 0, y = 0, side = 0, step = 0;
    const HeightMap* heights = nullptr;
    const HeightMap* coarser = nullptr;  // or null
    int level = 0;
  };
  static bool contains(const Square& square, const Place& place) noexcept;
  static bool goesBefore(const Square& a, const Square& b) noexcept;

  Place onSide(std::size_t side, std::int64_t along, std::int64_t inwards) const noexcept;
  void linePoints(std::size_t side, std::int64_t from, std::int64_t to);
  void buildSideSquare(std::size_t side, std::int64_t square);
  void buildCorner(std::size_t corner);
  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool mirrored);

  std::uint32_t vertexAt(const Place& place);
  PackedNormal normalAt(const Place& place) const;
  /// Height [m] one coarse step, or less where its node ends, from a place, and how far that is.
  std::pair<double, std::int64_t> heightTowards(const Place& place, int east, int north,
                                                std::int64_t distance) const;

  std::vector<HeldNode> nodes_;
  double spacing_;  // [m] of the mesh
  int intervals_;
  BorderPlan plan_;
  std::vector<Square> squares_;         // of nodes_
  std::vector<Square> meeting_;         // in the vertex that is being made
  std::vector<std::int64_t> line_;      // points of the line along the square that is being made
  std::vector<std::uint32_t> numbers_;  // of the vertices at them
  std::unordered_map<std::int64_t, std::uint32_t> vertices_;  // numbers by place
  std::shared_ptr<TriangleIndices> indices_;
  std::size_t part_ = 0;     // sides, then corners
  std::int64_t square_ = 1;  // of the side
};

}  // namespace teren
