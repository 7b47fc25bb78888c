// Durations of many updates, and their exact percentiles.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <vector>

namespace teren {

/// By nearest rank: pQ is the smallest value that at least Q % of all do not exceed.
struct Percentiles {
  double p50 = 0.0, p99 = 0.0, p999 = 0.0, max = 0.0;
};

/// Zeros where there is none. O(values).
Percentiles percentilesOf(std::span<const float> values);

/// Four bytes each, set aside and touched at once, so that adding neither allocates nor makes the program's
/// memory grow.
class DurationLog {
 public:
  /// Room for so many; adding more is a broken contract (assert).
  explicit DurationLog(std::size_t most) : microseconds_(most) {}

  void add(std::chrono::nanoseconds duration) noexcept;
  std::size_t count() const noexcept { return count_; }
  /// [us]
  Percentiles percentiles() const { return percentilesOf({microseconds_.data(), count_}); }

 private:
  std::vector<float> microseconds_;
  std::size_t count_ = 0;
};

}  // namespace teren
