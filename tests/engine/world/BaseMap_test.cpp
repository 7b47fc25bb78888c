#include "world/BaseMap.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "teren/StepLimit.h"

#include "tests/engine/world/HashNoise.h"
#include "tests/engine/world/TestLayer.h"
#include "tests/engine/world/ToldTask.h"

namespace teren {
namespace {

bool sameBits(const HeightMap& a, const HeightMap& b) {
  return std::equal(
      a.samples().begin(), a.samples().end(), b.samples().begin(), b.samples().end(),
      [](float x, float y) { return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y); });
}

using Begin = std::function<std::unique_ptr<SlicedTask>(const MapRequest&, HeightView)>;

/// Promises a mean of 12 m between 2 and 22 m, and does what it is told.
class HostileGenerator final : public Generator {
 public:
  explicit HostileGenerator(Begin begin) : begin_(std::move(begin)) {}
  HeightRange range() const override { return {12.0, 3.0, 2.0, 22.0}; }
  double residual(int, int, double) const override { return 0.0; }
  std::unique_ptr<GenerationTask> begin(const MapRequest& request, HeightView out) const override {
    return begin_(request, out);
  }

 private:
  Begin begin_;
};

class HostileFilter final : public Filter {
 public:
  explicit HostileFilter(Begin begin) : begin_(std::move(begin)) {}
  HeightRange range(const HeightRange& before) const override { return before; }
  double residual(double before, int) const override { return before; }
  std::unique_ptr<SlicedTask> begin(const MapRequest& request, HeightView inOut) const override {
    return begin_(request, inOut);
  }

