#include "schedule/TaskRunner.h"

#include <atomic>
#include <chrono>
#include <map>
#include <set>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

using std::chrono::milliseconds;

/// What tasks leave behind for the test to read: any thread may write.
struct Log {
  std::atomic<int> alive{0};
  std::atomic<int> atWork{0}, mostAtWork{0};
  std::mutex mutex;
  std::vector<int> order;  // task numbers, a step each
};

/// A task of so many steps.
class CountedTask final : public SlicedTask {
 public:
  CountedTask(Log& log, int number, int steps) : log_(log), number_(number), left_(steps) { ++log_.alive; }
  ~CountedTask() override { --log_.alive; }
  bool step(const Slice&) override {
    const int atWork = ++log_.atWork;
    for (int most = log_.mostAtWork; atWork > most && !log_.mostAtWork.compare_exchange_weak(most, atWork);) {
    }
    {
      const std::lock_guard lock(log_.mutex);
      log_.order.push_back(number_);
    }
    if (gate) {
      while (!*gate) std::this_thread::yield();
    }
    --log_.atWork;
    return --left_ <= 0;
  }
  int number() const { return number_; }
  std::atomic<bool>* gate = nullptr;  // a step ends only once this is true

 private:
  Log& log_;
  int number_;
  int left_;
};

std::unique_ptr<CountedTask> task(Log& log, int number, int steps = 1, std::atomic<bool>* gate = nullptr) {
  auto made = std::make_unique<CountedTask>(log, number, steps);
  made->gate = gate;
  return made;
}

void stepEverything(TaskRunner& runner) {
  SliceMeter meter;
  for (bool more = true; more;) {
    meter.beginFrame(SliceMeter::Clock::time_point::max());
    ASSERT_TRUE(meter.mayStart());
    more = runner.stepHere(meter);
  }
}

std::vector<int> numbers(const std::vector<TaskRunner::Finished>& finished) {
  std::vector<int> result;
  for (const auto& one : finished) result.push_back(static_cast<CountedTask&>(*one.task).number());
  return result;
}

/// Takes finished tasks until `count` have come.
std::vector<TaskRunner::Finished> takeMany(TaskRunner& runner, std::size_t count) {
  std::vector<TaskRunner::Finished> all;
  while (all.size() < count) {
    runner.waitForFinished(milliseconds(50));
    for (auto& one : runner.takeFinished()) all.push_back(std::move(one));
  }
  return all;
}

void waitUntilAtWork(const Log& log, int count) {
  while (log.atWork < count) std::this_thread::yield();
}

TEST(TaskRunner, RunsTheMostUrgentFirstAndTiesInTheOrderOfSubmission) {
  Log log;
  TaskRunner runner(0);
  runner.submit(task(log, 0), 5);
  runner.submit(task(log, 1), -2);
  runner.submit(task(log, 2), 5);
  runner.submit(task(log, 3), 0);
  EXPECT_EQ(runner.pending(), 4U);
  EXPECT_EQ(runner.unfinished(), 4U);
  stepEverything(runner);
  EXPECT_EQ(runner.pending(), 4U);
  EXPECT_EQ(runner.unfinished(), 0U);
  EXPECT_EQ(numbers(runner.takeFinished()), (std::vector<int>{1, 3, 0, 2}));
  EXPECT_EQ(runner.pending(), 0U);
}

TEST(TaskRunner, LetsAMoreUrgentTaskOvertakeOneThatIsHalfDone) {
  Log log;
  TaskRunner runner(0);
  SliceMeter meter;
  runner.submit(task(log, 0, 3), 1);
  const auto step = [&] {
    meter.beginFrame(SliceMeter::Clock::time_point::max());
    ASSERT_TRUE(meter.mayStart());
    ASSERT_TRUE(runner.stepHere(meter));
  };
  step();
  runner.submit(task(log, 1, 2), 0);
  for (int k = 0; k < 4; ++k) step();
  EXPECT_EQ(log.order, (std::vector<int>{0, 1, 1, 0, 0}));
}

TEST(TaskRunner, LetsAMoreUrgentTaskOvertakeOnAWorkerBetweenItsSlices) {
  Log log;
  std::atomic<bool> open{false};
  TaskRunner runner(1);
  runner.submit(task(log, 0, 2, &open), 1);
  waitUntilAtWork(log, 1);
  runner.submit(task(log, 1, 2), 0);
  open = true;
  takeMany(runner, 2);
  EXPECT_EQ(log.order, (std::vector<int>{0, 1, 1, 0}));
}

