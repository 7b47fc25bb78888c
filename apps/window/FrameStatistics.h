// Collects one duration per frame and answers with percentiles: what --stats writes and the display shows.
#pragma once

#include <cstddef>
#include <vector>

namespace teren {

struct Percentiles {
  double p50 = 0.0, p99 = 0.0, max = 0.0;
};

/// Exact percentiles over all values, by nearest rank: pQ is the smallest value that at least Q % of the
/// values do not exceed. Keeps every value: 8 bytes a frame, less than 2 MB an hour.
class FrameStatistics {
 public:
  /// A value that is not finite or is negative is a broken contract (assert).
  void add(double value);

  std::size_t count() const noexcept { return values_.size(); }
  /// The latest value; 0 when there is none.
  double last() const noexcept { return values_.empty() ? 0.0 : values_.back(); }
  /// Zeros when there is no value. O(count).
  Percentiles percentiles() const { return latest(values_.size()); }
  /// The same over the last `window` values (or all, if there are fewer).
  Percentiles latest(std::size_t window) const;

 private:
  std::vector<double> values_;
};

}  // namespace teren
