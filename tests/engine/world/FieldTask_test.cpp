#include "world/FieldTask.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "teren/HeightMapOperations.h"
#include "teren/ProcessorTime.h"
#include "teren/StepLimit.h"

#include "tests/engine/world/RandomDraws.h"
#include "tests/engine/world/TestLayer.h"
#include "tests/engine/world/ToldTask.h"
#include "tests/engine/world/ValueNoise.h"
#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

using Begin = std::function<std::unique_ptr<SlicedTask>(const FieldRequest&, HeightView)>;

/// Promises a mean of 12 m between 2 and 22 m, and does what it is told.
class ToldField final : public ContinuousGenerator {
 public:
  explicit ToldField(Begin begin) : begin_(std::move(begin)) {}
  HeightRange range() const override { return {12.0, 3.0, 2.0, 22.0}; }
  double residual(int, int, double) const override { return 0.0; }
  double fieldError(double) const override { return 0.0; }
  std::unique_ptr<GenerationTask> beginField(const FieldRequest& request, HeightView out) const override {
    return begin_(request, out);
  }

 private:
  Begin begin_;
};

struct Outcome {
  HeightMap heights;
  bool failed = false;
  std::vector<std::string> said;
};

Outcome outcomeOf(Begin begin, int columns, int rows, const Slice& slice = Slice::unlimited()) {
  const auto messages = std::make_shared<MessageBox>();
  const Layer layer = makeTestLayer({}, std::make_shared<ToldField>(std::move(begin)), {}, messages);
  HeightMap heights(columns, rows);
  fillHeights(heights.view(), 17.0F);  // what an earlier layer left there, say
  FieldTask task(layer, layer.fieldRequest({.i = 3, .j = -4}, 0, columns, rows), heights.view());
  test::finish(task, slice);
  return {std::move(heights), task.failed(), messages->take()};
}

/// Fills with 15 m but for `height` at column 2 of row 1.
Begin writes(float height) {
  return [height](const FieldRequest&, HeightView out) {
    return makeRowTask(out, [=](int row) {
      std::fill_n(out.row(row), out.columns(), 15.0F);
      if (row == 1) out(2, 1) = height;
    });
  };
}

TEST(FieldTask, PutsTheMeanInPlaceOfABadSampleAloneAndSaysSoOnce) {
  const std::pair<float, const char*> cases[] = {{kNaN, "nan m"},
                                                 {std::numeric_limits<float>::infinity(), "inf m"},
                                                 {std::nextafter(22.0F, 100.0F), "22.0000"},
                                                 {1.5F, "1.5 m"}};
  for (const auto& [height, needle] : cases) {
    SCOPED_TRACE(needle);
    const Outcome outcome = outcomeOf(writes(height), 5, 3);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 5; ++column)
        EXPECT_EQ(outcome.heights(column, row), row == 1 && column == 2 ? 12.0F : 15.0F);
    }
    EXPECT_TRUE(outcome.failed);
    ASSERT_EQ(outcome.said.size(), 1U);
    for (const char* part : {"layer \"test\"", "plugin \"generator\" wrote the height", needle,
                             "outside the promised range of 2 to 22 m", "lattice point (3, -4)"})
      EXPECT_NE(outcome.said[0].find(part), std::string::npos) << outcome.said[0];
  }
}

TEST(FieldTask, KeepsHeightsAtTheVeryEndsOfTheRange) {
  for (const float height : {2.0F, 22.0F}) {
    const Outcome outcome = outcomeOf(writes(height), 5, 3);
    EXPECT_EQ(outcome.heights(2, 1), height);
    EXPECT_FALSE(outcome.failed);
    EXPECT_TRUE(outcome.said.empty());
  }
}

TEST(FieldTask, TakesNothingThatHappenedToLieThereForASample) {
  const Outcome outcome = outcomeOf(
      [](const FieldRequest&, HeightView out) {
        return std::make_unique<ToldTask>([out] { return out(0, 0) = 15.0F, true; });
      },
      3, 2);
  EXPECT_EQ(outcome.heights(0, 0), 15.0F);
  EXPECT_EQ(outcome.heights(2, 1), 12.0F);
  EXPECT_TRUE(outcome.failed);
}

