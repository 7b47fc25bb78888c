// Gradient noise over a row, written once for any width of registers: each file that includes this compiles
// it for one processor, with `Lanes` for its registers. All floats are added and multiplied in the same
// order everywhere, never fused, so the bits are the same. Nothing here has a name outside its file, and no
// inline function of the libraries is called, for the linker could take one compiled for AVX-512 for all.
#pragma once

#include "generators/noise/NoiseConstants.h"
#include "generators/noise/NoiseRow.h"

namespace teren {
namespace {

/// A place among the lattice: its cell's lower words, and the offset in cells from the cell's corner.
template <class Lanes>
struct Place {
  typename Lanes::Words cellX, cellY;
  typename Lanes::Floats x, y;
};

template <class Lanes>
struct NoiseArithmetic {
  using Floats = typename Lanes::Floats;
  using Words = typename Lanes::Words;

  static Floats set(float value) { return Lanes::set(value); }
  static Words word(std::uint32_t value) { return Lanes::word(value); }

  static Floats least(Floats a, Floats b) { return Lanes::choose(a < b, a, b); }
  static Floats most(Floats a, Floats b) { return Lanes::choose(a > b, a, b); }

  /// 6 t^5 - 15 t^4 + 10 t^3 (Perlin 2002).
  static Floats quintic(Floats t) {
    const Floats inner = t * (t * set(6.0f) - set(15.0f)) + set(10.0f);
    return t * t * t * inner;
  }

  static Words axisHash(Words cell, const AxisKeys& keys) {
    const Words key = Lanes::choose(cell < keys.base, word(keys.beyond), word(keys.first));
    Words z = (cell ^ key) * kAxisFactor1;
    z = z ^ (z >> 15);
    z = (z + keys.second) * kAxisFactor2;
    return z ^ (z >> 16);
  }

  /// The corner's gradient times the offset from it.
  static Floats slope(Words axes, Floats x, Floats y, const typename Lanes::Gradients& gradients) {
    Words h = axes * kCornerFactor1;
    h = h ^ (h >> 15);
    h = h * kCornerFactor2;
    Floats east, north;
    gradients.look(h, east, north);
    return east * x + north * y;
  }

  static Floats between(Floats a, Floats b, Floats weight) { return a + weight * (b - a); }

  static Floats perlin(Words west, Words east, Words south, Words north, Floats x, Floats y, Floats weightX,
                       Floats weightY, const typename Lanes::Gradients& gradients) {
    const Floats back = x - set(1.0f), down = y - set(1.0f);
    const Floats southern =
        between(slope(west ^ south, x, y, gradients), slope(east ^ south, back, y, gradients), weightX);
    const Floats northern =
        between(slope(west ^ north, x, down, gradients), slope(east ^ north, back, down, gradients), weightX);
    return between(southern, northern, weightY);
  }

  /// Of columns and row on the lattice's own lines.
  static Floats onLines(const NoiseOctaveRow& octave, int column,
                        const typename Lanes::Gradients& gradients) {
    return perlin(Lanes::load(octave.west + column), Lanes::load(octave.east + column), word(octave.south),
                  word(octave.north), Lanes::load(octave.offset + column), set(octave.rowOffset),
                  Lanes::load(octave.weight + column), set(octave.rowWeight), gradients);
  }

  /// Adds a fraction [2^-32 cells] and what it carries.
  static void add(Words& cell, Words& part, Words cells, Words parts) {
    const Words sum = part + parts;
    cell = cell + cells + Lanes::choose(sum < parts, word(1), word(0));
    part = sum;
  }

  /// Adds `cells`, rounded down to 2^-24; of it the part below one cell is exact or, just below 0, 2^-24 off.
  static void add(Words& cell, Words& part, Floats cells) {
    const Floats cut = Lanes::toFloats(Lanes::toWords(cells));  // towards 0
    const Floats whole = cut - Lanes::choose(cells < cut, set(1.0f), set(0.0f));
    const Floats rest = least(cells - whole, set(kLargestPart));
    add(cell, part, Lanes::toWords(whole), Lanes::toWords(rest * set(0x1p24f)) << 8);
  }

  static Floats offset(Words part) { return Lanes::toFloats(part >> 8) * set(0x1p-24f); }

  template <NoiseKind kind>
  static Place<Lanes> place(const NoiseOctaveRow& octave, int column, const Floats* metres) {
    Words cellX = Lanes::load(octave.cellX + column), partX = Lanes::load(octave.partX + column);
    Words cellY = word(octave.rowCellY), partY = word(octave.rowPartY);
    if constexpr (kind == NoiseKind::simplex) {
      add(cellX, partX, word(octave.rowCellX), word(octave.rowPartX));
      add(cellY, partY, Lanes::load(octave.cellY + column), Lanes::load(octave.partY + column));
    }
    if (metres != nullptr) {
      Floats x = metres[0] * set(octave.straight), y = metres[1] * set(octave.straight);
      if constexpr (kind == NoiseKind::simplex) {
        x = x + metres[1] * set(octave.across);
        y = y + metres[0] * set(octave.across);
      }
      add(cellX, partX, x);
      add(cellY, partY, y);
    }
    return {cellX, cellY, offset(partX), offset(partY)};
  }

