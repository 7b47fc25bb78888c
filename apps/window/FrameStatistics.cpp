#include "apps/window/FrameStatistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace teren {

void FrameStatistics::add(double value) {
  assert(std::isfinite(value) && value >= 0.0);
  values_.push_back(value);
}

Percentiles FrameStatistics::latest(std::size_t window) const {
  const std::size_t count = std::min(window, values_.size());
  if (count == 0) return {};
  std::vector<double> values(values_.end() - static_cast<std::ptrdiff_t>(count), values_.end());
  const auto ranked = [&values, count](std::size_t percent) {
    const std::size_t rank = (percent * count + 99) / 100;  // ceil
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank - 1);
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  return {ranked(50), ranked(99), *std::max_element(values.begin(), values.end())};
}

}  // namespace teren
