// How ground becomes sand: squares of a level-0 grid enter a fenced box, exactly as they are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "teren/HeightMap.h"

#include "generators/sand/SandSurface.h"

namespace teren {

/// The squares' samples become vertices at their heights, solid but for what is told, and their diagonals run
/// from south-west to north-east as nodes draw them, so what enters is the grid's surface without an error.
/// Edges between open and closed squares are constrained with kFenceId and fixed at both ends: whatever
/// happens inside moves nothing outside, where triangles mean nothing but to fill the box. What lies outside,
/// and where the squares lie in the box, leaves no trace inside, not in the order of anything.
///
/// Heights are rounded to ticks: exact from 2^-15 m upwards, and elsewhere 2^-39 m off. O(squares that come,
/// and the rectangle around the disc).
class Opening {
 public:
  static constexpr std::uint32_t kFenceId = 0xffffffffU;

  struct Cell {
    int column = 0, row = 0;
  };
  /// Squares that are closed, each once, enter and are open from now on. `ground` has the samples of all, and
  /// `loose`, which may be empty, so much of it is not solid [m].
  void enter(SandSurface& surface, ConstHeightView ground, ConstHeightView loose,
             std::span<const Cell> cells);
  /// The vertices of what has entered, without those that are fixed.
  std::span<const VertexId> inside() const noexcept { return inside_; }
  /// Takes away what was the fence between them and those that were open before.
  void join(SandSurface& surface);

  std::size_t bytes() const noexcept {
    return sizeof(*this) + (inside_.capacity() + vertices_.capacity()) * sizeof(VertexId) +
           cells_.capacity() * sizeof(Cell);
  }

 private:
  /// A side of a cell: from where to where, counter-clockwise, and the cell beyond.
  struct Side {
    VertexId from = kNoVertex, to = kNoVertex;
    Cell beyond;
  };

  VertexId& vertex(int column, int row) noexcept {
    return vertices_[static_cast<std::size_t>(row - row_) * static_cast<std::size_t>(columns_) +
                     static_cast<std::size_t>(column - column_)];
  }
  std::array<Side, 4> sidesOf(const Cell& cell) noexcept;
  void makeRoom(std::span<const Cell> cells);
  void enterVertices(SandSurface& surface, ConstHeightView ground);
  void enterEdges(SandSurface& surface);
  void forgetPast(SandSurface& surface);
  void loosen(SandSurface& surface, ConstHeightView loose) const;

  std::vector<Cell> cells_;  // that come
  int column_ = 0, row_ = 0, columns_ = 0;
  std::vector<VertexId> vertices_;  // of the samples around, kNoVertex where no cell comes
  std::vector<VertexId> inside_;
};

/// The squares of a surface's cells that lie wholly within `distance` [m] of a place, without the collar's
/// (kCollarCells), row by row.
void forEachCellWithin(const SandSurface& surface, double x, double y, double distance,
                       const std::function<void(Opening::Cell)>& visit);

}  // namespace teren
