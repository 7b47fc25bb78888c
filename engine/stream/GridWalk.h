// The squares of a grid that a straight way comes near, in the order in which it comes to them.
#pragma once

#include <algorithm>
#include <cmath>

namespace teren {

/// A part of a way, as times.
struct Span {
  double begin = 0.0, end = 1.0;
  bool empty() const noexcept { return begin > end; }
};

/// A way over the plane: at time t it is at (x + t dx, y + t dy).
struct PlanLine {
  double x = 0.0, y = 0.0, dx = 0.0, dy = 0.0;
};

/// When a coordinate, `at` at time 0 and growing by `run`, is between `low` and `high`, within a span.
inline Span spanWithin(double at, double run, double low, double high, const Span& within) noexcept {
  if (run == 0.0) return low <= at && at <= high ? within : Span{1.0, 0.0};
  const double a = (low - at) / run, b = (high - at) / run;
  return {std::max(within.begin, std::min(a, b)), std::min(within.end, std::max(a, b))};
}

/// Columns and rows of squares from a south-west corner.
struct WalkedGrid {
  double west = 0.0, south = 0.0, side = 1.0;
  int columns = 0, rows = 0;
};

/// Calls visit(column, row, span) for each square of the grid from which the way is no farther than `reach`
/// (in x and in y) at a time of `span`, with the times at which it is; stops where that returns false.
/// Squares come in the order of their times, but for those that differ by as little as the reach makes.
template <class Visit>
void walkGrid(const PlanLine& line, const WalkedGrid& grid, double reach, const Span& span,
              const Visit& visit) {
  struct Cells {
    int first, last;
  };
  const auto over = [&](double at, double run, const Span& when, double low, int count) -> Cells {
    const double a = at + when.begin * run - low, b = run == 0.0 ? a : at + when.end * run - low;
    const double first = std::floor((std::min(a, b) - reach) / grid.side);
    const double last = std::floor((std::max(a, b) + reach) / grid.side);
    return {static_cast<int>(std::clamp(first, 0.0, static_cast<double>(count))),
            static_cast<int>(std::clamp(last, -1.0, count - 1.0))};
  };
  const auto inCell = [&](double at, double run, double low, int cell, const Span& when) {
    return spanWithin(at, run, low + cell * grid.side - reach, low + (cell + 1) * grid.side + reach, when);
  };
  const Cells rows = over(line.y, line.dy, span, grid.south, grid.rows);
  const int up = line.dy < 0.0 ? -1 : 1, east = line.dx < 0.0 ? -1 : 1;
  for (int j = 0; j <= rows.last - rows.first; ++j) {
    const int row = up > 0 ? rows.first + j : rows.last - j;
    const Span inRow = inCell(line.y, line.dy, grid.south, row, span);
    if (inRow.empty()) continue;
    const Cells columns = over(line.x, line.dx, inRow, grid.west, grid.columns);
    for (int i = 0; i <= columns.last - columns.first; ++i) {
      const int column = east > 0 ? columns.first + i : columns.last - i;
      const Span inSquare = inCell(line.x, line.dx, grid.west, column, inRow);
      if (!inSquare.empty() && !visit(column, row, inSquare)) return;
    }
  }
}

}  // namespace teren
