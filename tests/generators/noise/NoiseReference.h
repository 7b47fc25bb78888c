// Noise the slow way: coordinates by long multiplication on 32-bit digits, everything else in long double,
// sample by sample from the definition. It shares with generators/noise the random numbers of a lattice and
// the table of gradients, and nothing else.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "teren/Hash.h"

#include "generators/noise/Noise.h"
#include "generators/noise/NoiseConstants.h"
#include "generators/noise/NoiseLattice.h"

namespace teren::test {

/// 128 bits as digits to the base 2^32, the lowest first, modulo 2^128.
using Digits = std::array<std::uint32_t, 4>;

inline Digits sum(const Digits& a, const Digits& b) {
  Digits result{};
  std::uint64_t carry = 0;
  for (std::size_t n = 0; n < 4; ++n) {
    carry += static_cast<std::uint64_t>(a[n]) + b[n];
    result[n] = static_cast<std::uint32_t>(carry);
    carry >>= 32;
  }
  return result;
}

inline Digits product(const Digits& a, std::uint64_t factor) {
  Digits result{};
  for (std::size_t shift = 0; shift < 2; ++shift) {
    const std::uint64_t digit = (factor >> (32 * shift)) & 0xffffffffu;
    std::uint64_t carry = 0;
    for (std::size_t n = 0; n + shift < 4; ++n) {
      carry += a[n] * digit + result[n + shift];
      result[n + shift] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
  }
  return result;
}

/// [2^-32 pitches] of a lattice point and so many 2^-32 pitches from it.
inline Digits position(std::int64_t point, std::int64_t parts) {
  const auto digits = [](std::int64_t value, bool shifted) {
    const auto bits = static_cast<std::uint64_t>(value);
    const std::uint32_t sign = value < 0 ? 0xffffffffu : 0u;
    const auto lower = static_cast<std::uint32_t>(bits), upper = static_cast<std::uint32_t>(bits >> 32);
    return shifted ? Digits{0, lower, upper, sign} : Digits{lower, upper, sign, sign};
  };
  return sum(digits(point, true), digits(parts, false));
}

inline Digits digitsOf(WideWord word) {
  return {static_cast<std::uint32_t>(word), static_cast<std::uint32_t>(word >> 32),
          static_cast<std::uint32_t>(word >> 64), static_cast<std::uint32_t>(word >> 96)};
}

struct Coordinate {
  std::uint64_t cell;
  long double offset;  ///< [cells]
};

/// phase + x straight + y across, moved by so many cells.
inline Coordinate coordinate(const Digits& x, std::uint64_t straight, const Digits& y, std::uint64_t across,
                             WideWord phase, long double moved = 0.0L) {
  const Digits all = sum(sum(product(x, straight), product(y, across)), digitsOf(phase));
  const std::uint64_t cell = (static_cast<std::uint64_t>(all[3]) << 32) + all[2];
  const std::uint64_t part = (static_cast<std::uint64_t>(all[1]) << 32) + all[0];
  const long double offset = static_cast<long double>(part) * 0x1p-64L + moved;
  const long double whole = std::floor(offset);
  return {cell + static_cast<std::uint64_t>(static_cast<std::int64_t>(whole)), offset - whole};
}

class NoiseReference {
 public:
  /// Of a layer of this seed and pitch.
  NoiseReference(const Noise& noise, std::uint64_t seed, double pitch)
      : noise_(noise), settings_(noise.settings()), seed_(seed), pitch_(pitch) {}

  /// The height [m] at a position on both axes.
  long double height(const Digits& x, const Digits& y) const {
    long double east = 0.0L, north = 0.0L;
    if (settings_.warp > 0.0) {
      const long double metres = settings_.warp / std::sqrt(noiseConstants(settings_.kind).variance);
      east = metres * octave(kMostNoiseOctaves, x, y, 0.0L, 0.0L);
      north = metres * octave(kMostNoiseOctaves + 1, x, y, 0.0L, 0.0L);
    }
    long double total = -noise_.plan().mean(),
                before = std::sqrt(noiseConstants(settings_.kind).ridgeSquared());
    for (int n = 0; n < settings_.octaves; ++n) {
      const long double value = octave(n, x, y, east, north), size = std::fabs(value);
      const long double ridge = (1.0L - size) * (1.0L - size);
      const long double shape = settings_.fractal == NoiseFractal::fbm      ? value
                                : settings_.fractal == NoiseFractal::billow ? size
                                                                            : ridge * before;
      total += noise_.plan().amplitude(n) * shape;
      before = ridge;
    }
    return total;
  }

 private:
  long double octave(int number, const Digits& x, const Digits& y, long double east,
                     long double north) const {
    const bool simplex = settings_.kind == NoiseKind::simplex;
    const double frequency =
        number < kMostNoiseOctaves ? noise_.plan().frequency(number) : settings_.frequency;
    const NoiseLattice lattice(settings_.kind, frequency * pitch_, seed_, number);
    const long double skew = simplex ? (std::sqrt(3.0L) - 1.0L) / 2.0L : 0.0L;
    const long double skewed = skew * (east + north);
    const Coordinate a =
        coordinate(x, lattice.straight, y, lattice.across, lattice.phaseX, frequency * (east + skewed));
    const Coordinate b =
        coordinate(y, lattice.straight, x, lattice.across, lattice.phaseY, frequency * (north + skewed));
    long double total = 0.0L;
    for (int corner = 0; corner < 4; ++corner) {
      const int i = corner % 2, j = corner / 2;
      long double dx = a.offset - i, dy = b.offset - j, weight = 0.0L;
      if (simplex) {
        const long double unskew = (dx + dy) * (3.0L - std::sqrt(3.0L)) / 6.0L;
        dx -= unskew;
        dy -= unskew;
        weight = std::pow(std::max(0.0L, 0.5L - dx * dx - dy * dy), 4.0L);
      } else {
        weight = fall(std::fabs(dx)) * fall(std::fabs(dy));
      }
      const int direction =
          gradient(lattice, a.cell + static_cast<unsigned>(i), b.cell + static_cast<unsigned>(j));
      const NoiseGradients& gradients = noiseGradients(settings_.kind);
      total += weight * (gradients.east[direction] * dx + gradients.north[direction] * dy);
    }
    return total;
  }

  static long double fall(long double t) { return 1.0L - t * t * t * (t * (t * 6.0L - 15.0L) + 10.0L); }

  static int gradient(const NoiseLattice& lattice, std::uint64_t cellX, std::uint64_t cellY) {
    const auto line = [](std::uint64_t cell, std::uint64_t seed) {
      const auto key = static_cast<std::uint32_t>(hashWith(seed, cell >> 32) >> 32);
      std::uint32_t z = (static_cast<std::uint32_t>(cell) ^ key) * 0x7feb352du;
      z ^= z >> 15;
      z = (z + static_cast<std::uint32_t>(seed)) * 0x846ca68bu;
      return z ^ (z >> 16);
    };
    std::uint32_t h = (line(cellX, lattice.seedX) ^ line(cellY, lattice.seedY)) * 0x2c1b3c6du;
    h ^= h >> 15;
    return static_cast<int>((h * 0x297a2d39u) >> 28);
  }

  const Noise& noise_;
  NoiseSettings settings_;
  std::uint64_t seed_;
  double pitch_;
};

}  // namespace teren::test
