#include "generators/sand/Opening.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "teren/Deformer.h"

namespace teren {
namespace {

/// The whole number just below or above, within a range; NaN is its start.
int within(double value, int least, int most) noexcept {
  return static_cast<int>(std::min<double>(most, std::max<double>(least, std::floor(value))));
}

}  // namespace

std::array<Opening::Side, 4> Opening::sidesOf(const Cell& cell) noexcept {
  const auto [column, row] = cell;
  const VertexId southWest = vertex(column, row), southEast = vertex(column + 1, row);
  const VertexId northWest = vertex(column, row + 1), northEast = vertex(column + 1, row + 1);
  return {{{southWest, southEast, {column, row - 1}},
           {southEast, northEast, {column + 1, row}},
           {northEast, northWest, {column, row + 1}},
           {northWest, southWest, {column - 1, row}}}};
}

/// Ids for the rectangle around them.
void Opening::makeRoom(std::span<const Cell> cells) {
  cells_.assign(cells.begin(), cells.end());
  const auto [west, east] = std::ranges::minmax(cells_, {}, &Cell::column);
  const auto [south, north] = std::ranges::minmax(cells_, {}, &Cell::row);
  column_ = west.column;
  row_ = south.row;
  columns_ = east.column - west.column + 2;
  const std::size_t rows = static_cast<std::size_t>(north.row - south.row + 2);
  vertices_.assign(static_cast<std::size_t>(columns_) * rows, kNoVertex);
}

void Opening::enterVertices(SandSurface& surface, ConstHeightView ground) {
  VertexId near = 0;
  for (const Cell& cell : cells_) {
    for (int corner = 0; corner < 4; ++corner) {
      const int column = cell.column + corner % 2, row = cell.row + corner / 2;
      VertexId& v = vertex(column, row);
      if (v != kNoVertex) continue;
      v = near = surface.enter(surface.cells().point(column, row), ticksFromMetres(ground(column, row)),
                               surface.mesh().triangleAt(near));
    }
  }
}

/// A side that two squares of the grid share is always an edge: nothing lies in the circle over it. A
/// diagonal that has been forced stays, for the corners of its square lie on one circle.
void Opening::enterEdges(SandSurface& surface) {
  for (const Cell& cell : cells_) {
    for (const Side& side : sidesOf(cell)) {
      if (surface.cells().isOpen(side.beyond.column, side.beyond.row)) continue;
      surface.enterEdge(side.from, side.to, kFenceId);
    }
  }
  for (const auto& [column, row] : cells_) {
    const VertexId southWest = vertex(column, row), northEast = vertex(column + 1, row + 1);
    if (surface.mesh().isEdge(southWest, northEast)) continue;
    surface.enterEdge(southWest, northEast, kFenceId);
    surface.unconstrain(southWest, northEast);
  }
}

/// The corners of all triangles begin in the south-west of their square.
void Opening::forgetPast(SandSurface& surface) {
  const Triangulation& mesh = surface.mesh();
  for (const auto& [column, row] : cells_) {
    const VertexId southWest = vertex(column, row), northEast = vertex(column + 1, row + 1);
    std::array<TriangleId, 2> halves{kNoTriangle, kNoTriangle};  // right and left of the diagonal
    mesh.forEachCorner(southWest, [&](Link at) {
      const std::array<VertexId, 3>& corners = mesh.corners(at.triangle());
      if (corners[preceding(at.side())] == northEast) halves[0] = at.triangle();
      if (corners[following(at.side())] == northEast) halves[1] = at.triangle();
    });
    for (const TriangleId t : halves) surface.turn(t, southWest);
  }
}

/// What was the fence's until now bears nothing yet, either.
void Opening::loosen(SandSurface& surface, ConstHeightView loose) const {
  if (loose.empty()) return;
  for (const VertexId v : inside_) {
    const LatticePoint p = surface.mesh().point(v);
    const float depth = loose(surface.cells().columnOf(p.x), surface.cells().rowOf(p.y));
    surface.loosen(v, ticksFromMetres(depth));
  }
}

void Opening::enter(SandSurface& surface, ConstHeightView ground, ConstHeightView loose,
                    std::span<const Cell> cells) {
  assert(surface.cells().hasFence());
  inside_.clear();
  cells_.clear();
  if (cells.empty()) return;
  makeRoom(cells);
  enterVertices(surface, ground);
  for (const auto& [column, row] : cells_) surface.open(column, row);
  enterEdges(surface);
  forgetPast(surface);
  for (const VertexId v : vertices_) {
    if (v != kNoVertex && !surface.isFixed(v)) inside_.push_back(v);
  }
  loosen(surface, loose);
}

void Opening::join(SandSurface& surface) {
  for (const Cell& cell : cells_) {
    for (const Side& side : sidesOf(cell)) {
      if (!surface.cells().isOpen(side.beyond.column, side.beyond.row)) continue;
      if (surface.mesh().constraint(side.from, side.to)) surface.unconstrain(side.from, side.to);
    }
  }
}

void forEachCellWithin(const SandSurface& surface, double x, double y, double distance,
                       const std::function<void(Opening::Cell)>& visit) {
  const OpenCells& cells = surface.cells();
  const double spacing = surface.step() * static_cast<double>(std::int64_t{1} << cells.shift());
  const int columns = cells.columns() - kCollarCells, rows = cells.rows() - kCollarCells;
  const int west = within((x - distance) / spacing, kCollarCells, columns);
  const int east = within((x + distance) / spacing + 1.0, west, columns);
  const int south = within((y - distance) / spacing, kCollarCells, rows);
  const int north = within((y + distance) / spacing + 1.0, south, rows);
  const double most = distance * distance * (1.0 - 1e-12);
  const auto farthest = [spacing](double from, int cell) {
    return std::max(std::fabs(cell * spacing - from), std::fabs((cell + 1) * spacing - from));
  };
  for (int row = south; row < north; ++row) {
    const double up = farthest(y, row);
    for (int column = west; column < east; ++column) {
      const double along = farthest(x, column);
      if (along * along + up * up <= most) visit({column, row});
    }
  }
}

}  // namespace teren
