// The random numbers of midpoint displacement: each point of each stage has its own, a pure function of the
// map's seed, the stage and the place, so a coarse map needs no more of them than it has points.
#pragma once

#include <cstdint>

#include "teren/Hash.h"

#include "generators/midpoint/MidpointPlan.h"
#include "generators/numbers/Gaussian.h"
#include "generators/numbers/RandomNumber.h"

namespace teren {

/// Key of a row of the lattice after a stage (2 * 2^stage intervals a side), rows counted from the south.
/// The corners' numbers are row 0 of stage -1.
constexpr std::uint64_t midpointRowKey(std::uint64_t mapSeed, int stage, int row) noexcept {
  return hashWith(hashWith(mapSeed, static_cast<std::uint64_t>(stage)), static_cast<std::uint64_t>(row));
}

/// The random word of the point in that column of the row.
constexpr std::uint64_t midpointWord(std::uint64_t rowKey, int column) noexcept {
  return mixBits(rowKey + 0x9e3779b97f4a7c15ULL * static_cast<std::uint64_t>(column));
}

/// The number a source makes of a word.
inline double midpointNumber(MidpointSource source, const Gaussian& gaussian, std::uint64_t word) noexcept {
  switch (source) {
    case MidpointSource::randR:
      return uniformAroundZero(word);
    case MidpointSource::randN:
      return uniform(word) - 0.5;
    case MidpointSource::randG:
      break;
  }
  return gaussian(word);
}

}  // namespace teren
