// What levels and triangles get wrong of noise, and samples by rounding.
//
// Of one octave of deviation 1, drawn by triangles with x cells between their samples, the mean square of the
// error depends on x alone. It grows as x^4 where there are second derivatives and as x^3 where creases are,
// and ends at 3/2, the variance of independent heights and of triangles between them: x^p c / (1 + a x^(p/2)
// + (2/3) c x^p), c and a fitted to what is measured for x = 1/64 ... 1 (within 10 % of the error). Octaves
// are independent, so their mean squares add up.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "generators/noise/Noise.h"
#include "generators/noise/NoiseConstants.h"
#include "generators/numbers/PowerOfTwo.h"

namespace teren {
namespace {

constexpr double kMostMeanSquare = 1.5;
constexpr double kSqrtHalf = 0.7071067811865476;

struct ErrorLaw {
  double c, a;
};

ErrorLaw errorLaw(NoiseKind kind, NoiseFractal fractal) noexcept {
  const bool perlin = kind == NoiseKind::perlin;
  switch (fractal) {
    case NoiseFractal::fbm:
      return perlin ? ErrorLaw{3.69, 1.54} : ErrorLaw{26.2, 3.7};
    case NoiseFractal::ridged:
      return perlin ? ErrorLaw{9.6, 0.78} : ErrorLaw{108.0, 8.7};
    case NoiseFractal::billow:
      return perlin ? ErrorLaw{5.3, -0.6} : ErrorLaw{36.0, -1.24};
  }
  return {};
}

/// Mean square of the error of an octave of deviation 1.
double meanSquare(NoiseKind kind, NoiseFractal fractal, double x) noexcept {
  const ErrorLaw law = errorLaw(kind, fractal);
  const double half = fractal == NoiseFractal::fbm ? x * x : x * std::sqrt(x);
  return law.c * half * half / (1.0 + law.a * half + law.c / kMostMeanSquare * half * half);
}

/// How the mean squares of the single octaves' shapes (noise, its size, its ridge) enter the sum's.
class Shares {
 public:
  Shares(const NoiseSettings& settings, const NoisePlan& plan, int kept) noexcept
      : fractal_(settings.fractal), noise_(noiseConstants(settings.kind)), plan_(plan), kept_(kept) {
    tail_ = plan.tail(kept);
  }

  /// Variance of the shape.
  double variance() const noexcept {
    if (fractal_ == NoiseFractal::fbm) return noise_.variance;
    if (fractal_ == NoiseFractal::billow) return noise_.variance - noise_.size * noise_.size;
    return noise_.ridgeSquared() - noise_.ridge() * noise_.ridge();
  }
  /// Mean square of its slope [1/cell], along any axis; a ridge slopes 2 (1 - |n|) times as much as noise.
  double slopeSquare() const noexcept {
    const double noise = noise_.variance * noise_.steepness * noise_.steepness;
    return fractal_ == NoiseFractal::ridged ? 4.0 * noise_.ridge() * noise : noise;
  }
  /// Mean square [m^2] of what the shape is multiplied with: a ridge counts in its own term and in the next.
  double factorSquare(int octave) const noexcept {
    const double own = plan_.amplitude(octave);
    if (fractal_ != NoiseFractal::ridged) return own * own;
    const double ridge = noise_.ridge(), square = noise_.ridgeSquared();
    const double first = own * (octave == 0 ? plan_.before() : ridge), firstSquare = own * own * square;
    double second = 0.0, secondSquare = 0.0;
    if (octave + 1 < kept_) {
      second = plan_.amplitude(octave + 1) * ridge;
      secondSquare = plan_.amplitude(octave + 1) * plan_.amplitude(octave + 1) * square;
    } else {
      second = tail_;
      secondSquare = tail_ * tail_;
    }
    return firstSquare + 2.0 * first * second + secondSquare;
  }

