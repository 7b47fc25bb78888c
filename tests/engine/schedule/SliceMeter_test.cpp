#include "schedule/SliceMeter.h"

#include <chrono>
#include <vector>

#include <gtest/gtest.h>

namespace teren {
namespace {

using Clock = Slice::Clock;

/// Works in units of fixed wall time and remembers what it was asked.
class SpinTask final : public SlicedTask {
 public:
  SpinTask(Clock::duration unit, int units) : unit_(unit), left_(units) {}
  bool step(const Slice& slice) override {
    deadlines.push_back(slice.deadline());
    do {
      const Clock::time_point end = Clock::now() + unit_;
      while (Clock::now() < end) {
      }
      --left_;
    } while (left_ > 0 && !slice.over());
    return left_ <= 0;
  }
  std::vector<Clock::time_point> deadlines;

 private:
  Clock::duration unit_;
  int left_;
};

/// Begins frames until one is not over before its first slice: the machine may pause this thread at any time.
void beginAllowedFrame(SliceMeter& meter, Clock::duration budget) {
  do {
    meter.beginFrame(Clock::now() + budget);
  } while (!meter.mayStart());
}

TEST(SliceMeter, StartsNothingAfterTheDeadline) {
  SliceMeter meter;
  meter.beginFrame(Clock::now() - std::chrono::microseconds(1));
  EXPECT_FALSE(meter.mayStart());
  EXPECT_EQ(meter.slices(), 0U);
}

TEST(SliceMeter, LetsATaskGoOnEveryFrameHoweverTightTheBudget) {
  SliceMeter meter;
  SpinTask task(std::chrono::microseconds(200), 20);
  bool done = false;
  int frames = 0;
  while (!done && frames < 1000) {
    meter.beginFrame(Clock::now() + std::chrono::microseconds(50));
    while (!done && meter.mayStart()) done = meter.step(task);
    ++frames;
  }
  EXPECT_TRUE(done);
}

TEST(SliceMeter, NeverAsksForASliceBeyondTheDeadline) {
  SliceMeter meter;
  SpinTask task(std::chrono::microseconds(30), 400);
  bool done = false;
  while (!done) {
    const Clock::time_point deadline = Clock::now() + std::chrono::microseconds(500);
    meter.beginFrame(deadline);
    while (!done && meter.mayStart()) {
      done = meter.step(task);
      EXPECT_LE(task.deadlines.back(), deadline);
    }
  }
}

TEST(SliceMeter, LearnsFromOverrunsAndThenAsksForLess) {
  SliceMeter meter;
  SpinTask task(std::chrono::microseconds(300), 1000);
  beginAllowedFrame(meter, std::chrono::microseconds(100));
  (void)meter.step(task);
  EXPECT_GE(meter.expectedOverrun(), std::chrono::microseconds(100));
  EXPECT_LE(meter.expectedOverrun(), SliceMeter::kLongestOverrun);
  const Clock::time_point deadline = Clock::now() + std::chrono::milliseconds(50);
  meter.beginFrame(deadline);
  ASSERT_TRUE(meter.mayStart());
  (void)meter.step(task);
  EXPECT_LT(task.deadlines.back(), deadline);
}

TEST(SliceMeter, GoesOnUnderTightBudgetsAfterAHiccup) {
  SliceMeter meter;
  SpinTask slow(std::chrono::milliseconds(2), 1);
  beginAllowedFrame(meter, std::chrono::microseconds(10));
  (void)meter.step(slow);
  ASSERT_EQ(meter.expectedOverrun(), SliceMeter::kLongestOverrun);
  int frames = 0, second = 0;  // slices after the first of a frame; a pause of this thread may cost some
  for (; frames < 20 && second == 0; ++frames) {
    SpinTask quick(Clock::duration{0}, 1);
    beginAllowedFrame(meter, std::chrono::microseconds(100));
    (void)meter.step(quick);
    if (meter.mayStart()) ++second;
  }
  EXPECT_EQ(second, 1) << "in " << frames << " frames";
  EXPECT_GT(meter.expectedOverrun(), std::chrono::microseconds(100));
}

TEST(SliceMeter, ForgetsASingleHiccupInTime) {
  SliceMeter meter;
  SpinTask slow(std::chrono::milliseconds(2), 1);
  beginAllowedFrame(meter, std::chrono::microseconds(10));
  (void)meter.step(slow);
  const Clock::duration after = meter.expectedOverrun();
  for (int k = 0; k < 500; ++k) {
    SpinTask quick(Clock::duration{0}, 1);
    meter.beginFrame(Clock::now() + std::chrono::seconds(1));
    ASSERT_TRUE(meter.mayStart());
    (void)meter.step(quick);
  }
  EXPECT_LT(meter.expectedOverrun(), after / 100);
}

#ifndef NDEBUG
TEST(SliceMeterDeathTest, RefusesASliceThatMayStartDidNotAllow) {
  SliceMeter meter;
  SpinTask task(Clock::duration{0}, 1);
  meter.beginFrame(Clock::now() - std::chrono::seconds(1));
  EXPECT_DEATH((void)meter.step(task), "allowed_");
}
#endif

}  // namespace
}  // namespace teren
