// The numbers gradient noise is made of: factors of its hashes, its directions, and what follows from its
// formula - variance, moments, steepest slope - each computed again by quadrature in the tests.
#pragma once

#include <cstdint>

#include "generators/noise/NoiseRow.h"

namespace teren {

/// Odd factors whose products mix upward, between shifts that mix downward (found by search: Wellons 2018).
inline constexpr std::uint32_t kAxisFactor1 = 0x7feb352d, kAxisFactor2 = 0x846ca68b;
inline constexpr std::uint32_t kCornerFactor1 = 0x2c1b3c6d, kCornerFactor2 = 0x297a2d39;

/// From the skewed square lattice to triangles and back: (3 - sqrt 3) / 6 and (sqrt 3 - 1) / 2.
inline constexpr double kUnskewExact = 0.21132486540518712, kSkew = 0.36602540378443865;
inline constexpr float kUnskew = static_cast<float>(kUnskewExact);

inline constexpr float kLargestPart = 1.0f - 0x1p-24f;

/// The 16 directions at odd multiples of 11.25 degrees, all of one length, by the upper four bits of a hash;
/// every odd one is the opposite of the one before. Their moments up to the 15th order are those of all
/// directions together, so that no axis is preferred.
struct NoiseGradients {
  float east[16], north[16];
};

/// Scaled so that noise lies within -1 ... 1.
const NoiseGradients& noiseGradients(NoiseKind kind) noexcept;

/// Of noise over a cell and its corners' directions. Lengths are in cells.
struct NoiseConstants {
  double gradient;      ///< length of a gradient: 1 over the largest value of noise with unit gradients
  double variance;      ///< E n^2
  double size;          ///< E |n|
  double sizeCubed;     ///< E |n|^3
  double fourthMoment;  ///< E n^4
  double slope;         ///< bound on |grad n|
  double curvature;     ///< bound on the second derivative in any direction
  double steepness;     ///< root mean square of the slope along any direction, in standard deviations

  /// First and second moment of ridges (1 - |n|)^2.
  constexpr double ridge() const noexcept { return 1.0 - 2.0 * size + variance; }
  constexpr double ridgeSquared() const noexcept {
    return 1.0 - 4.0 * size + 6.0 * variance - 4.0 * sizeCubed + fourthMoment;
  }
};

const NoiseConstants& noiseConstants(NoiseKind kind) noexcept;

}  // namespace teren