TEST(FieldTask, IsTheMeanAllOverWhereThePluginThrowsBeginsNothingOrIsNeverDone) {
  const auto stepDoes = [](std::function<bool()> step) -> Begin {
    return [step](const FieldRequest&, HeightView out) {
      std::fill_n(out.row(0), out.columns(), 15.0F);
      return std::make_unique<ToldTask>(step);
    };
  };
  const std::pair<Begin, const char*> cases[] = {
      {stepDoes([]() -> bool { throw std::runtime_error("no\nluck"); }), "threw \"no?luck\""},
      {stepDoes([]() -> bool { throw 42; }), "threw something that is no std::exception"},
      {[](const FieldRequest&, HeightView) -> std::unique_ptr<SlicedTask> { throw std::bad_alloc(); },
       "bad_alloc"},
      {[](const FieldRequest&, HeightView) { return std::unique_ptr<SlicedTask>(); }, "began no task"},
      {stepDoes([] { return false; }), "is not done after 32768 steps"}};
  for (const auto& [begin, needle] : cases) {
    SCOPED_TRACE(needle);
    const Outcome outcome = outcomeOf(begin, 3, 2);
    for (const float height : outcome.heights.samples()) EXPECT_EQ(height, 12.0F);
    EXPECT_TRUE(outcome.failed);
    ASSERT_EQ(outcome.said.size(), 1U);
    EXPECT_NE(outcome.said[0].find(needle), std::string::npos) << outcome.said[0];
  }
}

TEST(FieldTask, GivesUpAfterTheStepsThatARectangleOfItsSizeMayTake) {
  std::int64_t steps = 0;
  outcomeOf([&steps](const FieldRequest&,
                     HeightView) { return std::make_unique<ToldTask>([&steps] { return ++steps, false; }); },
            65, 3);
  EXPECT_EQ(steps, stepLimit(65, 3));
}

TEST(FieldTask, NamesAPluginThatOverrunsItsSliceAndKeepsItsHeights) {
  const auto slow = [](const FieldRequest&, HeightView out) {
    return std::make_unique<ToldTask>([out] {
      const auto start = threadProcessorTime();
      while (threadProcessorTime() - start < std::chrono::milliseconds(30)) {
      }
      fillHeights(out, 15.0F);
      return true;
    });
  };
  const Outcome outcome = outcomeOf(slow, 5, 3, Slice::lasting(std::chrono::microseconds(20)));
  EXPECT_EQ(outcome.heights(2, 1), 15.0F);
  EXPECT_FALSE(outcome.failed);
  ASSERT_EQ(outcome.said.size(), 1U);
  EXPECT_NE(outcome.said[0].find("processor time"), std::string::npos) << outcome.said[0];
}

TEST(FieldTask, IsCutIntoAtLeastAStepARowAndAsManyForTheDoor) {
  const auto messages = std::make_shared<MessageBox>();
  const Layer layer = makeTestLayer({}, std::make_shared<ValueNoise>(0.0, 10.0, 64.0), {}, messages);
  HeightMap whole(33, 33), sliced(33, 33);
  const FieldRequest request = layer.fieldRequest({.i = -1}, 0, 33, 33);
  FieldTask once(layer, request, whole.view()), often(layer, request, sliced.view());
  EXPECT_EQ(test::finish(once), 1);
  EXPECT_GE(test::finish(often, test::shortestSlice()), 2 * 33);
  EXPECT_TRUE(test::sameBits(whole.view(), sliced.view()));
  EXPECT_TRUE(messages->take().empty());
}

// ---- What is asked for ----

/// The field's sample as the engine asks for it, at level 0.
float at(const Layer& layer, const Position& position) {
  HeightMap height(1, 1);
  FieldTask task(layer, layer.fieldRequest(position, 0, 1, 1), height.view());
  test::finish(task);
  return height(0, 0);
}

