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

struct Hostile {
  std::string text;
  std::vector<std::string> needles;  ///< what the sentence must name
};

std::string layer(const std::string& members) {
  return R"({"layers": [{"generator": "fault", )" + members + "}]}";
}

std::string deep(const std::string& open, const std::string& close, int depth) {
  std::string text;
  for (int k = 0; k < depth; ++k) text += open;
  for (int k = 0; k < depth; ++k) text += close;
  return text;
}

std::vector<Hostile> hostileTexts() {
  const std::string one = R"("layers": [{"generator": "fault"}])";
  return {
      // Not JSON.
      {"", {"is not JSON"}},
      {"\n\n", {"is not JSON"}},
      {"{" + one, {"is not JSON", "byte"}},
      {R"({"layers": [{"generator": "fau)", {"is not JSON"}},
      {"{" + one + "} x", {"is not JSON", "byte"}},
      {"{'layers': []}", {"is not JSON", "byte 2"}},
      {R"({"pitch": NaN, )" + one + "}", {"is not JSON", "byte"}},
      {R"({"pitch": Infinity, )" + one + "}", {"is not JSON"}},
      {R"({"pitch": 1e999, )" + one + "}", {"'1e999'", "\"pitch\""}},
      {R"({"pitch": -1e999, )" + one + "}", {"-1e999"}},
      {layer(R"("parameters": {"deviation": 1e400})"), {"1e400"}},
      {"{\"seed\": 1, \"layers\": [{\"generator\": \"\xff\"}]}", {"is not JSON"}},
      {std::string("{\"seed\": 1\0}", 12), {"is not JSON"}},
      // Not a world.
      {"null", {"object"}},
      {"[1]", {"object"}},
      {"\"world\"", {"object"}},
      {"{}", {"layers", "missing"}},
      {R"({"layers": []})", {"layers", "[]", "at least one"}},
      {R"({"layers": {}})", {"layers", "{}"}},
      {R"({"layers": "fault"})", {"layers", "\"fault\""}},
      {R"({"layers": [7]})", {"layers[0]", "object"}},
      {R"({"layers": [{"generator": "fault"}, null]})", {"layers[1]", "object"}},
      {R"({"layers": [{}]})", {"layers[0]", "generator"}},
      // Unknown keys.
      {R"({"sed": 1, )" + one + "}", {"sed", "known key", "seed"}},
      {R"({"Seed": 1, )" + one + "}", {"Seed", "known key"}},
      {layer(R"("hurst": 1)"), {"layers[0].hurst", "known key", "parameters"}},
      {layer(R"("filters": [{"filter": "band", "k": 1}])"), {"layers[0].filters[0].k", "known key"}},
      {R"({"a\nb": 1, )" + one + "}", {"a?b", "known key"}},
      {"{\"" + std::string(100'000, 'k') + "\": 1, " + one + "}", {"kkk...", "known key"}},
      // Wrong types and values.
      {R"({"seed": -1, )" + one + "}", {"seed", "-1"}},
      {R"({"seed": 1.5, )" + one + "}", {"seed", "1.5"}},
      {R"({"seed": 1e3, )" + one + "}", {"seed", "1000"}},
      {R"({"seed": 18446744073709551616, )" + one + "}", {"seed", "1.8446744073709552e+19"}},
      {R"({"seed": "42", )" + one + "}", {"seed", "\"42\""}},
      {R"({"seed": null, )" + one + "}", {"seed", "null"}},
      {R"({"pitch": "64", )" + one + "}", {"pitch", "\"64\"", "number"}},
      {R"({"pitch": [64], )" + one + "}", {"pitch", "[64]"}},
      {R"({"samples": 65.5, )" + one + "}", {"samples", "65.5", "whole number"}},
      {R"({"samples": -65, )" + one + "}", {"samples", "-65"}},
      {R"({"samples": 4294967361, )" + one + "}", {"samples", "4294967361"}},
      {R"({"samples": true, )" + one + "}", {"samples", "true"}},
      {R"({"blend": "cubic", )" + one + "}", {"blend", "\"cubic\"", "linear", "smooth"}},
      {R"({"blend": 1, )" + one + "}", {"blend", "1", "linear"}},
      {R"({"preserveVariance": 1, )" + one + "}", {"preserveVariance", "1", "true or false"}},
      {R"({"preserveVariance": "true", )" + one + "}", {"preserveVariance", "\"true\""}},
      {layer(R"("pitch": {})"), {"layers[0].pitch", "{}"}},
      {layer(R"("samples": "9")"), {"layers[0].samples", "\"9\""}},
      {layer(R"("blend": null)"), {"layers[0].blend", "null"}},
      {layer(R"("name": "")"), {"layers[0].name", "\"\"", "1 to 200"}},
      {layer(R"("name": 7)"), {"layers[0].name", "7", "text"}},
      {layer(R"("name": ")" + std::string(201, 'n') + "\""), {"layers[0].name", "nnn...", "1 to 200"}},
      {R"({"layers": [{"generator": ["fault"]}]})", {"layers[0].generator", "text"}},
      {layer(R"("parameters": [1, 2])"), {"layers[0].parameters", "[1,2]", "object"}},
      {layer(R"("parameters": {"faults": null})"), {"layers[0].parameters.faults"}},
      {layer(R"("parameters": {"faults": [150]})"), {"layers[0].parameters.faults"}},
      {layer(R"("filters": {"filter": "band"})"), {"layers[0].filters", "list"}},
      {layer(R"("filters": ["band"])"), {"layers[0].filters[0]", "object"}},
      {layer(R"("filters": [{"filter": "band"}, {}])"), {"layers[0].filters[1]", "filter"}},
      {layer(R"("filters": [{"filter": "band", "parameters": 3}])"),
       {"layers[0].filters[0].parameters", "3"}},
      // Values whose text is long, has line breaks or is cut in the middle of a character.
      {R"({"blend": ")" + std::string(39, 'x') + "äöü\", " + one + "}", {"blend", "xxx", "..."}},
      {R"({"blend": "a\u0085b\u2028c", )" + one + "}", {"blend"}},
      {R"({"pitch": ")" + std::string(1'000'000, 'x') + "\", " + one + "}", {"pitch", "xxx..."}},
      {layer(R"("parameters": {"line\nbreak": null})"), {"layers[0].parameters.line?break"}},
      // Keys given twice.
      {R"({"seed": 1, "seed": 2, )" + one + "}", {"\"seed\"", "twice"}},
      {layer(R"("generator": "noise")"), {"\"generator\"", "twice"}},
      {layer(R"("parameters": {"faults": 1, "faults": 2})"), {"\"faults\"", "twice"}},
      {layer(R"("parameters": {"a\nb": 1, "a\nb": 2})"), {"\"a?b\"", "twice"}},
      // Nesting.
      {deep("[", "]", 40), {"nested", "32"}},
      {deep(R"({"a":)", "}", 40), {}},
      {deep("[", "]", 1'000'000), {"nested", "32"}},
      {std::string(15'000'000, '['), {"w.json"}},
      {R"({"x": )" + deep("[", "]", 40) + ", " + one + "}", {"nested", "32"}},
  };
}

