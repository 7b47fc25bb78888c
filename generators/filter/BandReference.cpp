#include "generators/filter/BandReference.h"

namespace teren {
namespace {

/// One sweep over `count` samples, `stride` apart.
void sweep(float* first, int count, std::ptrdiff_t stride, float remainder) {
  for (int n = 1; n < count; ++n) {
    float& height = first[n * stride];
    const float previous = first[(n - 1) * stride];
    height = height + remainder * (previous - height);
  }
}

}  // namespace

void bandReference(const BandFilter& filter, HeightView inOut) {
  if (inOut.empty()) return;
  const int columns = inOut.columns();
  const int rows = inOut.rows();
  const std::ptrdiff_t stride = inOut.stride();
  for (int pass = 0; pass < filter.passes(); ++pass) {
    for (int row = 0; row < rows; ++row) {
      sweep(inOut.row(row), columns, 1, filter.remainder());
      sweep(inOut.row(row) + columns - 1, columns, -1, filter.remainder());
    }
    for (int column = 0; column < columns; ++column) {
      sweep(inOut.row(0) + column, rows, stride, filter.remainder());
      sweep(inOut.row(rows - 1) + column, rows, -stride, filter.remainder());
    }
  }
}

}  // namespace teren
