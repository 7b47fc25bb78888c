// Noise: ground as a sum of gradient noise of finer and finer lattices, one field over the whole plane.
#pragma once

#include <cstdint>
#include <memory>

#include "teren/ContinuousGenerator.h"

#include "generators/noise/NoisePlan.h"

namespace teren {

/// For which processor the arithmetic of a task is made; the bits are the same.
enum class NoisePath { plain, avx2, avx512 };

/// The field at a point, in double: its height [m] and how it rises towards the east and the north [m/m].
struct NoisePoint {
  double height = 0.0, east = 0.0, north = 0.0;
};

/// Gradient noise (Perlin 1985) is 0 at the corners of a lattice, where it rises in a random direction, and
/// smooth between them. `perlin` has a square lattice and weights 6 t^5 - 15 t^4 + 10 t^3 (Perlin 2002), so
/// that its second derivatives are continuous; `simplex` the lattice of triangles and kernels
/// (1/2 - r^2)^4 (Gustavson 2005), whose third derivatives are continuous and which has no axes. Departures:
/// gradients are 16 directions of one length, chosen by a hash of 64-bit coordinates, so that nothing
/// repeats where tables of 256 numbers do; every octave has its own seed and a random phase, so that
/// mean and deviation are the same at every place, corners included.
///
/// Octaves are summed (NoisePlan.h) as fbm; as billow, |noise|, round hills between creases; or as ridges
/// (1 - |noise|)^2, creases on top. Musgrave (in Ebert et al., Texturing and Modeling, 2003, ch. 16) weights
/// an octave of ridges by the sum of those before it, cut at 1; here the weight is the ridge of the octave
/// before, uncut: valleys stay smooth all the same, and mean and variance have a closed form.
///
/// `hurst` H: amplitudes fall as lacunarity^-H an octave, so that between the coarsest octave and the finest
/// the mean square of second differences over a distance r grows as r^(2H); estimated from it over 64 maps, H
/// is met within 0.05 (tested at 0.2, 0.5, 0.8 for every kind, with warp and without).
///
/// `warp` moves the place at which the sum is taken by two more fields of noise of the first octave's
/// frequency. Mean and deviation stay. It costs two octaves more, and with Perlin noise the work that columns
/// and rows otherwise share.
///
/// Positions are whole numbers of 2^-32 pitches, lattice coordinates whole numbers of 2^-64 cells modulo
/// 2^128: exact, and a pure function of seed, pitch and position. Octaves beyond kMostCells cells a pitch are
/// as fine as that. Within a cell the place is rounded to 2^-24.
///
/// Work: octaves x samples; bound by arithmetic. A task asks whether its slice is over after a few
/// microseconds. Immutable; any number of tasks may run at once, on any threads.
class Noise {
 public:
  explicit Noise(const NoiseSettings& settings) noexcept : settings_(settings), plan_(settings) {}

  const NoiseSettings& settings() const noexcept { return settings_; }
  const NoisePlan& plan() const noexcept { return plan_; }

  /// How many octaves a level has: above level 0 only those with two samples a cell or more.
  int kept(int level, double spacing) const noexcept;

  /// Mean 0 and the deviation asked for, exact over all seeds at every place; bounds that hold for every
  /// seed.
  HeightRange range() const noexcept;

  /// Generator::residual, within a factor of 1.5 of what is measured; the source file says how.
  double residual(int level, int samples, double spacing) const noexcept;

  /// ContinuousGenerator::fieldError: for every octave the least of three bounds. Linear interpolation over a
  /// right triangle with legs s is off by at most s^2 / 4 times the largest second derivative, s / sqrt 2
  /// times the largest slope, or largest minus smallest. Creases have no second derivative. In trials 1 to 5
  /// times what was found, with warp up to 9.
  double fieldError(double spacing) const noexcept;

  /// Begins a rectangle; ContinuousGenerator::beginField. spacing: 2^-32 ... 2^31 pitches. The task allocates
  /// when it is begun and never again.
  std::unique_ptr<SlicedTask> begin(const FieldRequest& request, HeightView out) const {
    return begin(request, out, fastestPath());
  }
  /// The same for a processor of choice, which must be able to: runs(path).
  std::unique_ptr<SlicedTask> begin(const FieldRequest& request, HeightView out, NoisePath path) const;
  static bool runs(NoisePath path) noexcept;
  static NoisePath fastestPath() noexcept;

  /// The field of level 0 at the request's first sample, in double, with its exact slopes but on creases,
  /// where they are those of one side. Samples differ from it by less than
  /// roundingBound.
  NoisePoint pointAt(const FieldRequest& request) const noexcept;

  /// How far a sample may lie from pointAt [m].
  double roundingBound() const noexcept;

 private:
  NoiseSettings settings_;
  NoisePlan plan_;
};

}  // namespace teren