  /// One corner's part of simplex noise: (1/2 - r^2)^4 times its slope, nothing beyond.
  static Floats corner(Words axes, Floats x, Floats y, const typename Lanes::Gradients& gradients) {
    Floats t = most(set(0.5f) - x * x - y * y, set(0.0f));
    t = t * t;
    return t * t * slope(axes, x, y, gradients);
  }

  /// Gustavson 2005: the square cell, unskewed, is two triangles; x > y is the one in the south-east.
  static Floats simplex(const Place<Lanes>& at, Words west, Words east, Words south, Words north,
                        const typename Lanes::Gradients& gradients) {
    const Floats unskew = (at.x + at.y) * set(kUnskew);
    const Floats x = at.x - unskew, y = at.y - unskew;
    const auto eastern = at.x > at.y;
    const Words middle = Lanes::choose(eastern, east ^ south, west ^ north);
    const Floats middleX = x - Lanes::choose(eastern, set(1.0f - kUnskew), set(-kUnskew));
    const Floats middleY = y - Lanes::choose(eastern, set(-kUnskew), set(1.0f - kUnskew));
    const Floats farX = x - set(1.0f - 2.0f * kUnskew), farY = y - set(1.0f - 2.0f * kUnskew);
    return corner(west ^ south, x, y, gradients) + corner(middle, middleX, middleY, gradients) +
           corner(east ^ north, farX, farY, gradients);
  }

  template <NoiseKind kind>
  static Floats anywhere(const NoiseOctaveRow& octave, int column, const Floats* metres,
                         const typename Lanes::Gradients& gradients) {
    const Place<Lanes> at = place<kind>(octave, column, metres);
    const Words west = axisHash(at.cellX, octave.keysX), south = axisHash(at.cellY, octave.keysY);
    const Words east = axisHash(at.cellX + word(1), octave.keysX);
    const Words north = axisHash(at.cellY + word(1), octave.keysY);
    if constexpr (kind == NoiseKind::simplex) {
      return simplex(at, west, east, south, north, gradients);
    } else {
      return perlin(west, east, south, north, at.x, at.y, quintic(at.x), quintic(at.y), gradients);
    }
  }

  /// Noise of one octave, -1 ... 1 but for rounding.
  template <NoiseKind kind, bool warped>
  static Floats noise(const NoiseOctaveRow& octave, int column, const Floats* metres,
                      const typename Lanes::Gradients& gradients) {
    if constexpr (kind == NoiseKind::perlin && !warped) {
      return onLines(octave, column, gradients);
    } else {
      return anywhere<kind>(octave, column, metres, gradients);
    }
  }

  /// Bound by arithmetic: about 60 operations an octave and register for Perlin noise, 100 for simplex.
  template <NoiseKind kind, NoiseFractal fractal, bool warped>
  static void fill(const NoiseRow& row) {
    const typename Lanes::Gradients gradients(kind);
    for (int column = 0; column < row.columns; column += Lanes::kCount) {
      Floats metres[2] = {set(0.0f), set(0.0f)};
      if constexpr (warped) {
        metres[0] =
            noise<kind, false>(row.warps[0], column, nullptr, gradients) * set(row.warps[0].amplitude);
        metres[1] =
            noise<kind, false>(row.warps[1], column, nullptr, gradients) * set(row.warps[1].amplitude);
      }
      Floats sum = set(0.0f), before = set(row.before);
      for (int n = 0; n < row.octaveCount; ++n) {
        const NoiseOctaveRow& octave = row.octaves[n];
        const Floats noise =
            NoiseArithmetic::noise<kind, warped>(octave, column, warped ? metres : nullptr, gradients);
        if constexpr (fractal == NoiseFractal::fbm) {
          sum = sum + noise * set(octave.amplitude);
        } else if constexpr (fractal == NoiseFractal::billow) {
          sum = sum + Lanes::size(noise) * set(octave.amplitude);
        } else {
          const Floats distance = set(1.0f) - Lanes::size(noise);
          const Floats ridge = distance * distance;
          sum = sum + ridge * before * set(octave.amplitude);
          before = ridge;
        }
      }
      if constexpr (fractal == NoiseFractal::ridged) sum = sum + before * set(row.tail);
      Lanes::store(row.heights + column, sum + set(row.constant));
    }
  }
};

template <class Lanes, NoiseKind kind>
NoiseRowKernel noiseKernelOf(NoiseVariant variant) noexcept {
  using Arithmetic = NoiseArithmetic<Lanes>;
  switch (variant.fractal) {
    case NoiseFractal::fbm:
      return variant.warped ? Arithmetic::template fill<kind, NoiseFractal::fbm, true>
                            : Arithmetic::template fill<kind, NoiseFractal::fbm, false>;
    case NoiseFractal::ridged:
      return variant.warped ? Arithmetic::template fill<kind, NoiseFractal::ridged, true>
                            : Arithmetic::template fill<kind, NoiseFractal::ridged, false>;
    case NoiseFractal::billow:
      return variant.warped ? Arithmetic::template fill<kind, NoiseFractal::billow, true>
                            : Arithmetic::template fill<kind, NoiseFractal::billow, false>;
  }
  return nullptr;
}

template <class Lanes>
NoiseRowKernel noiseKernelOf(NoiseVariant variant) noexcept {
  return variant.kind == NoiseKind::perlin ? noiseKernelOf<Lanes, NoiseKind::perlin>(variant)
                                           : noiseKernelOf<Lanes, NoiseKind::simplex>(variant);
}

}  // namespace
}  // namespace teren
