#include "teren/HeightMapOperations.h"

#include <algorithm>
#include <cmath>

namespace teren {

void copyHeights(ConstHeightView source, HeightView target) noexcept {
  assert(source.columns() == target.columns() && source.rows() == target.rows());
  for (int y = 0; y < source.rows(); ++y) std::copy_n(source.row(y), source.columns(), target.row(y));
}

HeightStatistics statistics(ConstHeightView heights) noexcept {
  if (heights.empty()) return {};
  const double count = static_cast<double>(heights.columns()) * heights.rows();
  HeightStatistics result{heights(0, 0), heights(0, 0), 0.0, 0.0};
  double sum = 0.0;
  for (int y = 0; y < heights.rows(); ++y) {
    double rowSum = 0.0;
    for (int x = 0; x < heights.columns(); ++x) {
      const double height = heights(x, y);
      result.min = std::min(result.min, height);
      result.max = std::max(result.max, height);
      rowSum += height;
    }
    sum += rowSum;
  }
  result.mean = sum / count;
  double squares = 0.0;
  for (int y = 0; y < heights.rows(); ++y) {
    double rowSquares = 0.0;
    for (int x = 0; x < heights.columns(); ++x) {
      const double deviation = heights(x, y) - result.mean;
      rowSquares += deviation * deviation;
    }
    squares += rowSquares;
  }
  result.deviation = std::sqrt(squares / count);
  return result;
}

}  // namespace teren