TEST(TaskRunner, NeverHandsOutACancelledTask) {
  Log log;
  TaskRunner runner(0);
  const auto waiting = runner.submit(task(log, 0), 0);
  runner.cancel(waiting);
  EXPECT_EQ(log.alive, 0);
  const auto done = runner.submit(task(log, 1), 0);
  stepEverything(runner);
  runner.cancel(done);
  EXPECT_EQ(log.alive, 0);
  const auto half = runner.submit(task(log, 2, 3), 0);
  SliceMeter meter;
  meter.beginFrame(SliceMeter::Clock::time_point::max());
  ASSERT_TRUE(meter.mayStart());
  ASSERT_TRUE(runner.stepHere(meter));
  runner.cancel(half);
  runner.cancel(half);
  runner.cancel(9999);
  stepEverything(runner);
  EXPECT_TRUE(runner.takeFinished().empty());
  EXPECT_EQ(log.alive, 0);
  EXPECT_EQ(runner.pending(), 0U);
}

TEST(TaskRunner, DropsATaskCancelledWhileAWorkerIsAtItBeItsLastStepOrNot) {
  for (const int steps : {1, 1'000'000}) {
    Log log;
    std::atomic<bool> open{false};
    TaskRunner runner(1);
    const auto ticket = runner.submit(task(log, 0, steps, &open), 0);
    waitUntilAtWork(log, 1);
    runner.cancel(ticket);
    EXPECT_EQ(runner.pending(), 0U);
    open = true;
    runner.submit(task(log, 1), 0);  // the only worker comes to it when it is rid of the first
    EXPECT_EQ(numbers(takeMany(runner, 1)), std::vector<int>{1}) << steps;
    EXPECT_EQ(log.order, (std::vector<int>{0, 1}));
    EXPECT_EQ(runner.pending(), 0U);
  }
}

TEST(TaskRunner, KeepsAllItsWorkersAtWork) {
  Log log;
  std::atomic<bool> open{false};
  TaskRunner runner(4);
  EXPECT_EQ(runner.workers(), 4);
  for (int number = 0; number < 20; ++number) runner.submit(task(log, number, 3, &open), number % 3);
  waitUntilAtWork(log, 4);
  open = true;
  std::set<int> seen;
  for (const int number : numbers(takeMany(runner, 20))) EXPECT_TRUE(seen.insert(number).second) << number;
  EXPECT_EQ(seen.size(), 20U);
  EXPECT_EQ(log.mostAtWork, 4);
  EXPECT_EQ(log.order.size(), 60U);
}

TEST(TaskRunner, EndsWithTasksWaitingRunningAndFinished) {
  for (const int workers : {0, 1, 3}) {
    Log log;
    {
      TaskRunner runner(workers);
      for (int number = 0; number < 50; ++number) runner.submit(task(log, number, 1 + number % 4), -number);
      runner.waitForFinished(milliseconds(1));
    }
    EXPECT_EQ(log.alive, 0) << workers;
  }
}

TEST(TaskRunner, NeverWaitsWhereNothingCouldBeFinished) {
  Log log;
  TaskRunner none(0);
  none.submit(task(log, 0), 0);
  none.waitForFinished(milliseconds(1'000'000));
  TaskRunner idle(2);
  idle.waitForFinished(milliseconds(1'000'000));
}

/// Random programs of submitting, cancelling, stepping and taking: every task comes out once or was
/// cancelled.
class TaskRunnerPrograms : public testing::TestWithParam<int> {};

TEST_P(TaskRunnerPrograms, HandOutEveryTaskOnceOrNever) {
  const std::uint64_t seed = 20261122;
  RecordProperty("seed", std::to_string(seed));
  for (std::uint64_t program = 0; program < 30; ++program) {
    RandomSequence random(hashWith(seed, program));
    Log log;
    TaskRunner runner(GetParam());
    SliceMeter meter;
    std::map<TaskRunner::Ticket, int> waiting;
    int submitted = 0;
    const auto take = [&] {
      for (const auto& one : runner.takeFinished()) {
        ASSERT_EQ(waiting.count(one.ticket), 1U) << "seed " << seed << ", program " << program;
        ASSERT_EQ(waiting[one.ticket], static_cast<CountedTask&>(*one.task).number());
        waiting.erase(one.ticket);
      }
    };
    for (int action = 0; action < 200; ++action) {
      switch (random.next() % 4) {
        case 0:
        case 1: {
          const auto steps = static_cast<int>(random.next() % 4) + 1;
          const auto urgency = static_cast<std::int64_t>(random.next() % 5) - 2;
          waiting.emplace(runner.submit(task(log, submitted, steps), urgency), submitted);
          ++submitted;
          break;
        }
        case 2:
          if (waiting.empty()) break;
          runner.cancel(waiting.begin()->first);
          waiting.erase(waiting.begin());
          break;
        default:
          meter.beginFrame(SliceMeter::Clock::time_point::max());
          ASSERT_TRUE(meter.mayStart());
          runner.stepHere(meter);
          take();
      }
      ASSERT_EQ(runner.pending(), waiting.size());
    }
    while (!waiting.empty()) {
      meter.beginFrame(SliceMeter::Clock::time_point::max());
      ASSERT_TRUE(meter.mayStart());
      if (!runner.stepHere(meter)) runner.waitForFinished(milliseconds(50));
      take();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Workers, TaskRunnerPrograms, testing::Values(0, 1, 4));

}  // namespace
}  // namespace teren
