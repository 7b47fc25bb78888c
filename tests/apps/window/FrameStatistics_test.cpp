#include "apps/window/FrameStatistics.h"

#include <gtest/gtest.h>

namespace teren {
namespace {

TEST(FrameStatistics, IsZeroWithoutFrames) {
  const FrameStatistics statistics;
  EXPECT_EQ(statistics.count(), 0U);
  EXPECT_EQ(statistics.percentiles().p50, 0.0);
  EXPECT_EQ(statistics.percentiles().max, 0.0);
}

TEST(FrameStatistics, GivesTheOnlyValueForEveryPercentile) {
  FrameStatistics statistics;
  statistics.add(7.5);
  EXPECT_EQ(statistics.percentiles().p50, 7.5);
  EXPECT_EQ(statistics.percentiles().p99, 7.5);
  EXPECT_EQ(statistics.percentiles().max, 7.5);
}

TEST(FrameStatistics, FindsNearestRanksInAnyOrderOfValues) {
  FrameStatistics statistics;
  for (int k = 0; k < 1000; ++k)
    statistics.add(static_cast<double>(k * 7 % 1000) + 1.0);  // 1 ... 1000, mixed
  EXPECT_EQ(statistics.count(), 1000U);
  EXPECT_EQ(statistics.percentiles().p50, 500.0);
  EXPECT_EQ(statistics.percentiles().p99, 990.0);
  EXPECT_EQ(statistics.percentiles().max, 1000.0);
}

TEST(FrameStatistics, LetsOneFrameOfAHundredAndOneBeLaterThanItsP99) {
  FrameStatistics statistics;
  for (int k = 0; k < 100; ++k) statistics.add(1.0);
  statistics.add(50.0);
  EXPECT_EQ(statistics.percentiles().p99, 1.0);
  EXPECT_EQ(statistics.percentiles().max, 50.0);
}

TEST(FrameStatistics, LooksOnlyAtTheLatestWhenAsked) {
  FrameStatistics statistics;
  for (int k = 0; k < 10; ++k) statistics.add(100.0);
  for (int k = 0; k < 3; ++k) statistics.add(2.0);
  EXPECT_EQ(statistics.latest(3).max, 2.0);
  EXPECT_EQ(statistics.latest(4).max, 100.0);
  EXPECT_EQ(statistics.latest(1000).p50, 100.0);
  EXPECT_EQ(statistics.latest(0).max, 0.0);
}

TEST(FrameStatistics, TellTheLatestValue) {
  FrameStatistics statistics;
  EXPECT_EQ(statistics.last(), 0.0);
  statistics.add(7.0);
  statistics.add(3.0);
  EXPECT_EQ(statistics.last(), 3.0);
}

}  // namespace
}  // namespace teren