TEST(Layer, AsksForAFieldByLatticePointAndOffset) {
  const Layer layer =
      makeTestLayer({.seed = 5, .worldBits = 5, .pitchShift = 3}, std::make_shared<ValueNoise>(0, 1, 64));
  const FieldRequest request = layer.fieldRequest({.i = -3, .j = 21, .u = 0.5, .v = 0.25}, 2, 33, 17);
  EXPECT_EQ(request.i, -1);
  EXPECT_EQ(request.j, 2);
  EXPECT_EQ(request.u, 5.5 / 8.0);
  EXPECT_EQ(request.v, 5.25 / 8.0);
  EXPECT_EQ(request.seed, layerSeed(5, "test"));
  EXPECT_EQ(request.pitch, 512.0);
  EXPECT_EQ(request.spacing, 8.0);
  EXPECT_EQ(request.columns, 33);
  EXPECT_EQ(request.rows, 17);
  EXPECT_EQ(request.level, 2);
}

TEST(Layer, PlacesEverySampleOfTheGridExactlyHoweverFarAway) {
  // The world's last patch, a pitch of 2^40 patches with 2^9 samples each: 2^-49 pitches from sample to
  // sample.
  const Layer layer =
      makeTestLayer({.worldBits = 9, .pitchShift = 40}, std::make_shared<ValueNoise>(0, 1, 64));
  const FieldRequest request =
      layer.fieldRequest({.i = kMaxPatch - 1, .j = -kMaxPatch, .u = 511.0 / 512.0}, 0, 2, 2);
  EXPECT_EQ(request.i, (std::int64_t{1} << 12) - 1);
  EXPECT_EQ(request.u, 1.0 - 0x1p-49);
  EXPECT_EQ(request.u + request.spacing / request.pitch, 1.0);
  EXPECT_EQ(request.j, -(std::int64_t{1} << 12));
  EXPECT_EQ(request.v, 0.0);
}

TEST(Layer, CountsAPlaceThatIsRoundedToTheNextLatticeLineFromThere) {
  const Layer layer = makeTestLayer({.pitchShift = 40}, std::make_shared<ValueNoise>(0, 1, 64));
  const FieldRequest request =
      layer.fieldRequest({.i = -1, .j = -1, .u = 1.0 - 0x1p-53, .v = 1.0 - 0x1p-12}, 0, 1, 1);
  EXPECT_EQ(request.i, 0);
  EXPECT_EQ(request.u, 0.0);
  EXPECT_EQ(request.j, -1);
  EXPECT_EQ(request.v, 1.0 - 0x1p-52);
}

TEST(FieldTask, GivesASampleTheSameBitsWhateverRectangleItLiesIn) {
  constexpr std::uint64_t kSeed = 95;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  for (const std::int64_t base : {std::int64_t{0}, std::int64_t{1} << 40, kMaxPatch - 5, 3 - kMaxPatch}) {
    for (const int shift : {0, 3, 40}) {
      SCOPED_TRACE(testing::Message() << "patch " << base << ", pitch of 2^" << shift << " patches");
      const Layer layer =
          makeTestLayer({.worldBits = 4, .pitchShift = shift}, std::make_shared<ValueNoise>(5.0, 10.0, 16.0));
      HeightMap whole(49, 33);
      FieldTask task(layer, layer.fieldRequest({.i = base, .j = -base - 2}, 0, 49, 33), whole.view());
      test::finish(task);
      for (int trial = 0; trial < 100; ++trial) {
        const int x = below(random, 49), y = below(random, 33);
        const Position place{base + x / 16, -base - 2 + y / 16, (x % 16) / 16.0, (y % 16) / 16.0};
        ASSERT_EQ(at(layer, place), whole(x, y)) << x << ", " << y;
      }
    }
  }
}

}  // namespace
}  // namespace teren