 private:
  NoiseFractal fractal_;
  const NoiseConstants& noise_;
  const NoisePlan& plan_;
  int kept_;
  double tail_;
};

/// [1] Standard deviation of the displacement's slope along an axis.
double warpSlope(const NoiseSettings& settings) noexcept {
  return settings.warp * settings.frequency * noiseConstants(settings.kind).steepness;
}

}  // namespace

/// Warp stretches what is sampled: a step becomes (1 + g, h) steps long with g and h about Gaussian, and the
/// mean fourth power of that is 1 + 8 t^2 + 8 t^4, t the deviation of g. Warp itself is drawn by triangles,
/// too, which shifts octaves by its error.
double Noise::residual(int level, int samples, double spacing) const noexcept {
  assert(level >= 0 && samples >= 1 && spacing > 0.0);
  if (level == 0) return 0.0;
  const double coarse = spacing * powerOfTwo(level);
  const int kept = this->kept(level, coarse);
  const Shares shares(settings_, plan_, kept);
  const double t = warpSlope(settings_), fourth = 1.0 + 8.0 * t * t * (1.0 + t * t);
  const double stretch = std::sqrt(std::sqrt(fourth));
  const bool centre = level >= 31 || (samples - 1) >> level < 2;
  const double shift = settings_.warp * settings_.warp *
                       meanSquare(settings_.kind, NoiseFractal::fbm, settings_.frequency * coarse);
  double sum = plan_.missingSquare(kept);
  for (int n = 0; n < kept; ++n) {
    const double frequency = plan_.frequency(n);
    const double slope = frequency * frequency * shares.slopeSquare();
    double square;
    if (centre) {
      // From the centre: over a square of side a, r^2 is a^2 / 6 on average.
      const double side = (samples - 1) * spacing * stretch;
      const double near = slope * side * side / 6.0;
      square = 2.0 * shares.variance() * near / (2.0 * shares.variance() + near);
    } else {
      square = shares.variance() * std::min(kMostMeanSquare, meanSquare(settings_.kind, settings_.fractal,
                                                                        frequency * coarse * stretch) +
                                                                 2.0 * slope * shift / shares.variance());
    }
    sum += shares.factorSquare(n) * square;
  }
  return std::sqrt(sum);
}

/// Warp moves by a field whose slopes are at most `slope` and whose second derivatives `bend`: of a function
/// of slope L and curvature M it makes one of slope L (1 + slope) and curvature M (1 + slope)^2 + L bend.
double Noise::fieldError(double spacing) const noexcept {
  assert(spacing > 0.0);
  const NoiseConstants& noise = noiseConstants(settings_.kind);
  const double reach = settings_.warp / std::sqrt(noise.variance) * 2.0 * kSqrtHalf;
  const double slope = 1.0 + reach * noise.slope * settings_.frequency;
  const double bend = reach * noise.curvature * settings_.frequency * settings_.frequency;
  double sum = 0.0, before = 0.0;
  for (int n = 0; n < settings_.octaves; ++n) {
    const double frequency = plan_.frequency(n);
    const double steep = noise.slope * frequency;
    double bound = kSqrtHalf * spacing * steep * slope;
    if (settings_.fractal == NoiseFractal::fbm) {
      const double curved = noise.curvature * frequency * frequency * slope * slope + steep * bend;
      bound = std::min({bound, 0.25 * spacing * spacing * curved, 2.0});
    } else if (settings_.fractal == NoiseFractal::billow) {
      bound = std::min(bound, 1.0);
    } else {
      const double ridge = std::min(2.0 * bound, 1.0);
      bound = n == 0 ? ridge * plan_.before() : std::min(ridge + before, 1.0);
      before = ridge;
    }
    sum += plan_.amplitude(n) * bound;
  }
  return sum + 2.0 * roundingBound();
}

/// Counting operations: noise is off by less than arithmetic at the place that it takes; that place is cut to
/// 2^-24 cells along either axis, and is off by what rounding makes of warp; a sum of octaves is off by half
/// a unit of its last place each time.
double Noise::roundingBound() const noexcept {
  const NoiseConstants& noise = noiseConstants(settings_.kind);
  const double arithmetic = settings_.kind == NoiseKind::perlin ? 1e-6 : 3e-6;
  const double metres = settings_.warp / std::sqrt(noise.variance);
  double sum = 0.0, before = 0.0;
  for (int n = 0; n < settings_.octaves; ++n) {
    const double warp = metres * plan_.frequency(n) *
                        (2.0 * kSqrtHalf * (arithmetic + noise.slope * 0x1p-23) + 3.0 * 0x1p-23);  // [cells]
    const double bound = std::min(2.0, arithmetic + noise.slope * (0x1p-23 + warp));
    const bool ridged = settings_.fractal == NoiseFractal::ridged;
    sum += plan_.amplitude(n) * (ridged ? std::min(1.0, 2.0 * bound + before) : bound);
    before = 2.0 * bound;
  }
  return sum + plan_.largest() * (settings_.octaves + 4) * 0x1p-24;
}

}  // namespace teren
