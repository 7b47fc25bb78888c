#include "generators/noise/NoiseConstants.h"

namespace teren {
namespace {

constexpr double kSqrt2 = 1.4142135623730951;
constexpr double kSqrt6 = 2.449489742783178;

/// Perlin noise is largest in the middle of a cell, where four corners at sqrt(1/2) count 1/4 each; simplex
/// noise in the middle of an edge, where two at sqrt(1/6) count (1/2 - 1/6)^4 each.
constexpr NoiseConstants kPerlin{.gradient = kSqrt2,
                                 .variance = 0.0930623009,
                                 .size = 0.249232,
                                 .sizeCubed = 0.042462,
                                 .fourthMoment = 0.0219007,
                                 .slope = 2.94,
                                 .curvature = 13.2,
                                 .steepness = 2.895505};
constexpr NoiseConstants kSimplex{.gradient = 81.0 * kSqrt6 / 2.0,
                                  .variance = 0.2905355866,
                                  .size = 0.467115,
                                  .sizeCubed = 0.203307,
                                  .fourthMoment = 0.151849,
                                  .slope = 7.38,
                                  .curvature = 56.1,
                                  .steepness = 4.780914};

constexpr NoiseGradients gradientsOf(double length) noexcept {
  // Cosines of 11.25, 33.75, 56.25 and 78.75 degrees.
  constexpr double a = 0.9807852804032304, b = 0.8314696123025452, c = 0.5555702330196022,
                   d = 0.19509032201612828;
  constexpr double east[8] = {a, b, c, d, -d, -c, -b, -a};
  constexpr double north[8] = {d, c, b, a, a, b, c, d};
  NoiseGradients gradients{};
  for (int n = 0; n < 8; ++n) {
    gradients.east[2 * n] = static_cast<float>(length * east[n]);
    gradients.north[2 * n] = static_cast<float>(length * north[n]);
    gradients.east[2 * n + 1] = -gradients.east[2 * n];
    gradients.north[2 * n + 1] = -gradients.north[2 * n];
  }
  return gradients;
}

constexpr NoiseGradients kPerlinGradients = gradientsOf(kPerlin.gradient);
constexpr NoiseGradients kSimplexGradients = gradientsOf(kSimplex.gradient);

}  // namespace

const NoiseGradients& noiseGradients(NoiseKind kind) noexcept {
  return kind == NoiseKind::perlin ? kPerlinGradients : kSimplexGradients;
}

const NoiseConstants& noiseConstants(NoiseKind kind) noexcept {
  return kind == NoiseKind::perlin ? kPerlin : kSimplex;
}

}  // namespace teren
