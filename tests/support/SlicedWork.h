// What tests of generators and filters do again and again: finish a task in slices of some kind, and compare
// maps bit for bit.
#pragma once

#include <span>

#include "teren/HeightMap.h"
#include "teren/Slice.h"

#include "apps/check/MapComparison.h"

namespace teren::test {

using check::sameBits;
using check::shortestSlice;
using check::squaredError;
using check::subsampled;

/// Steps until the task is done; returns the number of steps.
inline int finish(SlicedTask& task, const Slice& slice = Slice::unlimited()) {
  int steps = 1;
  while (!task.step(slice)) ++steps;
  return steps;
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
