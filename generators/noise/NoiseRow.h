// What the arithmetic of noise reads and writes: a row of samples, octave by octave, as plain numbers. It is
// compiled for several processors (NoiseKernel.h), so nothing here is a function.
#pragma once

#include <cstdint>

namespace teren {

enum class NoiseKind { perlin, simplex };
enum class NoiseFractal { fbm, ridged, billow };

/// How a lattice coordinate is hashed along one axis. A row sees only cells from `base` on and fewer than
/// 2^31 of them, so the upper words of their 64 bits are that of base or, below base's lower word, the next.
struct AxisKeys {
  std::uint32_t base;    ///< lower word
  std::uint32_t first;   ///< made of seed, octave, axis and the upper word of base
  std::uint32_t beyond;  ///< the same, of the next upper word
  std::uint32_t second;  ///< made of seed, octave and axis
};

/// One octave of noise along a row. Columns are arrays of 32-bit words or floats, padded to kNoisePadding.
struct NoiseOctaveRow {
  /// Samples on a lattice whose axes are the row's own (Perlin without warp): hashes of the lines of the
  /// lattice west and east of each column, its offset from the western one in cells, and the eastern one's
  /// weight.
  const std::uint32_t *west, *east;
  const float *offset, *weight;
  std::uint32_t south, north;  ///< hashes of the lines south and north of the row
  float rowOffset, rowWeight;  ///< [cells] from the southern line; weight of the northern one

  /// Samples anywhere (simplex, warp): lattice coordinates of columns and of the row, to be added; cells, and
  /// parts of a cell in 2^-32.
  const std::uint32_t *cellX, *partX, *cellY, *partY;
  std::uint32_t rowCellX, rowPartX, rowCellY, rowPartY;
  AxisKeys keysX, keysY;
  float straight,
      across;  ///< [cells/m] what a metre of warp along an axis adds to this coordinate, the other

  float amplitude;  ///< [m]
};

/// Octaves in the order of their sums, from coarse to fine.
struct NoiseRow {
  const NoiseOctaveRow* octaves;
  int octaveCount;
  const NoiseOctaveRow* warps;  ///< two: their noise is the displacement east and north; null without warp
  float constant;               ///< [m] added to the sum
  float before;                 ///< ridged: what the first octave's ridge is multiplied with
  float tail;      ///< [m] ridged: how much of the last octave's ridge is added for those left out
  int columns;     ///< columns beyond, up to a multiple of kNoisePadding, may be filled as well
  float* heights;  ///< room for so many
};

inline constexpr int kNoisePadding = 16;

/// Fills a row of samples.
using NoiseRowKernel = void (*)(const NoiseRow& row);

struct NoiseVariant {
  NoiseKind kind;
  NoiseFractal fractal;
  bool warped;
};

/// The same arithmetic for different processors; the bits do not depend on which is taken. The last two are
/// there where Teren is built for x86-64. Asking for one that the processor lacks is fine, calling it is not.
NoiseRowKernel noiseKernelPlain(NoiseVariant variant) noexcept;
NoiseRowKernel noiseKernelAvx2(NoiseVariant variant) noexcept;
NoiseRowKernel noiseKernelAvx512(NoiseVariant variant) noexcept;

}  // namespace teren
