// Which squares of a grid of level 0 are open: sand by now, or, in another set of them, ground that may
// become sand. All others are ground that must not move.
#pragma once

#include <cstddef>
#include <cstdint>

#include "generators/sand/MarkSet.h"
#include "generators/tin/LatticePoint.h"

namespace teren {

/// A rectangle of squares of 2^shift lattice steps, each open or closed; all others are closed. A point is
/// fixed unless all that lies around it is open: so what is fixed are closed squares with their borders. Made
/// without squares, nothing is fixed. O(1), 1 bit a square near those that are open.
class OpenCells {
 public:
  OpenCells() = default;
  /// All closed; fewer than 2^32 of them. The coordinates of `corner`, the south-west one, are whole squares.
  OpenCells(LatticePoint corner, int columns, int rows, int shift) noexcept
      : corner_(corner), columns_(columns), rows_(rows), shift_(shift) {}

  /// False where nothing is fixed.
  bool hasFence() const noexcept { return columns_ > 0; }
  int shift() const noexcept { return shift_; }
  LatticePoint corner() const noexcept { return corner_; }
  int columns() const noexcept { return columns_; }
  int rows() const noexcept { return rows_; }
  std::int32_t width() const noexcept { return columns_ << shift_; }  ///< [steps]
  std::int32_t height() const noexcept { return rows_ << shift_; }    ///< [steps]
  /// The south-west corner of a square.
  LatticePoint point(int column, int row) const noexcept {
    return {corner_.x + (column << shift_), corner_.y + (row << shift_)};
  }
  /// The square in which a place lies, or the one to the north-east of a corner; any place.
  int columnOf(std::int32_t x) const noexcept { return (x - corner_.x) >> shift_; }
  int rowOf(std::int32_t y) const noexcept { return (y - corner_.y) >> shift_; }

  bool isOpen(int column, int row) const noexcept {
    return 0 <= column && column < columns_ && 0 <= row && row < rows_ && open_.contains(id(column, row));
  }
  void open(int column, int row) { open_.insert(id(column, row)); }
  /// The same with so many squares more in the west and in the south, closed, and others in the east and the
  /// north, so that there are `columns` x `rows`. O(squares).
  OpenCells grown(int west, int south, int columns, int rows) const {
    OpenCells larger({corner_.x - (west << shift_), corner_.y - (south << shift_)}, columns, rows, shift_);
    larger.take(*this, west, south);
    return larger;
  }
  /// Opens what is open in others that lie from (column, row) on. O(squares of theirs).
  void take(const OpenCells& other, int column, int row) {
    for (int y = 0; y < other.rows_; ++y) {
      for (int x = 0; x < other.columns_; ++x) {
        if (other.isOpen(x, y)) open(column + x, row + y);
      }
    }
  }

  bool isFixed(LatticePoint p) const noexcept {
    if (!hasFence()) return false;
    const int column = columnOf(p.x), row = rowOf(p.y);
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

  LatticePoint corner_;
  int columns_ = 0, rows_ = 0, shift_ = 0;
  MarkSet open_;
};

}  // namespace teren
