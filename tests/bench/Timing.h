// What benchmarks without Google Benchmark do: look at the thread's own time, and take the median.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

#include "teren/ProcessorTime.h"

namespace teren {

/// [s] of this thread's own work: what others do meanwhile must not count.
inline double processorSeconds() {
  return std::chrono::duration<double>(threadProcessorTime()).count();
}

/// The upper one of an even number of values; 0 of none.
inline double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace teren
