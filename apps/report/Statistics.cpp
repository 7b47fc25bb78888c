#include "apps/report/Statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace teren {
namespace {

double ranked(std::span<const double> sorted, double q) {
  assert(0.0 <= q && q <= 1.0);
  if (sorted.empty()) return 0.0;
  // A rank a rounding above a whole number is that number.
  const double rank = std::ceil(q * static_cast<double>(sorted.size()) - 1e-9);
  return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

}  // namespace

double quantile(std::span<const double> values, double q) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  return ranked(sorted, q);
}

double rootMeanSquare(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

Summary summaryOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  Summary summary{values.size(), ranked(values, 0.5), ranked(values, 0.99), ranked(values, 1.0), 0.0};
  const double between = ranked(values, 0.75) - ranked(values, 0.25);
  if (summary.median != 0.0) summary.spread = between / summary.median;
  return summary;
}

}  // namespace teren
