// How maps are compared: bit for bit, a level with the finest map, and the triangles through a level's
// samples with what they leave out.
#pragma once

#include <algorithm>
#include <cstring>

#include "teren/HeightMap.h"
#include "teren/Slice.h"

namespace teren::check {

/// A slice that is over from the start: a step does one unit of work.
inline Slice shortestSlice() {
  return Slice::until(Slice::Clock::time_point::min());
}

inline bool sameBits(ConstHeightView a, ConstHeightView b) {
  if (a.columns() != b.columns() || a.rows() != b.rows()) return false;
  for (int row = 0; row < a.rows(); ++row) {
    if (std::memcmp(a.row(row), b.row(row), sizeof(float) * static_cast<std::size_t>(a.columns())) != 0) {
      return false;
    }
  }
  return true;
}

/// Every 2^level-th sample of a square map of 2^k + 1 samples; its centre where the stride exceeds half the
/// side.
inline HeightMap subsampled(const HeightMap& finest, int level) {
  const int intervals = (finest.columns() - 1) >> level;
  if (intervals < 2) {
    HeightMap centre(1, 1);
    centre(0, 0) = finest((finest.columns() - 1) / 2, (finest.rows() - 1) / 2);
    return centre;
  }
  HeightMap coarse(intervals + 1, intervals + 1);
  for (int row = 0; row <= intervals; ++row) {
    for (int column = 0; column <= intervals; ++column) {
      coarse(column, row) = finest(column << level, row << level);
    }
  }
  return coarse;
}

/// Height of the triangles through a map of level `level` at a sample of the finest map, quads split from
/// south-west to north-east.
inline double drawnHeight(const HeightMap& coarse, int column, int row, int level) {
  const int stride = 1 << level;
  const int x = std::min(column >> level, coarse.columns() - 2);
  const int y = std::min(row >> level, coarse.rows() - 2);
  const double u = static_cast<double>(column - x * stride) / stride;
  const double v = static_cast<double>(row - y * stride) / stride;
  const double southWest = coarse(x, y), northEast = coarse(x + 1, y + 1);
  const double corner = u >= v ? coarse(x + 1, y) : coarse(x, y + 1);
  return southWest + std::max(u, v) * (corner - southWest) + std::min(u, v) * (northEast - corner);
}

/// Mean of the squared differences between a finest map and the triangles through a map of level `level`.
/// Rims count like the rest.
inline double squaredError(const HeightMap& finest, const HeightMap& coarse, int level) {
  double sum = 0.0;
  for (int row = 0; row < finest.rows(); ++row) {
    for (int column = 0; column < finest.columns(); ++column) {
      const double error = finest(column, row) - drawnHeight(coarse, column, row, level);
      sum += error * error;
    }
  }
  return sum / (static_cast<double>(finest.columns()) * finest.rows());
}

}  // namespace teren::check