 private:
  Begin begin_;
};

/// Fills the map with 15 m and then writes `height` at one sample.
Begin writes(float height) {
  return [height](const MapRequest&, HeightView out) {
    return std::make_unique<ToldTask>([=] {
      for (int y = 0; y < out.rows(); ++y) std::fill_n(out.row(y), out.columns(), 15.0F);
      out(out.columns() - 1, out.rows() - 1) = height;
      return true;
    });
  };
}

Begin stepDoes(std::function<bool()> step) {
  return [step](const MapRequest&, HeightView) { return std::make_unique<ToldTask>(step); };
}

struct Hostile {
  std::string name;
  Begin begin;
  std::string needle;  ///< what the message must say
};

std::vector<Hostile> hostilePlugins() {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  return {
      {"step throws std::exception", stepDoes([]() -> bool { throw std::runtime_error("no\nluck"); }),
       "\"no?luck\""},
      {"step throws int", stepDoes([]() -> bool { throw 42; }), "no std::exception"},
      {"step throws after half the work",
       [](const MapRequest&, HeightView out) {
         out(0, 0) = std::numeric_limits<float>::quiet_NaN();
         return std::make_unique<ToldTask>([steps = 0]() mutable -> bool {
           if (++steps == 3) throw std::logic_error("tired");
           return false;
         });
       },
       "\"tired\""},
      {"begin throws std::exception",
       [](const MapRequest&, HeightView) -> std::unique_ptr<SlicedTask> { throw std::bad_alloc(); },
       "bad_alloc"},
      {"begin throws a text",
       [](const MapRequest&, HeightView) -> std::unique_ptr<SlicedTask> { throw "text"; },
       "no std::exception"},
      {"begin gives no task", [](const MapRequest&, HeightView) { return std::unique_ptr<SlicedTask>(); },
       "no task"},
      {"writes NaN", writes(kNaN), "nan"},
      {"writes infinity", writes(kInfinity), "inf"},
      {"writes minus infinity", writes(-kInfinity), "-inf"},
      {"goes above its range", writes(std::nextafter(22.0F, 100.0F)), "22.0000"},
      {"goes below its range", writes(1.5F), "1.5 m"},
      {"is never done", stepDoes([] { return false; }), "is not done after "},
  };
}

BaseMap finished(const Layer& layer, const BaseMapKey& key) {
  BaseMapTask task(layer, key);
  while (!task.step(Slice::unlimited())) {
  }
  return task.result();
}

void expectMeanEverywhere(const HeightMap& map, int samples) {
  EXPECT_EQ(map.columns(), samples);
  EXPECT_EQ(map.rows(), samples);
  for (const float height : map.samples()) ASSERT_EQ(height, 12.0F);
}

TEST(BaseMap, OfAHostileGeneratorIsTheMeanEverywhereAndOneMessageIsKept) {
  for (const Hostile& hostile : hostilePlugins()) {
    SCOPED_TRACE(hostile.name);
    const auto messages = std::make_shared<MessageBox>();
    const Layer layer =
        makeTestLayer({.layerBits = 3}, std::make_shared<HostileGenerator>(hostile.begin), {}, messages);
    expectMeanEverywhere(*finished(layer, {0, 0, 3, -4}), 17);
    expectMeanEverywhere(*finished(layer, {0, 1, 3, -4}), 9);
    const std::vector<std::string> said = messages->take();
    ASSERT_EQ(said.size(), 1U);
    EXPECT_NE(said[0].find("\"test\""), std::string::npos) << said[0];
    EXPECT_NE(said[0].find("(3, -4)"), std::string::npos) << said[0];
    EXPECT_NE(said[0].find(hostile.needle), std::string::npos) << said[0];
    EXPECT_EQ(said[0].find('\n'), std::string::npos) << said[0];
    finished(layer, {0, 2, 9, 9});
    EXPECT_TRUE(messages->take().empty()) << "the layer was reported before";
  }
}

TEST(BaseMap, OfAHostileFilterIsTheMeanEverywhereAndOneMessageIsKept) {
  for (const Hostile& hostile : hostilePlugins()) {
    SCOPED_TRACE(hostile.name);
    const auto messages = std::make_shared<MessageBox>();
    const Layer layer = makeTestLayer({.layerBits = 2}, std::make_shared<HostileGenerator>(writes(15.0F)),
                                      {std::make_shared<HostileFilter>(hostile.begin)}, messages);
    expectMeanEverywhere(*finished(layer, {0, 0, 0, 0}), 9);
    const std::vector<std::string> said = messages->take();
    ASSERT_EQ(said.size(), 1U);
    EXPECT_NE(said[0].find(hostile.needle), std::string::npos) << said[0];
  }
}

TEST(BaseMap, GivesUpATaskAfterTheStepsThatAMapOfItsSizeMayTake) {
  for (const int layerBits : {0, 3, 5}) {
    std::int64_t steps = 0;
    const auto messages = std::make_shared<MessageBox>();
    const auto counting = std::make_shared<HostileGenerator>(stepDoes([&steps] {
      ++steps;
      return false;
    }));
    const Layer layer = makeTestLayer({.layerBits = layerBits}, counting, {}, messages);
    const int samples = (2 << layerBits) + 1;
    expectMeanEverywhere(*finished(layer, {0, 0, 0, 0}), samples);
    EXPECT_EQ(steps, stepLimit(samples, samples));
    EXPECT_NE(messages->take().at(0).find("is not done after " + std::to_string(steps) + " steps"),
              std::string::npos);
  }
}

TEST(BaseMap, CountsTheStepsOfEachOfItsPluginsByItself) {
  const auto lasts = [](std::int64_t most) {
    return [most](const MapRequest& request, HeightView map) {
      return std::make_unique<ToldTask>([=, steps = std::int64_t{0}]() mutable {
        for (int y = 0; y < map.rows(); ++y) std::fill_n(map.row(y), map.columns(), 15.0F);
        return ++steps == stepLimit(request.samples, request.samples) + most;
      });
    };
  };
  const auto messages = std::make_shared<MessageBox>();
  const Layer layer = makeTestLayer(
      {.layerBits = 0}, std::make_shared<HostileGenerator>(lasts(0)),
      {std::make_shared<HostileFilter>(lasts(0)), std::make_shared<HostileFilter>(lasts(0))}, messages);
  EXPECT_EQ((*finished(layer, {0, 0, 0, 0}))(1, 1), 15.0F);
  EXPECT_TRUE(messages->take().empty());
  const Layer endless =
      makeTestLayer({.layerBits = 0}, std::make_shared<HostileGenerator>(lasts(1)), {}, messages);
  expectMeanEverywhere(*finished(endless, {0, 0, 0, 0}), 3);
}

TEST(BaseMap, KeepsHeightsAtTheVeryEndsOfItsRange) {
  for (const float height : {2.0F, 22.0F}) {
    const auto messages = std::make_shared<MessageBox>();
    const Layer layer =
        makeTestLayer({.layerBits = 2}, std::make_shared<HostileGenerator>(writes(height)), {}, messages);
    EXPECT_EQ((*finished(layer, {0, 0, 0, 0}))(8, 8), height);
    EXPECT_TRUE(messages->take().empty());
  }
}

TEST(BaseMap, OfAGoodPluginStaysGoodBesideMapsThatFail) {
  const Begin sometimes = [](const MapRequest& request, HeightView out) {
    return writes(request.i == 0 ? std::numeric_limits<float>::quiet_NaN() : 16.0F)(request, out);
  };
  const Layer layer = makeTestLayer({.layerBits = 2}, std::make_shared<HostileGenerator>(sometimes));
  expectMeanEverywhere(*finished(layer, {0, 0, 0, 0}), 9);
  EXPECT_EQ((*finished(layer, {0, 0, 1, 0}))(8, 8), 16.0F);
  EXPECT_EQ((*finished(layer, {0, 0, 1, 0}))(0, 0), 15.0F);
}

TEST(BaseMap, RunsItsFiltersInTheirOrderOnTheGeneratorsMap) {
  const auto changes = [](std::function<float(float)> change) {
    return std::make_shared<HostileFilter>([change](const MapRequest&, HeightView inOut) {
      return std::make_unique<ToldTask>([=] {
        for (int y = 0; y < inOut.rows(); ++y) {
          std::transform(inOut.row(y), inOut.row(y) + inOut.columns(), inOut.row(y), change);
        }
        return true;
      });
    });
  };
  const Layer layer =
      makeTestLayer({.layerBits = 2}, std::make_shared<HostileGenerator>(writes(15.0F)),
                    {changes([](float h) { return h - 10.0F; }), changes([](float h) { return 2.0F * h; })});
  EXPECT_EQ((*finished(layer, {0, 0, 0, 0}))(3, 3), 10.0F);  // (15 - 10) * 2, not 15 * 2 - 10
}

TEST(BaseMap, HasTheSameBitsForAnySlicing) {
  const Layer layer = makeTestLayer({.layerBits = 4}, std::make_shared<HashNoise>(3.0, 5.0));
  BaseMapTask sliced(layer, {0, 0, -7, 1});
  int steps = 1;
  while (!sliced.step(Slice::until(Slice::Clock::time_point::min()))) ++steps;
  EXPECT_GE(steps, 33) << "a slice that is over should end the step";
  EXPECT_TRUE(sameBits(*sliced.result(), *finished(layer, {0, 0, -7, 1})));
}

TEST(BaseMap, AsksThePluginForWhatItsPlaceAndLevelSay) {
  std::vector<MapRequest> asked;
  const auto note = [&asked](const MapRequest& request, HeightView out) {
    asked.push_back(request);
    return writes(15.0F)(request, out);
  };
  const Layer layer = makeTestLayer({.seed = 9, .worldBits = 5, .pitchShift = 3, .layerBits = 4},
                                    std::make_shared<HostileGenerator>(note));
  for (int level = 0; level <= 6; ++level) finished(layer, {0, level, -5, std::int64_t{1} << 40});
  const int samples[] = {33, 17, 9, 5, 3, 1, 1};
  ASSERT_EQ(asked.size(), 7U);
  for (std::size_t level = 0; level < 7; ++level) {
    SCOPED_TRACE(level);
    EXPECT_EQ(asked[level].i, -5);
    EXPECT_EQ(asked[level].j, std::int64_t{1} << 40);
    EXPECT_EQ(asked[level].seed, mapSeed(9, "test", -5, std::int64_t{1} << 40));
    EXPECT_EQ(asked[level].level, static_cast<int>(level));
    EXPECT_EQ(asked[level].samples, samples[level]);
    EXPECT_EQ(asked[level].finestIntervals, 32);
    EXPECT_EQ(asked[level].spacing, 512.0 / 16 * static_cast<double>(1 << level));
  }
}

class BaseMapStoreTest : public testing::Test {
 protected:
  BaseMapStoreTest() : layer_(makeTestLayer({.layerBits = 4}, std::make_shared<HashNoise>(0.0, 1.0))) {
    BaseMapStore probe(std::numeric_limits<std::size_t>::max());
    probe.insert(key(0), finished(layer_, key(0)));
    cost_ = probe.bytes();
  }
  static BaseMapKey key(std::int64_t i) { return {0, 0, i, -i}; }
  void insert(BaseMapStore& store, std::int64_t i) { store.insert(key(i), finished(layer_, key(i))); }

