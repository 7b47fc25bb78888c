// What many measurements come to.
#include "apps/report/Statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

TEST(Statistics, AreNothingOfNothing) {
  const Summary summary = summaryOf({});
  EXPECT_EQ(summary.count, 0U);
  EXPECT_EQ(summary.median, 0.0);
  EXPECT_EQ(summary.p99, 0.0);
  EXPECT_EQ(summary.max, 0.0);
  EXPECT_EQ(summary.spread, 0.0);
  EXPECT_EQ(rootMeanSquare({}), 0.0);
}

TEST(Statistics, OfOneValueAreThatValue) {
  const Summary summary = summaryOf({3.5});
  EXPECT_EQ(summary.median, 3.5);
  EXPECT_EQ(summary.p99, 3.5);
  EXPECT_EQ(summary.max, 3.5);
  EXPECT_EQ(summary.spread, 0.0);
}

TEST(Statistics, TakeRanksOfSmallSetsInAnyOrder) {
  const Summary odd = summaryOf({5.0, 1.0, 4.0, 2.0, 3.0});
  EXPECT_EQ(odd.median, 3.0);
  EXPECT_EQ(odd.p99, 5.0);
  EXPECT_DOUBLE_EQ(odd.spread, (4.0 - 2.0) / 3.0);
  const Summary even = summaryOf({4.0, 1.0, 3.0, 2.0});
  EXPECT_EQ(even.median, 2.0) << "the smallest that half of all do not exceed";
  EXPECT_EQ(even.p99, 4.0);
  EXPECT_DOUBLE_EQ(even.spread, (3.0 - 1.0) / 2.0);
}

TEST(Statistics, LeaveTheLastHundredthOutOfThePercentile) {
  std::vector<double> values;
  for (int k = 1000; k >= 1; --k) values.push_back(k);
  const Summary summary = summaryOf(values);
  EXPECT_EQ(summary.median, 500.0);
  EXPECT_EQ(summary.p99, 990.0);
  EXPECT_EQ(summary.max, 1000.0);
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  EXPECT_EQ(quantile(values, 0.001), 1.0);
  EXPECT_EQ(quantile(values, 1.0), 1000.0);
}

TEST(Statistics, OfRandomSetsAreWhatTheDefinitionSays) {
  RandomSequence random(3);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> values(static_cast<std::size_t>(1 + random.nextBits(7)));
    for (double& value : values) value = static_cast<double>(random.nextBits(5));
    for (const double q : {0.25, 0.5, 0.75, 0.99, 1.0}) {
      const double at = quantile(values, q);
      const auto notAbove = std::count_if(values.begin(), values.end(), [at](double v) { return v <= at; });
      const auto below = std::count_if(values.begin(), values.end(), [at](double v) { return v < at; });
      const double wanted = q * static_cast<double>(values.size());
      EXPECT_GE(static_cast<double>(notAbove), wanted - 1e-9) << trial;
      EXPECT_LT(static_cast<double>(below), wanted) << trial;
    }
  }
}

TEST(Statistics, SquareBeforeTheyMean) {
  EXPECT_DOUBLE_EQ(rootMeanSquare(std::vector<double>{3.0, -4.0}), std::sqrt(12.5));
}

}  // namespace
}  // namespace teren
