#include "generators/numbers/Gaussian.h"

#include <cmath>

#include "generators/numbers/PowerOfTwo.h"

namespace teren {
namespace {

constexpr double kLog2E = 1.4426950408889634074;
constexpr double kInverseRootOfTwoPi = 0.39894228040143267794;

double density(double x) noexcept {
  return kInverseRootOfTwoPi * powerOfTwo(-0.5 * kLog2E * x * x);
}

/// The chance of a standard normal number in [0, x], 0 <= x <= 4: density(x) times the sum of
/// x^(2n+1) / (1 * 3 * ... * (2n+1)), whose terms are all positive.
double chanceBelow(double x) noexcept {
  double term = x, sum = 0.0;
  for (int n = 1; term > 1e-18 * sum; ++n) {
    sum += term;
    term *= x * x / (2 * n + 1);
  }
  return density(x) * sum;
}

/// The variance of a number spread evenly over cells with these ends, either sign.
double variance(const std::array<double, Gaussian::kCells + 1>& ends) noexcept {
  double sum = 0.0;
  for (std::size_t n = 0; n < Gaussian::kCells; ++n) {
    sum += (ends[n] * ends[n] + ends[n] * ends[n + 1] + ends[n + 1] * ends[n + 1]) / 3.0;
  }
  return sum / Gaussian::kCells;
}

}  // namespace

Gaussian::Gaussian() : ends_{} {
  const double all = chanceBelow(kCut);
  for (std::size_t n = 1; n < kCells; ++n) {
    // Newton's method from the left neighbour: the distribution function is concave, so it climbs to the
    // quantile without ever passing it.
    const double wanted = all * static_cast<double>(n) / kCells;
    double x = ends_[n - 1];
    for (int iteration = 0; iteration < 12; ++iteration) x += (wanted - chanceBelow(x)) / density(x);
    ends_[n] = x;
  }
  ends_[kCells] = kCut;
  // The last end stays where it is, so the variance is not quite proportional to the factor's square.
  for (int iteration = 0; iteration < 8; ++iteration) {
    const double factor = 1.0 / std::sqrt(variance(ends_));
    for (std::size_t n = 1; n < kCells; ++n) ends_[n] *= factor;
  }
}

const Gaussian& Gaussian::table() {
  static const Gaussian table;
  return table;
}

}  // namespace teren
