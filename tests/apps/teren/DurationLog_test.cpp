#include "apps/teren/DurationLog.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

using std::chrono::microseconds;

/// By the definition: the smallest value that at least so many thousandths of all do not exceed.
double percentile(const std::vector<std::int64_t>& values, std::size_t thousandths) {
  double smallest = 1e300;
  for (const std::int64_t value : values) {
    const auto notAbove = static_cast<std::size_t>(
        std::count_if(values.begin(), values.end(), [&](std::int64_t other) { return other <= value; }));
    if (notAbove * 1000 >= thousandths * values.size()) {
      smallest = std::min(smallest, static_cast<double>(value));
    }
  }
  return smallest;
}

TEST(DurationLog, GivesExactPercentilesByNearestRank) {
  for (const std::size_t count : {1U, 2U, 3U, 10U, 99U, 100U, 101U, 999U, 1000U, 1001U, 2345U}) {
    RandomSequence random(count);
    DurationLog log(count + 5);
    std::vector<std::int64_t> values;
    for (std::size_t k = 0; k < count; ++k) {
      values.push_back(random.nextBits(10));
      log.add(microseconds(values.back()));
    }
    const Percentiles percentiles = log.percentiles();
    EXPECT_EQ(log.count(), count);
    EXPECT_EQ(percentiles.p50, percentile(values, 500)) << count;
    EXPECT_EQ(percentiles.p99, percentile(values, 990)) << count;
    EXPECT_EQ(percentiles.p999, percentile(values, 999)) << count;
    EXPECT_EQ(percentiles.max, percentile(values, 1000)) << count;
  }
}

TEST(DurationLog, SaysZeroWhereThereIsNothing) {
  const Percentiles percentiles = DurationLog(10).percentiles();
  EXPECT_EQ(percentiles.p50, 0.0);
  EXPECT_EQ(percentiles.max, 0.0);
}

}  // namespace
}  // namespace teren
