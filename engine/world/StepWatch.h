// Notices a plugin whose steps go on long after their slices are over, by the processor time they use.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>

#include "teren/Slice.h"

namespace teren {

/// A step that took more than it was given.
struct Overrun {
  std::chrono::nanoseconds slice{0};  ///< what was left of the slice when the step began
  std::chrono::nanoseconds used{0};   ///< processor time of its thread, at least
};

/// Watches the steps of one plugin in one layer, on whatever threads they run; thread-safe.
///
/// The rule: a plugin overruns when one step uses more than kFar of processor time beyond its slice, or when
/// kInARow steps in a row use more than kNear beyond theirs. It is the thread's processor time that counts,
/// so a machine that makes the thread wait accuses nobody. Unlimited slices are never overrun. Nothing is
/// switched off and no height depends on it (law 1): the plugin is only named.
///
/// Cost: the wall clock twice a step, and the thread's processor clock once a millisecond and after a step
/// that ended late by the wall clock: together 0.05 us a step, measured by tests/bench/StepWatch_bench.cpp.
class StepWatch {
 public:
  static constexpr std::chrono::nanoseconds kFar = std::chrono::milliseconds(20);
  static constexpr std::chrono::nanoseconds kNear = std::chrono::milliseconds(2);
  static constexpr int kInARow = 8;

  /// Both clocks of a thread when a step begins; the processor's may have been read a little before.
  struct Start {
    Slice::Clock::time_point wall{};
    Slice::Clock::time_point readAt{};
    std::chrono::nanoseconds processor{0};
  };
  /// Before the plugin is called.
  static Start start(const Slice& slice) noexcept;
  /// After it has returned, on the same thread and with the same slice: the overrun, where the rule is
  /// broken.
  std::optional<Overrun> finish(const Slice& slice, const Start& start) noexcept;

 private:
  std::atomic<int> inARow_ = 0;
};

}  // namespace teren
