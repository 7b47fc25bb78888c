#include "generators/noise/NoisePlan.h"

#include <cassert>
#include <cmath>

#include "generators/noise/NoiseConstants.h"
#include "generators/numbers/Logarithm.h"
#include "generators/numbers/PowerOfTwo.h"

namespace teren {

NoisePlan::NoisePlan(const NoiseSettings& settings) noexcept : settings_(settings) {
  assert(1 <= settings.octaves && settings.octaves <= kMostNoiseOctaves);
  assert(std::isfinite(settings.frequency) && settings.frequency > 0.0);
  assert(1.0 <= settings.lacunarity && settings.lacunarity <= 4.0);
  assert(0.0 <= settings.hurst && settings.hurst <= 1.0);
  assert(std::isfinite(settings.deviation) && settings.deviation >= 0.0);
  assert(std::isfinite(settings.warp) && settings.warp >= 0.0);
  const double gain = powerOfTwo(-settings.hurst * binaryLogarithm(settings.lacunarity));
  double frequency = settings.frequency, amplitude = 1.0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(settings.octaves); ++n) {
    frequencies_[n] = frequency;
    amplitudes_[n] = amplitude;
    frequency *= settings.lacunarity;
    amplitude *= gain;
  }
  const double scale = settings.deviation / std::sqrt(missingSquare(0));
  for (double& each : amplitudes_) each *= scale;
}

double NoisePlan::before() const noexcept {
  return std::sqrt(noiseConstants(settings_.kind).ridgeSquared());
}

double NoisePlan::mean() const noexcept {
  const NoiseConstants& noise = noiseConstants(settings_.kind);
  switch (settings_.fractal) {
    case NoiseFractal::fbm:
      return 0.0;
    case NoiseFractal::billow:
      return sum() * noise.size;
    case NoiseFractal::ridged:
      return (sum() * noise.ridge() + amplitude(0) * (before() - noise.ridge())) * noise.ridge();
  }
  return 0.0;
}

double NoisePlan::largest() const noexcept {
  return settings_.fractal == NoiseFractal::ridged ? sum() - amplitude(0) * (1.0 - before()) : sum();
}

double NoisePlan::sum() const noexcept {
  double sum = 0.0;
  for (const double amplitude : amplitudes_) sum += amplitude;
  return sum;
}

double NoisePlan::constant(int kept) const noexcept {
  if (kept == 0) return 0.0;
  const NoiseConstants& noise = noiseConstants(settings_.kind);
  double sum = -mean();
  if (settings_.fractal == NoiseFractal::billow) {
    for (int n = kept; n < settings_.octaves; ++n) sum += amplitude(n) * noise.size;
  } else if (settings_.fractal == NoiseFractal::ridged) {
    for (int n = kept + 1; n < settings_.octaves; ++n) sum += amplitude(n) * noise.ridge() * noise.ridge();
  }
  return sum;
}

double NoisePlan::tail(int kept) const noexcept {
  if (settings_.fractal != NoiseFractal::ridged || kept == 0 || kept == settings_.octaves) return 0.0;
  return amplitude(kept) * noiseConstants(settings_.kind).ridge();
}

/// Octaves are independent; only a ridge appears in two terms, its own and the next one's.
double NoisePlan::missingSquare(int kept) const noexcept {
  const NoiseConstants& noise = noiseConstants(settings_.kind);
  double sum = 0.0;
  if (settings_.fractal != NoiseFractal::ridged) {
    const double variance =
        settings_.fractal == NoiseFractal::fbm ? noise.variance : noise.variance - noise.size * noise.size;
    for (int n = kept; n < settings_.octaves; ++n) sum += amplitude(n) * amplitude(n) * variance;
    return sum;
  }
  const double first = noise.ridge(), second = noise.ridgeSquared(), variance = second - first * first;
  for (int n = kept; n < settings_.octaves; ++n) {
    const double next = n + 1 < settings_.octaves ? amplitude(n + 1) : 0.0;
    const double square =
        n == 0 || n == kept ? second * variance : second * second - first * first * first * first;
    const double shared = first * variance * (n == 0 ? before() : first);
    sum += amplitude(n) * (amplitude(n) * square + 2.0 * next * shared);
  }
  return sum;
}

}  // namespace teren
