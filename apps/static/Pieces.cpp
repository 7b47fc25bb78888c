#include "apps/static/Pieces.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

namespace teren {
namespace {

constexpr double kApart = 0.25;      // between neighbours, in sides of a patch
constexpr double kSeamsUp = 0.12;    // of a side
constexpr double kCornersUp = 0.24;  // of a side

/// Twice the node in which a mesh begins, plus one where it begins in the last square before the next node,
/// which is where seams do.
std::int64_t slot(std::int64_t origin, int level, int intervals) {
  const std::int64_t sample = origin >> level;
  const std::int64_t node = sample >= 0 ? sample / intervals : -((intervals - 1 - sample) / intervals);
  return 2 * node + (sample - node * intervals == intervals - 1 ? 1 : 0);
}

}  // namespace

std::vector<Piece> piecesOf(const Scene& scene, int intervals) {
  assert(intervals >= 4);
  std::int64_t firstColumn = INT64_MAX, firstRow = INT64_MAX;
  for (const auto& mesh : scene.meshes()) {
    firstColumn = std::min(firstColumn, slot(mesh->originColumn, mesh->level, intervals));
    firstRow = std::min(firstRow, slot(mesh->originRow, mesh->level, intervals));
  }
  std::vector<Piece> pieces;
  for (const auto& mesh : scene.meshes()) {
    pieces.push_back({mesh, static_cast<int>(slot(mesh->originColumn, mesh->level, intervals) - firstColumn),
                      static_cast<int>(slot(mesh->originRow, mesh->level, intervals) - firstRow)});
  }
  return pieces;
}

Shift shiftOf(const Piece& piece, int columns, int rows, double side, double amount) {
  const double step = amount * kApart * side;
  const double up = piece.kind() == PieceKind::patch  ? 0.0
                    : piece.kind() == PieceKind::seam ? kSeamsUp
                                                      : kCornersUp;
  return {step * (piece.column - columns / 2), step * (piece.row - rows / 2), amount * up * side};
}

}  // namespace teren
