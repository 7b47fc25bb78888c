// Whether two rectangles of heights share a sample: what operations on maps must know before they write.
#pragma once

#include <cstddef>
#include <functional>

#include "teren/HeightMap.h"

namespace teren {

/// Exact for views of one map (equal strides); views of different strides count as overlapping when their
/// memory, from first to last sample, does. O(1).
inline bool overlapping(ConstHeightView a, ConstHeightView b) noexcept {
  if (a.empty() || b.empty()) return false;
  const std::less<const float*> before;
  const float* const aEnd = a.row(a.rows() - 1) + a.columns();
  const float* const bEnd = b.row(b.rows() - 1) + b.columns();
  if (!before(a.data(), bEnd) || !before(b.data(), aEnd)) return false;
  if (a.stride() != b.stride()) return true;
  // b's first sample lies (x, y) from a's, or, the same address, (x - stride, y + 1).
  const std::ptrdiff_t distance = b.data() - a.data(), stride = a.stride();
  const std::ptrdiff_t y = distance >= 0 ? distance / stride : -((stride - 1 - distance) / stride);
  const std::ptrdiff_t x = distance - y * stride;
  const auto meet = [&](std::ptrdiff_t dx, std::ptrdiff_t dy) {
    return dx < a.columns() && -dx < b.columns() && dy < a.rows() && -dy < b.rows();
  };
  return meet(x, y) || meet(x - stride, y + 1);
}

}  // namespace teren
