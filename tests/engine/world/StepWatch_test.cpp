// The rule is about processor time, so these tests burn it by the processor's own clock, or let the thread
// wait without using any; no test asserts how long anything took by the wall.
#include "world/StepWatch.h"

#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/ProcessorTime.h"

#include "tests/engine/world/HashNoise.h"
#include "tests/engine/world/TestLayer.h"

namespace teren {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

void burn(nanoseconds time) {
  const nanoseconds start = threadProcessorTime();
  while (threadProcessorTime() - start < time) {
  }
}

/// What the watch says of a step that does `work` in a slice of `length`.
std::optional<Overrun> watched(StepWatch& watch, Slice::Clock::duration length,
                               const std::function<void()>& work) {
  const Slice slice = Slice::lasting(length);
  const StepWatch::Start start = StepWatch::start(slice);
  work();
  return watch.finish(slice, start);
}

TEST(StepWatch, NoticesOneStepFarBeyondItsSlice) {
  StepWatch watch;
  const auto overrun = watched(watch, microseconds(20), [] { burn(milliseconds(30)); });
  ASSERT_TRUE(overrun.has_value());
  EXPECT_GE(overrun->used, milliseconds(29));  // the clock's reading may be a millisecond old
  EXPECT_LE(overrun->slice, microseconds(20));
}

TEST(StepWatch, NoticesStepsALittleBeyondTheirSlicesOnlyInARow) {
  StepWatch watch;
  const auto slow = [] { burn(milliseconds(3)); };
  for (int round = 0; round < 2; ++round) {
    for (int step = 1; step < StepWatch::kInARow; ++step)
      ASSERT_FALSE(watched(watch, microseconds(20), slow).has_value());
    ASSERT_FALSE(watched(watch, std::chrono::hours(1), [] {}).has_value()) << "a punctual step";
  }
  for (int step = 1; step < StepWatch::kInARow; ++step) watched(watch, microseconds(20), slow);
  EXPECT_TRUE(watched(watch, microseconds(20), slow).has_value());
}

TEST(StepWatch, DoesNotTakeWaitingForWorking) {
  StepWatch watch;
  for (int step = 0; step < 2 * StepWatch::kInARow; ++step) {
    ASSERT_FALSE(
        watched(watch, microseconds(20), [] { std::this_thread::sleep_for(milliseconds(25)); }).has_value());
  }
}

TEST(StepWatch, DoesNotCountWhatTheThreadDidBeforeTheStep) {
  StepWatch watch;
  for (int step = 0; step < 2 * StepWatch::kInARow; ++step) {
    const Slice slice = Slice::until(Slice::Clock::time_point::min());  // over from the start
    StepWatch::start(slice);
    burn(milliseconds(30));
    const StepWatch::Start start = StepWatch::start(slice);
    ASSERT_FALSE(watch.finish(slice, start).has_value());
  }
}

TEST(StepWatch, NeverJudgesUnlimitedSlices) {
  StepWatch watch;
  const Slice slice = Slice::unlimited();
  const StepWatch::Start start = StepWatch::start(slice);
  burn(milliseconds(30));
  EXPECT_FALSE(watch.finish(slice, start).has_value());
}

TEST(StepWatch, CountsAStepWithinItsSliceAsPunctualHoweverLong) {
  StepWatch watch;
  EXPECT_FALSE(watched(watch, std::chrono::hours(1), [] { burn(milliseconds(30)); }).has_value());
}

// ---- In a layer ----

/// Makes the noise of its base class; burns `begin` before the first step and `step` in every one.
class Sluggish final : public Generator {
 public:
  Sluggish(nanoseconds begin, nanoseconds step) : begin_(begin), step_(step), noise_(3.0, 5.0) {}
  HeightRange range() const override { return noise_.range(); }
  double residual(int level, int samples, double spacing) const override {
    return noise_.residual(level, samples, spacing);
  }
  std::unique_ptr<GenerationTask> begin(const MapRequest& request, HeightView out) const override {
    burn(begin_);
    return std::make_unique<Task>(noise_.begin(request, out), step_);
  }

