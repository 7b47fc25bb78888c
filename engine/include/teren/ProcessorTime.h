// The processor time of the calling thread: what work costs on a machine that others use too.
#pragma once

#include <chrono>
#include <ctime>

namespace teren {

/// Since some moment of the thread's own; grows only while the thread is at work. A system call: 0.1 to 1 us.
inline std::chrono::nanoseconds threadProcessorTime() noexcept {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace teren
