#include "teren/FrameBudget.h"

#include <cmath>

#include <gtest/gtest.h>

namespace teren {
namespace {

using std::chrono::microseconds;
using std::chrono::nanoseconds;

TEST(FrameBudget, IsWhatTheRestOfTheFrameLeaves) {
  FrameBudget budget(50.0);
  EXPECT_EQ(budget.frame(), microseconds(20'000));
  EXPECT_EQ(budget.next(), microseconds(5'000));
  budget.measured(microseconds(14'000));
  EXPECT_EQ(budget.next(), microseconds(4'000));  // 20 - 2 - 14
}

TEST(FrameBudget, AdaptsToTheWantedFrameRate) {
  for (const double rate : {24.0, 60.0, 144.0}) {
    FrameBudget budget(rate);
    for (int frame = 0; frame < 1000; ++frame) budget.measured(microseconds(3'000));
    const auto whole = std::chrono::duration<double>(budget.frame()).count();
    EXPECT_NEAR(whole, 1.0 / rate, 1e-9);
    const auto left = std::chrono::duration<double>(budget.next()).count();
    EXPECT_NEAR(left, std::min(0.9 * whole - 0.003, 0.5 * whole), 2e-6) << rate;
  }
}

TEST(FrameBudget, FollowsALongerFrameAtOnceAndAShorterOneSlowly) {
  FrameBudget budget(50.0);
  budget.measured(microseconds(10'000));
  EXPECT_EQ(budget.next(), microseconds(5'000) + nanoseconds(187'500));
  for (int frame = 0; frame < 1000; ++frame) budget.measured(microseconds(10'000));
  EXPECT_NEAR(static_cast<double>(budget.next().count()), 8e6, 1e3);
  budget.measured(microseconds(15'000));
  EXPECT_EQ(budget.next(), microseconds(3'000));
  budget.measured(microseconds(10'000));
  EXPECT_LT(budget.next(), microseconds(3'400));
}

TEST(FrameBudget, LetsTheEngineWorkEvenWhereDrawingTakesLongerThanAFrame) {
  FrameBudget budget(60.0);
  budget.measured(std::chrono::hours(1));
  EXPECT_EQ(budget.next(), budget.frame() / 32);
  for (int frame = 0; frame < 1000; ++frame) budget.measured(nanoseconds(-5));
  EXPECT_EQ(budget.next(), budget.frame() / 2);
}

TEST(FrameBudget, TakesAnyNumberForARate) {
  EXPECT_EQ(FrameBudget(0.0).frame(), std::chrono::seconds(1));
  EXPECT_EQ(FrameBudget(-3.0).frame(), std::chrono::seconds(1));
  EXPECT_EQ(FrameBudget(1e300).frame(), std::chrono::milliseconds(1));
  EXPECT_EQ(FrameBudget(std::nan("")).frame(), FrameBudget().frame());
}

}  // namespace
}  // namespace teren
