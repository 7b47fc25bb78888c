#include "world/StepWatch.h"

#include <algorithm>

#include "teren/ProcessorTime.h"

namespace teren {

namespace {

using Clock = Slice::Clock;
using std::chrono::nanoseconds;

bool isUnlimited(const Slice& slice) noexcept {
  return slice.deadline() == Clock::time_point::max();
}

}  // namespace

StepWatch::Start StepWatch::start(const Slice& slice) noexcept {
  if (isUnlimited(slice)) return {};
  // Reading the processor's clock is a system call, so not every step begins with one.
  constexpr std::chrono::milliseconds kOldest(1);
  thread_local Start latest;
  latest.wall = Clock::now();
  if (latest.wall - latest.readAt > kOldest) {
    latest.readAt = latest.wall;
    latest.processor = threadProcessorTime();
  }
  return latest;
}

std::optional<Overrun> StepWatch::finish(const Slice& slice, const Start& start) noexcept {
  if (isUnlimited(slice)) return std::nullopt;
  const nanoseconds given = std::max(slice.deadline(), start.wall) - start.wall;
  if (Clock::now() - start.wall - given <= kNear) {
    inARow_.store(0, std::memory_order_relaxed);
    return std::nullopt;
  }
  // Between its reading and the step the processor's clock ran at most as fast as the wall's: never more is
  // counted than was used.
  const nanoseconds used = threadProcessorTime() - start.processor - (start.wall - start.readAt);
  if (used - given <= kNear) {
    inARow_.store(0, std::memory_order_relaxed);
    return std::nullopt;
  }
  const int inARow = inARow_.fetch_add(1, std::memory_order_relaxed) + 1;
  if (inARow < kInARow && used - given <= kFar) return std::nullopt;
  return Overrun{given, used};
}

}  // namespace teren
