// Runs tasks slice by slice against a deadline (law 4), learning by measurement how far their steps overrun.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "teren/Slice.h"

namespace teren {

/// One frame's budget for work on the caller's thread.
///
/// A step ends after the unit of work in which its slice ran out, so it overruns by up to one unit. The meter
/// measures these overruns and asks for slices that end early by the largest recent one (which decays by 1/64
/// a slice), but by no more than half the frame, so that a hiccup does not stop the work where budgets are
/// tight: no slice starts after the deadline, and few end beyond it, on any machine.
class SliceMeter {
 public:
  using Clock = Slice::Clock;

  /// Begins a frame whose work must end at `deadline`.
  void beginFrame(Clock::time_point deadline) noexcept;

  /// Whether a useful slice still fits before the deadline. The first slice of a frame always fits if the
  /// deadline has not passed, so that work goes on under the tightest budget.
  bool mayStart() noexcept;

  /// One step of a task; only after mayStart said so (assert). Returns what the step returned.
  bool step(SlicedTask& task);

  std::uint64_t slices() const noexcept { return slices_; }
  std::uint64_t lateSlices() const noexcept { return lateSlices_; }  ///< that ended after the deadline
  Clock::duration expectedOverrun() const noexcept { return overrun_; }

  /// A single hiccup of the machine must not stop the work for long: longer overruns count as this.
  static constexpr Clock::duration kLongestOverrun = std::chrono::microseconds(500);

 private:
  /// How long before the deadline a slice must start, and is asked to end.
  Clock::duration spared() const noexcept { return std::min(overrun_, mostSpared_); }

  Clock::time_point deadline_{};
  Clock::time_point start_{};      // of the slice that mayStart allowed
  Clock::duration mostSpared_{0};  // half the frame
  bool allowed_ = false;
  bool firstOfFrame_ = true;
  Clock::duration overrun_{0};
  std::uint64_t slices_ = 0, lateSlices_ = 0;
};

}  // namespace teren
