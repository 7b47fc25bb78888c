// Spectral synthesis: ground, or clouds, as a sum of random waves whose size falls with their number by a
// power law, so that every part looks like the whole.
#pragma once

#include <array>
#include <memory>

#include "teren/Generator.h"

#include "generators/spectral/Spectrum.h"

namespace teren {

/// The sum of SpectralLaw's harmonics, scaled to a standard deviation by the law, never by measuring the map.
///
/// `hurst` H: with the isotropic rule the power of a wave falls as |k|^-(2 H + 2), so a radial power spectrum
/// finds H (tested: within 0.05 over 64 maps). With the published rule it falls as
/// ((k + 1) (l + 1))^-(2 H + 1): along each axis the spectrum of a profile with this H, but for the shift by
/// one; between the axes faster, so that its ground is woven along the axes, and waves run from the
/// south-west half to the north-east one only.
///
/// A map shows exactly one period: the longest wave is as long as its side, and its opposite rims are equal,
/// which blending hides, because it weighs rims 0. Within the map nothing repeats. Waves shorter than two
/// samples would only alias, so a map of n finest intervals has at most n / 2 - 1 harmonics (3 where n < 8);
/// the deviation holds for whatever remains, at every sample and time.
///
/// Work: harmonics^2 random numbers and samples^2 log(samples) operations (InverseTransform.h), where the
/// direct sum (SpectralReference.h) costs samples^2 harmonics^2. A coarse level costs its own samples only.
/// Immutable; any number of tasks may run at once, on any threads.
class SpectralSynthesis {
 public:
  static constexpr int kMaxHarmonics = 128;

  /// hurst: 0 ... 1; deviation [m]: finite, >= 0; harmonics: 1 ... kMaxHarmonics. Anything else is a broken
  /// contract.
  SpectralSynthesis(SpectralRule rule, double hurst, double deviation, int harmonics, PhaseShift shift = {});

  /// Mean and deviation are exact; min and max are reached only if all waves meet at their largest.
  HeightRange range() const noexcept;

  /// Generator::residual: exact but for the rims, which count as the rest. O(harmonics^2).
  double residual(int level, int samples) const;

  /// Begins a map; Generator::begin. request.samples is 1 or 2^k + 1 <= 4097; with 1, request.finestIntervals
  /// says of which map it is the centre. The task allocates when it is begun and never again.
  std::unique_ptr<SlicedTask> begin(const MapRequest& request, HeightView out) const;

  /// What the task of begin(request, ...) sums, and by what it multiplies: for the reference.
  SpectralHarmonics harmonicsOf(const MapRequest& request) const;
  float scaleOf(const MapRequest& request) const noexcept;

 private:
  /// How many harmonics a map of so many finest intervals has.
  int wanted(int intervals) const noexcept;

  std::shared_ptr<const SpectralLaw> law_;
  double deviation_;
  int harmonics_;
  PhaseShift shift_;
  std::vector<double> variances_;  // of the unscaled sum, by how many harmonics are wanted
  double most_ = 0.0;  // the largest height for any number of harmonics, as a part of the deviation
};

}  // namespace teren
