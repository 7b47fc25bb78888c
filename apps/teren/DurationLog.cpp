#include "apps/teren/DurationLog.h"

#include <algorithm>
#include <cassert>

namespace teren {

void DurationLog::add(std::chrono::nanoseconds duration) noexcept {
  assert(count_ < microseconds_.size());
  microseconds_[count_++] = std::chrono::duration<float, std::micro>(duration).count();
}

Percentiles percentilesOf(std::span<const float> values) {
  if (values.empty()) return {};
  std::vector<float> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const auto ranked = [&](std::size_t thousandths) {
    const std::size_t rank = (thousandths * sorted.size() + 999) / 1000;  // rounded up
    return static_cast<double>(sorted[rank - 1]);
  };
  return {ranked(500), ranked(990), ranked(999), ranked(1000)};
}

}  // namespace teren
