// One disc of the circles generator: a round hill or hollow, its profile half a wave of a cosine.
#pragma once

#include <cmath>
#include <cstdint>

namespace teren {

/// Circles measure the square of a base map in units, kCircleUnits from side to side (two pitches), whatever
/// the number of samples. Differences of places are whole numbers below 2^24, so floats hold them exactly.
inline constexpr int kCircleUnitBits = 20;
inline constexpr std::int32_t kCircleUnits = std::int32_t{1} << kCircleUnitBits;

/// How far discProfile may lie from the cosine: 3.4e-7 for the polynomial, the rest for the rounding of t and
/// of the evaluation.
inline constexpr double kDiscProfileError = 1e-6;

/// The profile where the squared distance from the centre is 1 - t squared radii: 1 in the middle (t = 1), 0
/// from the rim on (t <= 0), and smooth: (1 + cos(pi sqrt(1 - t))) / 2 = cos^2(pi / 2 sqrt(1 - t)) has no
/// root in its series. It is (t k(t))^2, k(t) = cos(pi / 2 sqrt(1 - t)) / t interpolated at four Chebyshev
/// points of [0, 1], both ends among them: so no cosine of a C library takes part, no square root, and no
/// branch.
/// Twice t, or 0 outside, is t + |t|: a comparison would keep compilers from doing several samples at once.
inline float discProfile(float t) noexcept {
  const float twice = t + std::fabs(t);
  const float root =
      twice * (0.392699082f + twice * (0.0490884811f + twice * (0.00217519726f + twice * 5.28958827e-05f)));
  return root * root;
}

/// Places and radius in units, relative to the map's south-west corner; the centre may lie outside the map.
struct Disc {
  std::int32_t x = 0, y = 0;
  float radius = 1.0f;
  float inverseSquare = 1.0f;  ///< 1 / radius^2
  float height = 0.0f;         ///< [m] in the middle; negative: a hollow

  /// What the disc adds `east` and `north` units away from its centre.
  float at(float east, float north) const noexcept { return alongRow(east, atRow(north)); }

  /// The same in two parts: what a row of the map has in common, and each of its samples.
  float atRow(float north) const noexcept { return 1.0f - north * north * inverseSquare; }
  float alongRow(float east, float row) const noexcept {
    return height * discProfile(row - east * east * inverseSquare);
  }

  /// At least as far as the disc reaches, rounding of `at` included.
  double reach() const noexcept { return static_cast<double>(radius) * (1.0 + 1e-6) + 1.0; }

  /// Whether it can change a sample of the map.
  bool touchesMap() const noexcept {
    const double far = kCircleUnits + reach();
    return x > -reach() && x < far && y > -reach() && y < far;
  }
};

}  // namespace teren