 private:
  class Task final : public GenerationTask {
   public:
    Task(std::unique_ptr<GenerationTask> inner, nanoseconds time) : inner_(std::move(inner)), time_(time) {}
    bool step(const Slice& slice) override {
      burn(time_);
      return inner_->step(slice);
    }

   private:
    std::unique_ptr<GenerationTask> inner_;
    nanoseconds time_;
  };
  nanoseconds begin_, step_;
  HashNoise noise_;
};

BaseMap slicedMap(const Layer& layer, std::int64_t i, Slice::Clock::duration length) {
  BaseMapTask task(layer, {0, 0, i, 0});
  while (!task.step(Slice::lasting(length))) {
  }
  return task.result();
}

/// What is said after three maps in slices of 20 us.
std::vector<std::string> saidOf(std::shared_ptr<const Generator> generator) {
  const auto messages = std::make_shared<MessageBox>();
  const Layer layer = makeTestLayer({.layerBits = 2}, std::move(generator), {}, messages);
  for (int i = 0; i < 3; ++i) slicedMap(layer, i, microseconds(20));
  EXPECT_FALSE(messages->failure().has_value()) << "being slow is no failure";
  return messages->take();
}

TEST(Layer, NamesAPluginThatOverrunsAndBothTimesOnce) {
  const std::vector<std::string> said = saidOf(std::make_shared<Sluggish>(nanoseconds(0), milliseconds(30)));
  ASSERT_EQ(said.size(), 1U);
  for (const char* part : {"layer \"test\"", "plugin \"generator\"", " ms of processor time", "given 0"})
    EXPECT_NE(said[0].find(part), std::string::npos) << said[0];
  EXPECT_EQ(said[0].find('\n'), std::string::npos) << said[0];
}

TEST(Layer, NamesAPluginThatOverrunsBeforeItsFirstStep) {
  EXPECT_EQ(saidOf(std::make_shared<Sluggish>(milliseconds(30), nanoseconds(0))).size(), 1U);
}

TEST(Layer, NamesTheFilterThatOverrunsAndNotTheGenerator) {
  class Lazy final : public Filter {
   public:
    HeightRange range(const HeightRange& before) const override { return before; }
    double residual(double before, int) const override { return before; }
    std::unique_ptr<SlicedTask> begin(const MapRequest&, HeightView) const override {
      class Task final : public SlicedTask {
       public:
        bool step(const Slice&) override { return burn(milliseconds(30)), true; }
      };
      return std::make_unique<Task>();
    }
  };
  const auto messages = std::make_shared<MessageBox>();
  const Layer layer = makeTestLayer({.layerBits = 2}, std::make_shared<HashNoise>(3.0, 5.0),
                                    {std::make_shared<Lazy>(), std::make_shared<Lazy>()}, messages);
  slicedMap(layer, 0, microseconds(20));
  slicedMap(layer, 1, microseconds(20));
  const std::vector<std::string> said = messages->take();
  ASSERT_EQ(said.size(), 2U);
  EXPECT_NE(said[0].find("plugin \"filter-0\""), std::string::npos) << said[0];
  EXPECT_NE(said[1].find("plugin \"filter-1\""), std::string::npos) << said[1];
}

TEST(Layer, AccusesNoWellBehavedPluginUnderShortSlices) {
  EXPECT_TRUE(saidOf(std::make_shared<HashNoise>(3.0, 5.0)).empty());
}

TEST(Layer, HasTheSameHeightsHoweverSlowItsPlugin) {
  const Layer swift = makeTestLayer({.layerBits = 2}, std::make_shared<HashNoise>(3.0, 5.0));
  const Layer slow =
      makeTestLayer({.layerBits = 2}, std::make_shared<Sluggish>(milliseconds(25), milliseconds(25)));
  const BaseMap expected = makeMap(swift, 5, 0), found = slicedMap(slow, 5, microseconds(20));
  for (std::size_t k = 0; k < expected->samples().size(); ++k)
    ASSERT_EQ(found->samples()[k], expected->samples()[k]);
}

}  // namespace
}  // namespace teren
