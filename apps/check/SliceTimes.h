// How long slices were, against how long they were asked for.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "teren/Plugin.h"

namespace teren::check {

inline constexpr std::chrono::microseconds kAskedSlice(100);
/// What a sanitizer adds is not the plugin's.
inline constexpr std::chrono::microseconds kLongestSlice(kSanitizerWord == 0 ? 200 : 1000);
/// So many slices are enough for a percentile; of fewer than the least, it would nearly be the longest of
/// all.
inline constexpr std::size_t kEnoughSlices = 400, kFewestSlices = 200;
/// A machine that is busy with other things makes single slices long, also by the thread's own clock; a
/// plugin that overruns does so every time.
inline constexpr int kSliceAttempts = 5;

/// By nearest rank: the least that 99 % do not exceed.
inline std::chrono::nanoseconds percentile99(std::vector<std::chrono::nanoseconds>& times) {
  const auto rank = static_cast<std::size_t>(std::ceil(0.99 * static_cast<double>(times.size()))) - 1;
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(rank), times.end());
  return times[rank];
}

inline std::string microsecondsText(std::chrono::nanoseconds time) {
  return std::to_string(std::chrono::duration_cast<std::chrono::microseconds>(time).count()) + " us";
}

}  // namespace teren::check
