#include "height/Surface.h"

#include <algorithm>
#include <cassert>

namespace teren {

double drawnHeightAt(ConstHeightView heights, double x, double y) noexcept {
  assert(heights.columns() >= 2 && heights.rows() >= 2);
  assert(x >= 0.0 && x <= heights.columns() - 1 && y >= 0.0 && y <= heights.rows() - 1);
  const int column = std::min(static_cast<int>(x), heights.columns() - 2);
  const int row = std::min(static_cast<int>(y), heights.rows() - 2);
  const SquareHeights corner{heights(column, row), heights(column + 1, row), heights(column, row + 1),
                             heights(column + 1, row + 1)};
  return sampleTriangle(corner, x - column, y - row).height;
}

std::array<double, 3> faceNormal(const TrianglePoint& point, double side) noexcept {
  const double scale =
      1.0 / std::sqrt(point.slopeX * point.slopeX + point.slopeY * point.slopeY + side * side);
  return {-point.slopeX * scale, -point.slopeY * scale, side * scale};
}

}  // namespace teren
