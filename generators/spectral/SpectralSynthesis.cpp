#include "generators/spectral/SpectralSynthesis.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "generators/numbers/Turn.h"

namespace teren {
namespace {

constexpr int kLeastSide = 8;  // smaller maps are cut from one with so many intervals

int finestIntervalsOf(const MapRequest& request) {
  return request.samples == 1 ? request.finestIntervals : (request.samples - 1) << request.level;
}

/// A whole map, or what little of a 2 x 2 one is asked for.
class SynthesisTask final : public SlicedTask {
 public:
  SynthesisTask(SpectralHarmonics harmonics, float scale, HeightView out)
      : harmonics_(std::move(harmonics)),
        out_(out),
        small_(out.columns() < 3 ? HeightMap(2, 2) : HeightMap()),
        transform_(harmonics_, std::max(2, out.columns() - 1), scale,
                   small_.columns() > 0 ? small_.view() : out) {}

  bool step(const Slice& slice) override {
    if (!transform_.step(slice)) return false;
    if (small_.columns() == 0) return true;
    // One sample is the centre; two a side are the rims of a period, which are equal.
    const int place = out_.columns() == 1 ? 1 : 0;
    for (int row = 0; row < out_.rows(); ++row) {
      std::fill_n(out_.row(row), out_.columns(), small_(place, place));
    }
    return true;
  }

 private:
  SpectralHarmonics harmonics_;
  HeightView out_;
  HeightMap small_;
  InverseTransform transform_;
};

}  // namespace

SpectralSynthesis::SpectralSynthesis(SpectralRule rule, double hurst, double deviation, int harmonics,
                                     PhaseShift shift)
    : law_(std::make_shared<const SpectralLaw>(rule, hurst, harmonics)),
      deviation_(deviation),
      harmonics_(harmonics),
      shift_{shift.east - std::floor(shift.east), shift.north - std::floor(shift.north)},
      variances_(static_cast<std::size_t>(harmonics) + 1) {
  assert(std::isfinite(deviation) && deviation >= 0.0);
  for (int intervals = kLeastSide; intervals <= 4 * kMaxHarmonics; intervals *= 2) {
    const int count = wanted(intervals);
    double variance = 0.0, sum = 0.0;
    for (int l = 0; l <= law_->largest(count); ++l) {
      for (int k = law_->firstOfRow(l, count); k <= law_->largest(count); ++k) {
        const double amplitude = law_->amplitude(std::abs(k), l, count);
        variance += law_->powerOfAmplitude() * amplitude * amplitude;
        sum += law_->mostOfAmplitude() * amplitude;
      }
    }
    variances_[static_cast<std::size_t>(count)] = variance;
    most_ = std::max(most_, sum / std::sqrt(variance));
  }
}

int SpectralSynthesis::wanted(int intervals) const noexcept {
  return std::min(harmonics_, std::max(intervals, kLeastSide) / 2 - 1);
}

HeightRange SpectralSynthesis::range() const noexcept {
  const double largest = deviation_ * most_ * (1.0 + 2.0 * kTransformError);
  return {.mean = 0.0, .deviation = deviation_, .min = -largest, .max = largest};
}

/// A wave of angle (x, y) per sample and random phase, of variance 1, is a point e^i(x p + y q) of the unit
/// circle; the mean over a cell of s x s samples of the squared difference between it and the interpolation
/// over the triangles is
///   1 - 2 h(x, y) + g0 + 2 g1 (cos s x + cos s y + cos s (x + y)),
/// where h is the mean of the tent over the six triangles around a vertex times the wave - the tent is the
/// running sum of three bars of s samples, along x, y and the diagonal, so h is the product of their three
/// transforms - and g0, g1 are the means of a tent's square and of its product with a neighbouring tent.
double SpectralSynthesis::residual(int level, int samples) const {
  assert(level >= 0 && samples >= 1);
  if (level == 0) return 0.0;
  const int intervals = samples - 1;
  const int count = wanted(intervals), largest = law_->largest(count);
  const bool centre = level >= 31 || intervals >> level < 2;
  const int stride = centre ? 1 : 1 << level;
  const double g0 = 0.5 + 0.5 / (static_cast<double>(stride) * stride), g1 = (1.0 - g0) / 6.0;

  // For wave number n - 2 largest: the transform of a bar, and the cosine of the turn from vertex to vertex.
  std::vector<double> bars, cosines;
  for (int n = -2 * largest; !centre && n <= 2 * largest; ++n) {
    const double halfTurn = n / (2.0 * intervals);
    const double below = stride * sineCosineOfTurn(halfTurn).sine;
    const SineCosine above = sineCosineOfTurn(stride * halfTurn);
    bars.push_back(below != 0.0 ? above.sine / below : above.cosine / sineCosineOfTurn(halfTurn).cosine);
    cosines.push_back(sineCosineOfTurn(2.0 * stride * halfTurn).cosine);
  }
  const auto at = [largest](const std::vector<double>& table, int n) {
    return table[static_cast<std::size_t>(n + 2 * largest)];
  };
  double square = 0.0;
  for (int l = 0; l <= largest; ++l) {
    for (int k = law_->firstOfRow(l, count); k <= largest; ++k) {
      const double amplitude = law_->amplitude(std::abs(k), l, count);
      double error = 0.0;
      if (!centre) {
        error = 1.0 - 2.0 * at(bars, k) * at(bars, l) * at(bars, k + l) + g0 +
                2.0 * g1 * (at(cosines, k) + at(cosines, l) + at(cosines, k + l));
      } else if (intervals > 0 && (k % intervals != 0 || l % intervals != 0)) {
        error = 2.0;  // the centre's own phase says nothing about the wave elsewhere
      }
      square += law_->powerOfAmplitude() * amplitude * amplitude * std::max(error, 0.0);
    }
  }
  return deviation_ * std::sqrt(square / variances_[static_cast<std::size_t>(count)]);
}

SpectralHarmonics SpectralSynthesis::harmonicsOf(const MapRequest& request) const {
  return {law_, wanted(finestIntervalsOf(request)), request.seed, shift_};
}

float SpectralSynthesis::scaleOf(const MapRequest& request) const noexcept {
  const int count = wanted(finestIntervalsOf(request));
  return static_cast<float>(deviation_ / std::sqrt(variances_[static_cast<std::size_t>(count)]));
}

std::unique_ptr<SlicedTask> SpectralSynthesis::begin(const MapRequest& request, HeightView out) const {
  assert(out.columns() == request.samples && out.rows() == request.samples);
  return std::make_unique<SynthesisTask>(harmonicsOf(request), scaleOf(request), out);
}

}  // namespace teren
