#include "teren/FrameBudget.h"

#include <algorithm>
#include <cmath>

namespace teren {

namespace {

using std::chrono::nanoseconds;

nanoseconds frameOf(double framesPerSecond) noexcept {
  const double rate = std::isnan(framesPerSecond) ? 60.0 : std::clamp(framesPerSecond, 1.0, 1000.0);
  return nanoseconds(static_cast<std::int64_t>(1e9 / rate));
}

constexpr int kLeastShare = 32, kMostShare = 2, kFirstShare = 4, kOthersShare = 10, kForgetting = 16;

}  // namespace

FrameBudget::FrameBudget(double framesPerSecond) noexcept
    : frame_(frameOf(framesPerSecond)), rest_(frame_ - frame_ / kOthersShare - frame_ / kFirstShare) {}

nanoseconds FrameBudget::next() const noexcept {
  const nanoseconds left = frame_ - frame_ / kOthersShare - rest_;
  return std::clamp(left, frame_ / kLeastShare, frame_ / kMostShare);
}

void FrameBudget::measured(nanoseconds rest) noexcept {
  rest = std::max(rest, nanoseconds(0));
  rest_ = rest >= rest_ ? rest : rest_ - (rest_ - rest) / kForgetting;
}

}  // namespace teren
