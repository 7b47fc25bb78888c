// The harmonics of spectral synthesis: how strong each may be, and which random ones a seed draws.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "generators/numbers/Turn.h"
#include "generators/spectral/InverseTransform.h"

namespace teren {

enum class SpectralRule { isotropic, published };

/// The law of the harmonics, before scaling to metres. A wave makes k turns from west to east and l from
/// south to north across the map. Immutable.
///
/// isotropic: 0 < k^2 + l^2 <= harmonics^2, over half of the plane; the part (u cos + v sin) |k|^-(H + 1)
///   with u and v Gaussian, each cut at 4 deviations.
/// published (thesis B, 2008): 0 <= k, l < harmonics; A cos + B sin, A = a b cos pa cos pb,
///   B = a b sin pa sin pb, a = Gauss (k + 1)^-(H + 1/2), b = Gauss (l + 1)^-(H + 1/2), the phases pa, pb
///   uniform; all four drawn anew for each (k, l).
class SpectralLaw {
 public:
  /// hurst: 0 ... 1; harmonics: 1 ... 128.
  SpectralLaw(SpectralRule rule, double hurst, int harmonics);

  SpectralRule rule() const noexcept { return rule_; }

  /// The largest wave number along an axis if only so many harmonics are wanted (1 ... harmonics).
  int largest(int wanted) const noexcept { return rule_ == SpectralRule::published ? wanted - 1 : wanted; }

  /// The deterministic factor of harmonic (+-k, l), k, l >= 0; 0 where the rule has none among so many.
  float amplitude(int k, int l, int wanted) const noexcept {
    if (rule_ == SpectralRule::published ? k >= wanted || l >= wanted
                                         : k * k + l * l > wanted * wanted || k + l == 0) {
      return 0.0f;
    }
    return amplitudes_[static_cast<std::size_t>(l * (harmonics_ + 1) + k)];
  }

  /// The least k of row l; the greatest is `largest`. (Of a wave and its opposite only one is counted.)
  int firstOfRow(int l, int wanted) const noexcept {
    if (rule_ == SpectralRule::published) return 0;
    return l == 0 ? 1 : -wanted;
  }

  /// A harmonic of amplitude a has the variance powerOfAmplitude() a^2 at every point, and is never larger
  /// than mostOfAmplitude() a.
  double powerOfAmplitude() const noexcept { return rule_ == SpectralRule::published ? 0.25 : 1.0; }
  double mostOfAmplitude() const noexcept;

 private:
  SpectralRule rule_;
  int harmonics_;
  std::vector<float> amplitudes_;  // [l][k], 0 ... harmonics
};

/// How far the phases of all waves have moved. isotropic: wave (k, l) by k east + l north turns, so the whole
/// pattern drifts with the wind; published: pa by east and pb by north turns, so it changes its shape.
struct PhaseShift {
  double east = 0.0, north = 0.0;  ///< [turns]
};

/// The harmonics of one map: which ones follows from the seed, k and l alone, so more of them add detail and
/// change nothing else.
class SpectralHarmonics final : public HarmonicSource {
 public:
  SpectralHarmonics(std::shared_ptr<const SpectralLaw> law, int wanted, std::uint64_t seed, PhaseShift shift);

  int largest() const noexcept override { return law_->largest(wanted_); }
  void row(int l, Harmonic* row) const noexcept override;

 private:
  struct Turned {
    double re, im;
  };
  static Turned product(const Turned& a, const Turned& b) noexcept;
  Harmonic isotropic(std::uint64_t word, double amplitude, int k, const SineCosine& north) const noexcept;
  Harmonic published(std::uint64_t word, double amplitude) const noexcept;

  std::shared_ptr<const SpectralLaw> law_;
  int wanted_;
  std::uint64_t seed_;
  PhaseShift shift_;
  std::vector<Turned> drift_;  // e^(-2 pi i k east), k = -largest ... largest; where the pattern drifts
  bool drifts_ = false;
};

}  // namespace teren
