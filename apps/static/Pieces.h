// The pieces of a landscape that is drawn as nine patches: what they are, and how they move apart.
#pragma once

#include <memory>
#include <vector>

#include "teren/Scene.h"

namespace teren {

enum class PieceKind {
  patch,   ///< the inside of a node
  seam,    ///< two squares wide, joins two nodes
  corner,  ///< 2 x 2 squares, joins four nodes
};

/// A mesh and its place among the others: patches lie in even columns and rows, counted from the western- and
/// southernmost, the seams and corner pieces between them in odd ones.
struct Piece {
  std::shared_ptr<const Mesh> mesh;
  int column = 0, row = 0;

  PieceKind kind() const noexcept {
    const int between = column % 2 + row % 2;
    return between == 0 ? PieceKind::patch : between == 1 ? PieceKind::seam : PieceKind::corner;
  }
};

/// The pieces of a scene of one uniform level; empty for an empty scene. `intervals` is World::intervals(),
/// at least 4: with 2, a patch is all seams.
std::vector<Piece> piecesOf(const Scene& scene, int intervals);

/// How far [m] a piece is moved to the east, to the north and up.
struct Shift {
  double east = 0.0, north = 0.0, up = 0.0;
};

/// Where a piece lies when those of `columns` x `rows` (both odd) are `amount` apart: at 0 together, as the
/// landscape is; at 1 as far as they go, a quarter of a patch from their neighbours, seams above the patches
/// and corner pieces above the seams. `side` [m] is a patch's.
Shift shiftOf(const Piece& piece, int columns, int rows, double side, double amount);

}  // namespace teren
