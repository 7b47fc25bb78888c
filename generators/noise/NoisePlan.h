// What a noise's user chooses, and what follows from it alone: how fast and how high each octave is.
#pragma once

#include <array>

#include "generators/noise/NoiseRow.h"

namespace teren {

inline constexpr int kMostNoiseOctaves = 24;

struct NoiseSettings {
  NoiseKind kind = NoiseKind::perlin;
  NoiseFractal fractal = NoiseFractal::fbm;
  int octaves = 8;           ///< 1 ... kMostNoiseOctaves
  double frequency = 0.002;  ///< [1/m] of the first octave: cells of its lattice in a metre; > 0
  double lacunarity = 2.0;   ///< frequency of an octave in parts of the one before; 1 ... 4
  double hurst = 0.8;        ///< 0 ... 1: an octave's amplitude is lacunarity^-hurst times that before
  double deviation = 60.0;   ///< [m] standard deviation of the heights; finite, >= 0
  double warp = 0.0;         ///< [m] standard deviation of the displacement along each axis; finite, >= 0
};

/// The sum of octaves: with noise n_o of octave o, -1 ... 1,
///   fbm     sum a_o n_o,
///   billow  sum a_o |n_o|,
///   ridged  sum a_o r_o r_(o - 1) with ridges r = (1 - |n|)^2, before the first the root mean square of r,
/// less its mean over all seeds. The amplitudes a_o have the ratio asked for and are such that the deviation
/// over all seeds is the one asked for, at every place: exactly, from the moments of NoiseConstants.
class NoisePlan {
 public:
  explicit NoisePlan(const NoiseSettings& settings) noexcept;

  double frequency(int octave) const noexcept {
    return frequencies_[static_cast<std::size_t>(octave)];
  }  ///< [1/m]
  double amplitude(int octave) const noexcept {
    return amplitudes_[static_cast<std::size_t>(octave)];
  }  ///< [m]

  /// What is added to the sum of the first octaves when the others are left out: their mean, less the mean of
  /// all. With ridges part of it goes with the last ridge. kept: 0 ... octaves.
  double constant(int kept) const noexcept;
  double tail(int kept) const noexcept;

  /// Mean square [m^2] of what is then missing.
  double missingSquare(int kept) const noexcept;
  /// [m] the mean over all seeds of the sum, before it is taken off, and the largest sum.
  double mean() const noexcept;
  double largest() const noexcept;
  /// What the first ridge is multiplied with, so that it is as rough as the ratio of octaves asks for.
  double before() const noexcept;

 private:
  /// Of the amplitudes.
  double sum() const noexcept;

  NoiseSettings settings_;
  std::array<double, kMostNoiseOctaves> frequencies_{};
  std::array<double, kMostNoiseOctaves> amplitudes_{};
};

}  // namespace teren
