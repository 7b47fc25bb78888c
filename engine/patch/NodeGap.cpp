#include "patch/NodeGap.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "height/Surface.h"

namespace teren {

namespace {

/// A sample of the finer node between those of the coarser, along one axis.
struct Between {
  int before = 0;      // sample
  double share = 0.0;  // of the way to the next one
};

Between between(int part, int sample, int intervals, int down) {
  const int steps = part * intervals + sample;  // of 2^-down squares
  const int before = std::min(steps >> down, intervals - 1);
  return {before, (steps - (before << down)) / static_cast<double>(1 << down)};
}

double bend(float a, float b, float c) {
  return std::fabs(static_cast<double>(a) - 2.0 * static_cast<double>(b) + static_cast<double>(c));
}

}  // namespace

double largestGap(ConstHeightView coarse, ConstHeightView fine, const NodePart& part) noexcept {
  assert(coarse.columns() == fine.columns() && coarse.rows() == fine.rows() && fine.columns() == fine.rows());
  assert(part.down >= 0 && part.column >> part.down == 0 && part.row >> part.down == 0);
  const int intervals = fine.columns() - 1;
  double largest = 0.0;
  for (int row = 0; row <= intervals; ++row) {
    const Between y = between(part.row, row, intervals, part.down);
    const float* const south = coarse.row(y.before);
    const float* const north = coarse.row(y.before + 1);
    const float* const heights = fine.row(row);
    for (int column = 0; column <= intervals; ++column) {
      const Between x = between(part.column, column, intervals, part.down);
      const auto height = [&x](const float* line, int step) {
        return static_cast<double>(line[x.before + step]);
      };
      const SquareHeights square{height(south, 0), height(south, 1), height(north, 0), height(north, 1)};
      const double drawn = sampleTriangle(square, x.share, y.share).height;
      largest = std::max(largest, std::fabs(drawn - static_cast<double>(heights[column])));
    }
  }
  return largest;
}

double largestBend(ConstHeightView heights) noexcept {
  const int columns = heights.columns(), rows = heights.rows();
  double largest = 0.0;
  for (int row = 0; row < rows; ++row) {
    const float* const here = heights.row(row);
    for (int column = 1; column + 1 < columns; ++column) {
      largest = std::max(largest, bend(here[column - 1], here[column], here[column + 1]));
    }
    if (row == 0 || row + 1 == rows) continue;
    const float* const south = heights.row(row - 1);
    const float* const north = heights.row(row + 1);
    for (int column = 0; column < columns; ++column) {
      largest = std::max(largest, bend(south[column], here[column], north[column]));
      if (column == 0 || column + 1 == columns) continue;
      largest = std::max(largest, bend(south[column - 1], here[column], north[column + 1]));
    }
  }
  return largest;
}

}  // namespace teren
