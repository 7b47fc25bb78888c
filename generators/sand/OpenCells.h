// Which squares of a grid of level 0 are sand by now; all others are ground that must not move.
#pragma once

#include <cstddef>
#include <cstdint>

#include "generators/sand/MarkSet.h"
#include "generators/tin/LatticePoint.h"

namespace teren {

/// Squares of 2^shift lattice steps, each open or closed. A point is fixed unless all that lies around it is
/// open: so what is fixed are closed squares with their borders. Made without squares, nothing is fixed.
/// O(1), 1 bit a square near those that are open.
class OpenCells {
 public:
  OpenCells() = default;
  /// All closed; fewer than 2^32 of them.
  OpenCells(int columns, int rows, int shift) noexcept : columns_(columns), rows_(rows), shift_(shift) {}

  /// False where nothing is fixed.
  bool hasFence() const noexcept { return columns_ > 0; }
  int shift() const noexcept { return shift_; }

  bool isOpen(int column, int row) const noexcept {
    return 0 <= column && column < columns_ && 0 <= row && row < rows_ && open_.contains(id(column, row));
  }
  void open(int column, int row) { open_.insert(id(column, row)); }

  bool isFixed(LatticePoint p) const noexcept {
    if (!hasFence()) return false;
    const int column = p.x >> shift_, row = p.y >> shift_;
    const std::int32_t within = (std::int32_t{1} << shift_) - 1;
    const bool west = (p.x & within) == 0, south = (p.y & within) == 0;
    return !isOpen(column, row) || (west && !isOpen(column - 1, row)) ||
           (south && !isOpen(column, row - 1)) || (west && south && !isOpen(column - 1, row - 1));
  }

  std::size_t bytes() const noexcept { return open_.bytes(); }

 private:
  std::uint32_t id(int column, int row) const noexcept {
    return static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(columns_) +
           static_cast<std::uint32_t>(column);
  }

  int columns_ = 0, rows_ = 0, shift_ = 0;
  MarkSet open_;
};

}  // namespace teren
