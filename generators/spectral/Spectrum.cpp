#include "generators/spectral/Spectrum.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "teren/Hash.h"

#include "generators/numbers/Gaussian.h"
#include "generators/numbers/Logarithm.h"
#include "generators/numbers/PowerOfTwo.h"
#include "generators/numbers/RandomNumber.h"
#include "generators/numbers/Turn.h"

namespace teren {
namespace {

constexpr std::uint64_t kRowWords = 1024;  // of the seed's sequence for each l

/// x^exponent
double power(double x, double exponent) noexcept {
  return powerOfTwo(exponent * binaryLogarithm(x));
}

}  // namespace

SpectralLaw::SpectralLaw(SpectralRule rule, double hurst, int harmonics)
    : rule_(rule),
      harmonics_(harmonics),
      amplitudes_(static_cast<std::size_t>(harmonics + 1) * static_cast<std::size_t>(harmonics + 1)) {
  assert(0.0 <= hurst && hurst <= 1.0 && 1 <= harmonics && harmonics <= 128);
  Gaussian::table();  // now, not in somebody's slice
  for (int l = 0; l <= harmonics; ++l) {
    for (int k = 0; k <= harmonics; ++k) {
      double amplitude = 0.0;
      if (rule == SpectralRule::published) {
        amplitude = power((k + 1.0) * (l + 1.0), -(hurst + 0.5));
      } else if (k + l > 0 && k * k + l * l <= harmonics * harmonics) {
        amplitude = power(static_cast<double>(k * k + l * l), -0.5 * (hurst + 1.0));
      }
      amplitudes_[static_cast<std::size_t>(l * (harmonics + 1) + k)] = static_cast<float>(amplitude);
    }
  }
}

double SpectralLaw::mostOfAmplitude() const noexcept {
  // Two independent Gaussians u cos + v sin: the square root of u^2 + v^2. The product of two, times
  // cos cos cos + sin sin sin, which is at most 1 in size.
  constexpr double kCut = Gaussian::kCut;
  return rule_ == SpectralRule::published ? kCut * kCut : kCut * std::sqrt(2.0);
}

/// With fma, because of this shape alone GCC makes fused instructions by itself (doc/determinism.md).
SpectralHarmonics::Turned SpectralHarmonics::product(const Turned& a, const Turned& b) noexcept {
  return {std::fma(a.re, b.re, -(a.im * b.im)), std::fma(a.re, b.im, a.im * b.re)};
}

SpectralHarmonics::SpectralHarmonics(std::shared_ptr<const SpectralLaw> law, int wanted, std::uint64_t seed,
                                     PhaseShift shift)
    : law_(std::move(law)), wanted_(wanted), seed_(seed), shift_(shift) {
  drifts_ = law_->rule() == SpectralRule::isotropic && (shift.east != 0.0 || shift.north != 0.0);
  if (!drifts_) return;
  for (int k = -wanted; k <= wanted; ++k) {
    const SineCosine turn = sineCosineOfTurn(-k * shift.east);
    drift_.push_back({turn.cosine, turn.sine});
  }
}

void SpectralHarmonics::row(int l, Harmonic* row) const noexcept {
  const int largest = this->largest();
  const int first = law_->firstOfRow(l, wanted_);
  std::fill_n(row, largest + first, Harmonic{});
  RandomSequence words(seed_, static_cast<std::uint64_t>(l) * kRowWords +
                                  static_cast<std::uint64_t>(first + static_cast<int>(kRowWords) / 2));
  const SineCosine north = sineCosineOfTurn(-l * shift_.north);
  for (int k = first; k <= largest; ++k) {
    const std::uint64_t word = words.next();
    const double amplitude = law_->amplitude(std::abs(k), l, wanted_);
    if (amplitude == 0.0) {
      row[largest + k] = {};
    } else if (law_->rule() == SpectralRule::published) {
      row[largest + k] = published(word, amplitude);
    } else {
      row[largest + k] = isotropic(word, amplitude, k, north);
    }
  }
}

/// (u - i v) e^(i angle) has the real part u cos + v sin.
Harmonic SpectralHarmonics::isotropic(std::uint64_t word, double amplitude, int k,
                                      const SineCosine& north) const noexcept {
  const Gaussian& gaussian = Gaussian::table();
  const double u = amplitude * gaussian.fromHalf(static_cast<std::uint32_t>(word >> 32));
  const double v = amplitude * gaussian.fromHalf(static_cast<std::uint32_t>(word));
  Turned wave{u, -v};
  if (drifts_) {
    wave = product(wave, product(drift_[static_cast<std::size_t>(wanted_ + k)], {north.cosine, north.sine}));
  }
  return {static_cast<float>(wave.re), static_cast<float>(wave.im)};
}

/// A cos + B sin is the real part of (A - i B) e^(i angle).
Harmonic SpectralHarmonics::published(std::uint64_t word, double amplitude) const noexcept {
  const Gaussian& gaussian = Gaussian::table();
  const double a = gaussian.fromHalf(static_cast<std::uint32_t>(word >> 32));
  const double b = gaussian.fromHalf(static_cast<std::uint32_t>(word));
  const SineCosine pa = sineCosineOfTurn(uniform(hashWith(word, 1)) + shift_.east);
  const SineCosine pb = sineCosineOfTurn(uniform(hashWith(word, 2)) + shift_.north);
  const double size = amplitude * a * b;
  return {static_cast<float>(size * pa.cosine * pb.cosine), static_cast<float>(-size * pa.sine * pb.sine)};
}

}  // namespace teren