  Layer layer_;
  std::size_t cost_ = 0;
};

TEST_F(BaseMapStoreTest, CountsWhatAMapHolds) {
  EXPECT_GE(cost_, 33 * 33 * sizeof(float));
}

TEST_F(BaseMapStoreTest, DropsTheLeastRecentlyUsedBeyondItsCapacity) {
  BaseMapStore store(3 * cost_);
  for (int i = 0; i < 3; ++i) insert(store, i);
  EXPECT_EQ(store.bytes(), 3 * cost_);
  ASSERT_NE(store.find(key(0)), nullptr);  // now 1 is the oldest
  insert(store, 3);
  EXPECT_EQ(store.bytes(), 3 * cost_);
  EXPECT_EQ(store.find(key(1)), nullptr);
  for (const int kept : {0, 2, 3}) EXPECT_NE(store.find(key(kept)), nullptr) << kept;
}

TEST_F(BaseMapStoreTest, KeepsTheLatestMapHoweverSmallItsCapacity) {
  BaseMapStore store(1);
  insert(store, 0);
  EXPECT_NE(store.find(key(0)), nullptr);
  insert(store, 1);
  EXPECT_EQ(store.find(key(0)), nullptr);
  EXPECT_NE(store.find(key(1)), nullptr);
  EXPECT_EQ(store.bytes(), cost_);
}

TEST_F(BaseMapStoreTest, KeepsHeldMapsAliveAndMakesDroppedOnesAgainToTheSameBits) {
  BaseMapStore store(cost_);
  insert(store, 7);
  const BaseMap held = store.find(key(7));
  insert(store, 8);
  ASSERT_EQ(store.find(key(7)), nullptr);
  insert(store, 7);
  const BaseMap again = store.find(key(7));
  ASSERT_NE(again, nullptr);
  EXPECT_NE(again, held);
  EXPECT_TRUE(sameBits(*again, *held));
}

TEST_F(BaseMapStoreTest, KeepsTheFirstOfTwoMapsOfOneKeyAndCountsItOnce) {
  BaseMapStore store(10 * cost_);
  insert(store, 1);
  const BaseMap first = store.find(key(1));
  insert(store, 1);
  EXPECT_EQ(store.find(key(1)), first);
  EXPECT_EQ(store.bytes(), cost_);
}

TEST_F(BaseMapStoreTest, TellsKeysApartByEachOfTheirParts) {
  BaseMapStore store(100 * cost_);
  store.insert({0, 0, 5, 6}, finished(layer_, {0, 0, 5, 6}));
  EXPECT_EQ(store.find({1, 0, 5, 6}), nullptr);
  EXPECT_EQ(store.find({0, 1, 5, 6}), nullptr);
  EXPECT_EQ(store.find({0, 0, 6, 5}), nullptr);
  EXPECT_EQ(store.find({0, 0, -5, 6}), nullptr);
  EXPECT_NE(store.find({0, 0, 5, 6}), nullptr);
}

}  // namespace
}  // namespace teren
