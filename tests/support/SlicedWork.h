// What tests of generators and filters do again and again: finish a task in slices of some kind, and compare
// maps bit for bit.
#pragma once

#include <algorithm>
#include <cstring>
#include <span>

#include "teren/HeightMap.h"
#include "teren/Slice.h"

namespace teren::test {

/// A slice that is over from the start: a step does one unit of work.
inline Slice shortestSlice() {
  return Slice::until(Slice::Clock::time_point::min());
}

/// Steps until the task is done; returns the number of steps.
inline int finish(SlicedTask& task, const Slice& slice = Slice::unlimited()) {
  int steps = 1;
  while (!task.step(slice)) ++steps;
  return steps;
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

/// Mean of the squared differences between a finest map and the triangles through a map of level `level`,
/// quads split from south-west to north-east. Rims count like the rest.
inline double squaredError(const HeightMap& finest, const HeightMap& coarse, int level) {
  double sum = 0.0;
  const int stride = 1 << level;
  for (int row = 0; row < finest.rows(); ++row) {
    for (int column = 0; column < finest.columns(); ++column) {
      const int x = std::min(column >> level, coarse.columns() - 2);
      const int y = std::min(row >> level, coarse.rows() - 2);
      const double u = static_cast<double>(column - x * stride) / stride;
      const double v = static_cast<double>(row - y * stride) / stride;
      const double southWest = coarse(x, y), northEast = coarse(x + 1, y + 1);
      const double corner = u >= v ? coarse(x + 1, y) : coarse(x, y + 1);
      const double drawn =
          southWest + std::max(u, v) * (corner - southWest) + std::min(u, v) * (northEast - corner);
      const double error = finest(column, row) - drawn;
      sum += error * error;
    }
  }
  return sum / (static_cast<double>(finest.columns()) * finest.rows());
}

/// Adds to squares[level] the squaredError of every level of at least 3 samples a side, and to squares[0] the
/// mean of the squared differences from the centre, divided by the number of `maps` that will be added.
inline void addSquaredErrors(const HeightMap& finest, int maps, std::span<double> squares) {
  const int samples = finest.columns();
  for (int level = 1; (samples - 1) >> level >= 2; ++level) {
    squares[level] += squaredError(finest, subsampled(finest, level), level) / maps;
  }
  const float centre = finest(samples / 2, samples / 2);
  for (float height : finest.samples()) {
    squares[0] += static_cast<double>((height - centre) * (height - centre)) / (samples * samples * maps);
  }
}

}  // namespace teren::test
