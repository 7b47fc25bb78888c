#include "apps/report/MapRoughness.h"

#include <cassert>
#include <cmath>

namespace teren {

double slopeOfTriangles(ConstHeightView heights, double spacing) {
  assert(heights.columns() >= 2 && heights.rows() >= 2);
  double sum = 0.0;
  for (int y = 0; y + 1 < heights.rows(); ++y) {
    for (int x = 0; x + 1 < heights.columns(); ++x) {
      const double southWest = heights(x, y), southEast = heights(x + 1, y);
      const double northWest = heights(x, y + 1), northEast = heights(x + 1, y + 1);
      const double a = southEast - southWest, b = northEast - southEast;
      const double c = northEast - northWest, d = northWest - southWest;
      sum += 0.5 * (a * a + b * b + c * c + d * d);
    }
  }
  const double squares = static_cast<double>(heights.columns() - 1) * (heights.rows() - 1);
  return std::sqrt(sum / squares) / spacing;
}

}  // namespace teren
