// What many measurements of one thing come to: percentiles, spread and root mean square.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace teren {

/// By nearest rank: quantile q is the smallest value that at least a share q of all values do not exceed.
/// 0 <= q <= 1; 0 of no values. O(n log n).
double quantile(std::span<const double> values, double q);

/// sqrt(sum of squares / n); 0 of no values.
double rootMeanSquare(std::span<const double> values);

struct Summary {
  std::size_t count = 0;
  double median = 0.0, p99 = 0.0, max = 0.0;  ///< by nearest rank
  /// Interquartile range over median: half of all values lie within about half of it around the median. 0
  /// where the median is.
  double spread = 0.0;
};
Summary summaryOf(std::vector<double> values);

}  // namespace teren
