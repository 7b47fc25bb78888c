// Maps for the tests of filters: noise without any order, and what a generator would make.
#pragma once

#include <cstdint>

#include "teren/Hash.h"
#include "teren/HeightMap.h"

#include "generators/fault/FaultFormation.h"
#include "tests/support/SlicedWork.h"

namespace teren::test {

/// Heights uniform in [-1000, 1000) m.
inline HeightMap rubble(int columns, int rows, std::uint64_t seed) {
  HeightMap map(columns, rows);
  RandomSequence random(seed);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      map(column, row) = static_cast<float>(random.nextBits(24) - (1 << 23)) * (1000.0f / (1 << 23));
    }
  }
  return map;
}

/// 150 faults of this deviation [m].
inline HeightMap faults(std::uint64_t seed, int samples, double deviation = 1.0) {
  HeightMap map(samples, samples);
  finish(*FaultFormation(150, deviation).begin({.seed = seed, .samples = samples}, map.view()));
  return map;
}

}  // namespace teren::test
