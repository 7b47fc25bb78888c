// Times work by the processor time of the calling thread, many times over.
#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

#include "teren/ProcessorTime.h"

namespace teren {

/// [s] of the calling thread's own work.
template <class Work>
double processorSecondsOf(const Work& work) {
  const std::chrono::nanoseconds before = threadProcessorTime();
  work();
  return std::chrono::duration<double>(threadProcessorTime() - before).count();
}

/// How often work must be repeated to last longer than kLeastTiming, against which the clock's own time is
/// nothing; at least once, at most 2^20 times.
inline constexpr double kLeastTiming = 2e-4;  // [s]
template <class Work>
std::size_t roundsOf(const Work& work) {
  std::size_t rounds = 1;
  const auto repeat = [&] {
    for (std::size_t k = 0; k < rounds; ++k) work();
  };
  while (rounds < (std::size_t{1} << 20U) && processorSecondsOf(repeat) < kLeastTiming) rounds *= 2;
  return rounds;
}

}  // namespace teren
