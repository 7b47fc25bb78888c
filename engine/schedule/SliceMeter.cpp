#include "schedule/SliceMeter.h"

#include <algorithm>
#include <cassert>

namespace teren {

void SliceMeter::beginFrame(Clock::time_point deadline) noexcept {
  deadline_ = deadline;
  mostSpared_ = std::max(Clock::duration{0}, (deadline - Clock::now()) / 2);
  firstOfFrame_ = true;
  allowed_ = false;
}

bool SliceMeter::mayStart() noexcept {
  start_ = Clock::now();
  const Clock::duration needed = firstOfFrame_ ? Clock::duration{0} : spared();
  allowed_ = start_ + needed < deadline_;
  return allowed_;
}

bool SliceMeter::step(SlicedTask& task) {
  assert(allowed_ && start_ < deadline_);
  allowed_ = false;
  firstOfFrame_ = false;
  const Clock::time_point asked =
      deadline_ == Clock::time_point::max() ? deadline_ : std::max(start_, deadline_ - spared());
  const bool done = task.step(Slice::until(asked));
  const Clock::time_point end = Clock::now();
  ++slices_;
  if (end > deadline_) ++lateSlices_;
  overrun_ -= overrun_ / 64;
  if (end > asked) overrun_ = std::max(overrun_, std::min(end - asked, kLongestOverrun));
  return done;
}

}  // namespace teren
