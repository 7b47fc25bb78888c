#include "teren/World.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "tests/engine/world/RandomDraws.h"
#include "tests/engine/world/TestWorld.h"
#include "tests/engine/world/WorldDescriptions.h"
#include "world/Layer.h"

namespace teren {
namespace {

std::string refusal(const WorldDescription& description) {
  const auto world = World::create(description, testRegistry());
  return world.ok() ? "(accepted)" : world.error().message;
}

// ---- What is refused (law 8); what a file can say, plugins and their parameters too: tests/doors ----

struct Refused {
  std::string name;
  std::function<void(WorldDescription&)> spoil;
  std::vector<std::string> needles;
};

std::vector<Refused> refusedWorlds() {
  std::vector<Refused> cases;
  for (const int samples :
       {64, 66, 4, 3, 2, 1, 0, -65, 2049, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()}) {
    cases.push_back({"world samples",
                     [=](WorldDescription& w) { w.samples = samples; },
                     {"samples is " + std::to_string(samples), "2^k + 1 from 5 to 1025"}});
  }
  for (const int samples : {64, 2, 1, 0, -3, 4097, std::numeric_limits<int>::min()}) {
    cases.push_back(
        {"layer samples",
         [=](WorldDescription& w) { w.layers[1].samples = samples; },
         {"layer \"hash-noise\"", "samples is " + std::to_string(samples), "2^k + 1 from 3 to 2049"}});
  }
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(),
                   kInfinity = std::numeric_limits<double>::infinity();
  const std::pair<double, const char*> worldPitches[] = {{0.0, "0"},         {-64.0, "-64"},  {kNaN, "nan"},
                                                         {kInfinity, "inf"}, {1e-4, "1e-04"}, {2e6, "2e+06"}};
  for (const auto& [pitch, text] : worldPitches) {
    cases.push_back({"world pitch",
                     [p = pitch](WorldDescription& w) { w.pitch = p; },
                     {std::string("pitch is ") + text, "0.001"}});
  }
  const std::pair<double, const char*> layerPitches[] = {
      {32.0, "32"},  {96.0, "96"},       {64.0 + 1e-10, "64.0000000001"},   {0.0, "0"}, {-64.0, "-64"},
      {kNaN, "nan"}, {kInfinity, "inf"}, {64.0 * 0x1p41, "140737488355328"}};
  for (const auto& [pitch, text] : layerPitches) {
    cases.push_back({"layer pitch",
                     [p = pitch](WorldDescription& w) { w.layers[0].pitch = p; },
                     {"layer \"fault\"", std::string("pitch is ") + text, "64 m times 2^m"}});
  }
  cases.push_back({"no layers", [](WorldDescription& w) { w.layers.clear(); }, {"no layers"}});
  cases.push_back({"too many layers",
                   [](WorldDescription& w) { w.layers.resize(257, w.layers[0]); },
                   {"257 layers", "at most 256"}});
  cases.push_back(
      {"no generator", [](WorldDescription& w) { w.layers[1].generator = ""; }, {"layer \"\"", "\"\""}});
  return cases;
}

TEST(World, IsRefusedWithOneSentenceThatNamesLayerFieldAndValue) {
  for (const Refused& refused : refusedWorlds()) {
    SCOPED_TRACE(refused.name);
    WorldDescription description = worldOf({fault(64.0, 4.0), noise(64.0, 1.0)});
    ASSERT_EQ(refusal(description), "(accepted)");
    refused.spoil(description);
    const std::string sentence = refusal(description);
    for (const std::string& needle : refused.needles) {
      EXPECT_NE(sentence.find(needle), std::string::npos) << "no '" << needle << "' in: " << sentence;
    }
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    EXPECT_NE(sentence.back(), '.') << sentence;
  }
}

TEST(World, TakesTheSmallestAndTheLargestOfEverything) {
  WorldDescription small = worldOf({noise(0.001, 1.0, 3)});
  small.pitch = 0.001;
  small.samples = 5;
  EXPECT_EQ(makeTestWorld(small)->intervals(), 2);
  EXPECT_TRUE(std::isfinite(makeTestWorld(small)->height({0, 0, 0.3, 0.7})));
  WorldDescription large = worldOf({noise(1e6 * 0x1p40, 1.0, 2049)});
  large.pitch = 1e6;
  large.samples = 1025;
  const auto world = makeTestWorld(large);
  EXPECT_EQ(world->intervals(), 512);
  EXPECT_EQ(world->topLevel(), 9 + 40 - 2);
  EXPECT_TRUE(std::isfinite(world->height({kMaxPatch - 1, -kMaxPatch, 0.99, 0.01})));
  const SurfacePoint last = world->query({kMaxPatch - 1, kMaxPatch - 1, 1.0 - 0x1p-53, 1.0 - 0x1p-53});
  EXPECT_LE(std::fabs(last.height - last.drawn), last.error);
}

// ---- Names ----

std::vector<std::string> names(const WorldDescription& description) {
  std::vector<std::string> result;
  const auto world = makeTestWorld(description);
  for (const Layer& layer : world->layers()) result.push_back(layer.name());
  return result;
}

TEST(World, NamesLayersAfterTheirGeneratorAndNumbersRepetitions) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(worldOf({noise(64, 1), fault(64, 1), noise(64, 1), noise(128, 1), fault(64, 1)})),
            (Names{"hash-noise", "fault", "hash-noise-2", "hash-noise-3", "fault-2"}));
  EXPECT_EQ(names(worldOf({noise(64, 1), noise(64, 1, 65, "hills"), noise(64, 1)})),
            (Names{"hash-noise", "hills", "hash-noise-2"}));
  EXPECT_EQ(names(worldOf({noise(64, 1), noise(64, 1, 65, "hash-noise"), noise(64, 1, 65, "hash-noise-2"),
                           noise(64, 1)})),
            (Names{"hash-noise-3", "hash-noise", "hash-noise-2", "hash-noise-4"}));
}

