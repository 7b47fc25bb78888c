#include "apps/check/Ensemble.h"

#include <algorithm>
#include <cmath>

namespace teren::check {

Estimate Ensemble::Sums::mean(int count) const noexcept {
  if (count < 2) return {};
  const double mean = first / count;
  return {mean, std::sqrt(std::max(0.0, second / count - mean * mean) / (count - 1))};
}

void Ensemble::add() {
  const HeightMap map = maker_.make(requestOf(next_++, kSamples));
  const auto finite = [](float height) { return std::isfinite(height); };
  if (!std::all_of(map.samples().begin(), map.samples().end(), finite)) return;
  const auto weight = [](int sample) { return sample == 0 || sample == kSamples - 1 ? 0.5 : 1.0; };
  double mean = 0.0, square = 0.0;
  for (int y = 0; y < kSamples; ++y) {
    for (int x = 0; x < kSamples; ++x) {
      const double above = map(x, y) - range_.mean;
      samples_[static_cast<std::size_t>(y * kSamples + x)].add(above);
      mean += weight(x) * weight(y) * above;
      square += weight(x) * weight(y) * above * above;
    }
  }
  constexpr double kArea = (kSamples - 1.0) * (kSamples - 1.0);
  means_.add(mean / kArea);
  squares_.add(square / kArea);
  ++seeds_;
}

Estimate Ensemble::meanAt(int x, int y) const noexcept {
  return at(x, y).mean(seeds_);
}

Estimate Ensemble::mean() const noexcept {
  return means_.mean(seeds_);
}

double Ensemble::deviationAt(int x, int y) const noexcept {
  return seeds_ == 0 ? 0.0 : std::sqrt(at(x, y).second / seeds_);
}

Estimate Ensemble::deviation() const noexcept {
  const Estimate square = squares_.mean(seeds_);
  if (square.value <= 0.0) return {};
  const double root = std::sqrt(square.value);
  return {root, square.error / (2.0 * root)};
}

}  // namespace teren::check
