// C1 interpolation between the samples of a base map: Catmull-Rom splines, one axis at a time, exact at the
// samples. Keys 1981, "Cubic convolution interpolation for digital image processing", a = -1/2.
#pragma once

#include <array>
#include <cassert>
#include <cmath>

namespace teren {

/// Which four samples of a row (or column) take part at a place, and their weights. Weights sum to 1 within a
/// few ulp; at a sample they are exactly one 1 and three 0. At the rims the missing sample is the linear
/// continuation of the last two, folded into their weights: indices always lie inside the row.
struct CubicTaps {
  std::array<int, 4> index{};
  std::array<double, 4> weight{};
};

/// Weights of the samples at -1, 0, 1, 2 for a place f in [0, 1] between samples 0 and 1.
inline std::array<double, 4> catmullRomWeights(double f) noexcept {
  return {f * (f * (1.0 - 0.5 * f) - 0.5), 1.0 + f * f * (1.5 * f - 2.5), f * (0.5 + f * (2.0 - 1.5 * f)),
          f * f * (0.5 * f - 0.5)};
}

/// The taps at place s (in samples, 0 <= s <= samples - 1) of a row of `samples` >= 2.
inline CubicTaps cubicTaps(double s, int samples) noexcept {
  assert(samples >= 2 && s >= 0.0 && s <= samples - 1);
  int first = static_cast<int>(std::floor(s));
  if (first > samples - 2) first = samples - 2;
  std::array<double, 4> w = catmullRomWeights(s - first);
  CubicTaps taps{{first - 1, first, first + 1, first + 2}, w};
  if (first == 0) {  // p[-1] = 2 p[0] - p[1]
    taps.index[0] = 0;
    taps.weight[0] = 0.0;
    taps.weight[1] += 2.0 * w[0];
    taps.weight[2] -= w[0];
  }
  if (first == samples - 2) {  // p[samples] = 2 p[samples - 1] - p[samples - 2]
    taps.index[3] = samples - 1;
    taps.weight[3] = 0.0;
    taps.weight[2] += 2.0 * w[3];
    taps.weight[1] -= w[3];
  }
  return taps;
}

/// The weighted sum of four values, always added in this order: grid and point evaluation share its bits.
inline double combine(const std::array<double, 4>& weight, double a, double b, double c, double d) noexcept {
  return ((weight[0] * a + weight[1] * b) + weight[2] * c) + weight[3] * d;
}

/// The taps' weighted sum over a row of samples.
inline double combineAlong(const CubicTaps& taps, const float* row) noexcept {
  return combine(taps.weight, row[taps.index[0]], row[taps.index[1]], row[taps.index[2]], row[taps.index[3]]);
}

}  // namespace teren