TEST(World, NamesAsManyLayersAsThereMayBe) {
  const WorldDescription many =
      worldOf(std::vector<LayerDescription>(WorldDescription::kMostLayers, noise(64.0, 1.0)));
  EXPECT_EQ(names(many).back(), "hash-noise-256");
}

TEST(World, IsNotReshuffledByALayerInBetween) {
  constexpr std::uint64_t kSeed = 71;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const LayerDescription first = noise(64.0, 4.0, 65, "a"), last = noise(512.0, 40.0, 33, "b");
  const auto before = makeTestWorld(worldOf({first, last}));
  const auto after = makeTestWorld(worldOf({first, noise(128.0, 0.0, 17, "flat"), last}));
  for (int trial = 0; trial < 200; ++trial) {
    const Position at{below(random, 200) - 100, below(random, 200) - 100, uniform(random), uniform(random)};
    ASSERT_EQ(before->height(at), after->height(at));
  }
}

TEST(World, DependsOnItsSeedAndOnItsLayersNames) {
  const Position at{3, 4, 0.3, 0.7};
  const double height = makeTestWorld(worldOf({noise(64.0, 4.0, 65, "a")}, 1))->height(at);
  EXPECT_EQ(makeTestWorld(worldOf({noise(64.0, 4.0, 65, "a")}, 1))->height(at), height);
  EXPECT_NE(makeTestWorld(worldOf({noise(64.0, 4.0, 65, "a")}, 2))->height(at), height);
  EXPECT_NE(makeTestWorld(worldOf({noise(64.0, 4.0, 65, "b")}, 1))->height(at), height);
}

TEST(World, SumsTheMeansAndTheSquaresOfItsLayersPromises) {
  LayerDescription a = noise(64.0, 3.0), b = noise(512.0, 4.0);
  a.parameters.emplace_back("mean", 100.0);
  b.parameters.emplace_back("mean", -30.0);
  const auto world = makeTestWorld(worldOf({a, b}));
  EXPECT_DOUBLE_EQ(world->mean(), 70.0);
  EXPECT_DOUBLE_EQ(world->deviation(), 5.0);
  EXPECT_EQ(world->spacing(0), 2.0);
  EXPECT_EQ(world->spacing(3), 16.0);
}

// ---- Law 8: plugins that fail at work ----

TEST(World, GoesOnWithTheMeanOfALayerThatFailsAndSaysSoOnce) {
  LayerDescription broken = noise(64.0, 1.0);
  broken.generator = "hostile";
  broken.parameters = {};
  const LayerDescription sound = noise(512.0, 40.0, 65, "sound");
  const auto world = makeTestWorld(worldOf({broken, sound})), without = makeTestWorld(worldOf({sound}));
  for (int k = 0; k < 50; ++k) {
    const Position at{k, -k, 0.3, 0.6};
    ASSERT_EQ(world->height(at), without->height(at));
  }
  const std::vector<std::string> messages = world->takeMessages();
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_NE(messages[0].find("layer \"hostile\""), std::string::npos) << messages[0];
  EXPECT_TRUE(world->takeMessages().empty());
  EXPECT_TRUE(without->takeMessages().empty());
  EXPECT_FALSE(without->failure().has_value());
  ASSERT_TRUE(world->failure().has_value()) << "taking the messages does not take the failure";
  EXPECT_EQ(messages[0], *world->failure() + "; the layer's mean takes its place there");
}

TEST(World, StandardIsValidAndHasRangesHillsAndDetail) {
  const auto world = makeTestWorld(WorldDescription::standard());
  ASSERT_EQ(world->layers().size(), 3U);
  EXPECT_EQ(world->layers()[0].pitch(), 8192.0);
  EXPECT_EQ(world->layers()[1].pitch(), 1024.0);
  EXPECT_EQ(world->layers()[2].pitch(), 64.0);
  EXPECT_TRUE(std::isfinite(world->height({})));
  EXPECT_TRUE(world->takeMessages().empty());
}

}  // namespace
}  // namespace teren
