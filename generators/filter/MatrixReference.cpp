#include "generators/filter/MatrixReference.h"

#include <algorithm>

namespace teren {
namespace {

float filtered(const FilterMatrix& matrix, ConstHeightView map, int x, int y) {
  const int radius = matrix.radius();
  const auto used = [&](int row, int column) {
    const int fromX = x + column - radius, fromY = y + radius - row;
    return 0 <= fromX && fromX < map.columns() && 0 <= fromY && fromY < map.rows();
  };
  double sum = 0.0;
  for (int row = 0; row < matrix.side(); ++row) {
    for (int column = 0; column < matrix.side(); ++column) {
      if (used(row, column)) sum += matrix(row, column) * map(x + column - radius, y + radius - row);
    }
  }
  double weights = 0.0;
  for (int column = 0; column < matrix.side(); ++column) {
    double columnSum = 0.0;
    for (int row = 0; row < matrix.side(); ++row) {
      if (used(row, column)) columnSum += matrix(row, column);
    }
    weights += columnSum;
  }
  return static_cast<float>(sum * (1.0 / weights));
}

}  // namespace

void matrixReference(const MatrixFilter& filter, HeightView inOut) {
  HeightMap before(inOut.columns(), inOut.rows());
  for (int pass = 0; pass < filter.passes(); ++pass) {
    for (int y = 0; y < inOut.rows(); ++y) {
      std::copy_n(inOut.row(y), inOut.columns(), before.view().row(y));
    }
    for (int y = 0; y < inOut.rows(); ++y) {
      for (int x = 0; x < inOut.columns(); ++x) {
        inOut(x, y) = filtered(filter.matrix(), before.view(), x, y);
      }
    }
  }
}

}  // namespace teren
