// Where a sample lies on the lattice of an octave, in integers: nothing is lost however far from the origin.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "teren/Hash.h"

#include "generators/noise/NoiseConstants.h"
#include "generators/noise/NoisePlan.h"

namespace teren {

/// 128 bits, modulo 2^128.
__extension__ typedef unsigned __int128 WideWord;

/// Frequencies beyond this many cells a pitch are taken for it: noise so fine is new at every sample anyway.
inline constexpr double kMostCells = 0x1p24;

/// [2^-32 pitches] a position along an axis; finer parts of `u` are cut off. i: any; u: 0 ... 1.
inline WideWord noisePosition(std::int64_t i, double u) noexcept {
  __extension__ using Signed = __int128;
  return (static_cast<WideWord>(static_cast<Signed>(i)) << 32) + static_cast<std::uint64_t>(u * 0x1p32);
}

/// [2^-32 pitches] between samples; spacing: the pitch times a power of two, 2^-32 ... 2^31.
inline std::uint64_t noiseStep(double spacing, double pitch) noexcept {
  const double step = spacing / pitch * 0x1p32;
  assert(1.0 <= step && step < 0x1p64);
  return static_cast<std::uint64_t>(step);
}

/// One octave's lattice in a layer. A position (x, y) [2^-32 pitches] has the coordinates
///   (x straight + y across + phaseX, x across + y straight + phaseY) [2^-64 cells],
/// with the skew of the simplex lattice in `across`. The phases are random, so that no place of the plane is
/// special: over all seeds heights have the same distribution everywhere, though noise vanishes at corners.
struct NoiseLattice {
  std::uint64_t straight = 0, across = 0;  ///< [2^-32 cells/pitch]
  WideWord phaseX = 0, phaseY = 0;         ///< [2^-64 cells]
  std::uint64_t seedX = 0, seedY = 0;      ///< of the hashes along the axes

  NoiseLattice() = default;
  /// `number`: of the octave. cells: per pitch.
  NoiseLattice(NoiseKind kind, double cells, std::uint64_t seed, int number) noexcept {
    const auto fixed = [](double value) {
      return static_cast<std::uint64_t>(std::max(1.0, value * 0x1p32 + 0.5));
    };
    const double most = std::min(cells, kMostCells);
    straight = fixed(kind == NoiseKind::simplex ? most * (1.0 + kSkew) : most);
    across = kind == NoiseKind::simplex ? fixed(most * kSkew) : 0;
    RandomSequence words(hashWith(seed, static_cast<std::uint64_t>(number)));
    const auto wide = [&words] {
      const WideWord high = words.next();
      return (high << 64) + words.next();
    };
    phaseX = wide();
    phaseY = wide();
    seedX = words.next();
    seedY = words.next();
  }
};

/// Beyond this many cells warp is cut off: there an octave is new at every sample.
inline constexpr double kMostWarpCells = 0x1p28;

/// How many cells a metre of warp moves an octave: its frequency, in the bounds above.
inline double warpedCells(const NoiseSettings& settings, double frequency, double pitch) noexcept {
  const double metres = settings.warp / std::sqrt(noiseConstants(settings.kind).variance);
  const double cells = std::min(frequency, kMostCells / pitch);
  return metres * cells <= kMostWarpCells ? cells : kMostWarpCells / metres;
}

inline std::uint64_t cellOf(WideWord coordinate) noexcept {
  return static_cast<std::uint64_t>(coordinate >> 64);
}
/// [2^-32 cells], cut off.
inline std::uint32_t partOf(WideWord coordinate) noexcept {
  return static_cast<std::uint32_t>(coordinate >> 32);
}

/// The keys for cells from `least` on (NoiseRow.h).
inline AxisKeys axisKeysFrom(std::uint64_t least, std::uint64_t seed) noexcept {
  const std::uint64_t upper = least >> 32;
  const auto key = [seed](std::uint64_t word) {
    return static_cast<std::uint32_t>(hashWith(seed, word) >> 32);
  };
  return {.base = static_cast<std::uint32_t>(least),
          .first = key(upper),
          .beyond = key((upper + 1) & 0xffffffffu),
          .second = static_cast<std::uint32_t>(seed)};
}

/// The hash of a line of the lattice: its cell's 64 bits, its axis' seed. The arithmetic of NoiseKernel.h.
inline std::uint32_t axisHash(std::uint64_t cell, const AxisKeys& keys) noexcept {
  const auto lower = static_cast<std::uint32_t>(cell);
  std::uint32_t z = (lower ^ (lower < keys.base ? keys.beyond : keys.first)) * kAxisFactor1;
  z ^= z >> 15;
  z = (z + keys.second) * kAxisFactor2;
  return z ^ (z >> 16);
}

/// Which of the 16 gradients a corner has, by the hashes of its lines.
inline int cornerGradient(std::uint32_t hashX, std::uint32_t hashY) noexcept {
  std::uint32_t h = (hashX ^ hashY) * kCornerFactor1;
  h = (h ^ (h >> 15)) * kCornerFactor2;
  return static_cast<int>(h >> 28);
}

}  // namespace teren
