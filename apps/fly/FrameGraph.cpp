#include "apps/fly/FrameGraph.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace teren {
namespace {

float time(double milliseconds) {
  return std::isfinite(milliseconds) && milliseconds > 0.0 ? static_cast<float>(milliseconds) : 0.0F;
}

}  // namespace

void FrameGraph::add(double whole, double engine) noexcept {
  frames_[next_] = {time(whole), std::min(time(engine), time(whole))};
  next_ = (next_ + 1) % kFrames;
  count_ = std::min(count_ + 1, kFrames);
}

const FrameGraph::Frame& FrameGraph::at(std::size_t index) const noexcept {
  assert(index < count_);
  return frames_[(next_ + kFrames - count_ + index) % kFrames];
}

FrameGraph::Figures FrameGraph::figures() const noexcept {
  if (count_ == 0) return {};
  std::array<float, kFrames> times{};
  double whole = 0.0, engine = 0.0;
  for (std::size_t index = 0; index < count_; ++index) {
    times[index] = at(index).whole;
    whole += static_cast<double>(at(index).whole);
    engine += static_cast<double>(at(index).engine);
  }
  const auto end = times.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto ranked = [&](std::size_t percent) {
    const auto place = times.begin() + static_cast<std::ptrdiff_t>((percent * count_ + 99) / 100 - 1);
    std::nth_element(times.begin(), place, end);
    return static_cast<double>(*place);
  };
  return {ranked(50), ranked(99), whole > 0.0 ? engine / whole : 0.0};
}

double FrameGraph::scale(double p99) noexcept {
  constexpr std::array kEnds{20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0};
  const auto end = std::upper_bound(kEnds.begin(), kEnds.end(), p99);
  return end == kEnds.end() ? kEnds.back() : *end;
}

}  // namespace teren
