#include "apps/teren/DurationLog.h"

#include <algorithm>
#include <cassert>

namespace teren {

void DurationLog::add(std::chrono::nanoseconds duration) noexcept {
  assert(count_ < microseconds_.size());
  microseconds_[count_++] = std::chrono::duration<float, std::micro>(duration).count();
}

Percentiles DurationLog::percentiles() const {
  if (count_ == 0) return {};
  std::vector<float> values(microseconds_.begin(),
                            microseconds_.begin() + static_cast<std::ptrdiff_t>(count_));
  std::sort(values.begin(), values.end());
  const auto ranked = [&](std::size_t thousandths) {
    const std::size_t rank = (thousandths * values.size() + 999) / 1000;  // rounded up
    return static_cast<double>(values[rank - 1]);
  };
  return {ranked(500), ranked(990), ranked(999), ranked(1000)};
}

}  // namespace teren