TEST(WorldJson, RefusesHostileTextsWithOneSentenceThatNamesPlaceAndValue) {
  for (const Hostile& hostile : hostileTexts()) {
    SCOPED_TRACE(hostile.text.substr(0, 120));
    const std::string sentence = refusal(hostile.text);
    EXPECT_EQ(sentence.rfind("w.json", 0), 0U) << sentence;
    expectOneSentence(sentence);
    for (const std::string& needle : hostile.needles) {
      EXPECT_NE(sentence.find(needle), std::string::npos) << "no \"" << needle << "\" in: " << sentence;
    }
  }
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

TEST_F(WorldJsonFile, IsRefusedByNameWhereItCannotBeRead) {
  const std::filesystem::path huge = write("huge.json", "{}");
  std::filesystem::resize_file(huge, (std::uintmax_t{16} << 20) + 1);
  for (const auto& [file, needle] :
       std::vector<std::pair<std::filesystem::path, std::string>>{{folder_ / "absent.json", "not a file"},
                                                                  {folder_, "not a file"},
                                                                  {"/dev/zero", "not a file"},
                                                                  {huge, "16 MiB"},
                                                                  {write("empty.json", ""), "is not JSON"},
                                                                  {"/proc/self/mem", "could not be read"}}) {
    const auto world = WorldDescription::fromFile(file);
    ASSERT_FALSE(world.ok()) << file;
    EXPECT_EQ(world.error().message.rfind(file.string(), 0), 0U) << world.error().message;
    EXPECT_NE(world.error().message.find(needle), std::string::npos) << world.error().message;
  }
}

}  // namespace
}  // namespace teren
