#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "teren/World.h"

namespace teren {
namespace {

WorldDescription read(const std::string& text) {
  Result<WorldDescription> world = WorldDescription::fromJson(text, "w.json");
  EXPECT_TRUE(world.ok()) << (world.ok() ? "" : world.error().message);
  return world.ok() ? *world : WorldDescription{};
}

std::string refusal(const std::string& text) {
  const Result<WorldDescription> world = WorldDescription::fromJson(text, "w.json");
  return world.ok() ? "(accepted)" : world.error().message;
}

/// One sentence as Error asks for: one line of printable text, of bounded length, no trailing full stop.
void expectOneSentence(const std::string& sentence) {
  EXPECT_FALSE(sentence.empty());
  EXPECT_LE(sentence.size(), 400U) << sentence;
  EXPECT_NE(sentence.back(), '.') << sentence;
  for (const char c : sentence) EXPECT_GE(static_cast<unsigned char>(c), 0x20) << sentence;
}

TEST(WorldJson, ReadsEveryKey) {
  const WorldDescription world = read(R"({
    "seed": 18446744073709551615, "pitch": 32.5, "samples": 33, "blend": "linear", "preserveVariance": false,
    "layers": [
      { "name": "hills", "generator": "fault", "parameters": { "faults": 150, "deviation": 2.5, "on": true,
        "rule": "published" }, "pitch": 65, "samples": 17, "blend": "smooth", "preserveVariance": true,
        "filters": [ { "filter": "band", "parameters": { "k": 0.9, "passes": 5 } }, { "filter": "band" } ] } ] })");
  EXPECT_EQ(world.seed, std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(world.pitch, 32.5);
  EXPECT_EQ(world.samples, 33);
  ASSERT_EQ(world.layers.size(), 1U);
  const LayerDescription& layer = world.layers[0];
  EXPECT_EQ(layer.name, "hills");
  EXPECT_EQ(layer.generator, "fault");
  const std::vector<Values::Entry> parameters = {
      {"deviation", 2.5}, {"faults", std::int64_t{150}}, {"on", true}, {"rule", std::string("published")}};
  EXPECT_EQ(layer.parameters, parameters);
  EXPECT_EQ(layer.pitch, 65.0);
  EXPECT_EQ(layer.samples, 17);
  EXPECT_EQ(layer.blend, BlendKernel::smooth);
  EXPECT_TRUE(layer.preserveVariance);
  ASSERT_EQ(layer.filters.size(), 2U);
  EXPECT_EQ(layer.filters[0].filter, "band");
  const std::vector<Values::Entry> filterParameters = {{"k", 0.9}, {"passes", std::int64_t{5}}};
  EXPECT_EQ(layer.filters[0].parameters, filterParameters);
  EXPECT_TRUE(layer.filters[1].parameters.empty());
}

TEST(WorldJson, GivesTheFixedDefaultsToAWorldThatNamesOnlyItsLayers) {
  const WorldDescription world = read(R"({"layers": [{"generator": "fault"}]})");
  EXPECT_EQ(world.seed, 0U);
  EXPECT_EQ(world.pitch, 64.0);
  EXPECT_EQ(world.samples, 65);
  const LayerDescription& layer = world.layers.at(0);
  EXPECT_EQ(layer.name, "");
  EXPECT_TRUE(layer.parameters.empty());
  EXPECT_TRUE(layer.filters.empty());
  EXPECT_EQ(layer.pitch, 64.0);
  EXPECT_EQ(layer.samples, 65);
  EXPECT_EQ(layer.blend, BlendKernel::smooth);
  EXPECT_TRUE(layer.preserveVariance);
}

TEST(WorldJson, GivesTheWorldsValuesToLayersThatNameNone) {
  const WorldDescription world =
      read(R"({"pitch": 16, "samples": 9, "blend": "linear", "preserveVariance": false,
      "layers": [{"generator": "a"}, {"generator": "b", "samples": 5, "blend": "smooth"}]})");
  EXPECT_EQ(world.layers.at(0).pitch, 16.0);
  EXPECT_EQ(world.layers.at(0).samples, 9);
  EXPECT_EQ(world.layers.at(0).blend, BlendKernel::linear);
  EXPECT_FALSE(world.layers.at(0).preserveVariance);
  EXPECT_EQ(world.layers.at(1).samples, 5);
  EXPECT_EQ(world.layers.at(1).blend, BlendKernel::smooth);
  EXPECT_FALSE(world.layers.at(1).preserveVariance);
}

TEST(WorldJson, KeepsTheOrderOfTheLayers) {
  const WorldDescription world =
      read(R"({"layers": [{"generator": "z"}, {"generator": "a"}, {"generator": "m"}]})");
  EXPECT_EQ(world.layers.at(0).generator, "z");
  EXPECT_EQ(world.layers.at(1).generator, "a");
  EXPECT_EQ(world.layers.at(2).generator, "m");
}

TEST(WorldJson, DoesNotTakeTheSameKeyInTwoObjectsForARepetition) {
  read(R"({"seed": 1, "layers": [{"generator": "a", "parameters": {"x": 1}, "filters": [{"filter": "f",
          "parameters": {"x": 2}}]}, {"generator": "a", "parameters": {"x": 1}}]})");
}

TEST(WorldJson, RefusesEveryTruncationOfAGoodText) {
  const std::string good = R"({"seed": 42, "layers": [{"name": "é", "generator": "fault", "pitch": 64.0}]})";
  read(good);
  for (std::size_t length = 0; length < good.size(); ++length) {
    const std::string sentence = refusal(good.substr(0, length));
    EXPECT_NE(sentence.find("is not JSON"), std::string::npos) << "cut after " << length << ": " << sentence;
  }
}

TEST(WorldJson, RefusesTextsBeyondSixteenMebibytesUnread) {
  const std::string good = R"({"layers": [{"generator": "fault"}]})";
  const std::string padded = good + std::string((std::size_t{16} << 20) - good.size(), ' ');
  read(padded);
  EXPECT_NE(refusal(padded + " ").find("16 MiB"), std::string::npos);
}

TEST(WorldJson, NamesASourceWithLineBreaksOnOneLine) {
  expectOneSentence(WorldDescription::fromJson("{}", "a\nb.json").error().message);
  expectOneSentence(WorldDescription::fromJson("{", "a\nb.json").error().message);
}

class WorldJsonFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("teren-world-json-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  std::filesystem::path folder_;
};

TEST_F(WorldJsonFile, IsReadLikeItsText) {
  const auto world =
      WorldDescription::fromFile(write("good.json", R"({"seed": 7, "layers": [{"generator": "fault"}]})"));
  ASSERT_TRUE(world.ok()) << world.error().message;
  EXPECT_EQ(world->seed, 7U);
}

}  // namespace
}  // namespace teren
