// The shapes of the answers in JSON, which scripts rely on.
#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/teren/Program.h"

namespace teren {
namespace {

using Json = nlohmann::json;
using Keys = std::set<std::string>;

Json jsonOf(const Arguments& arguments) {
  const Answer answer = teren(arguments);
  EXPECT_EQ(answer.exitCode, 0) << answer.complaint;
  EXPECT_EQ(answer.complaint, "");
  return Json::parse(answer.output);
}

Keys keysOf(const Json& object) {
  Keys keys;
  for (const auto& item : object.items()) keys.insert(item.key());
  return keys;
}

const Json* withId(const Json& plugins, const std::string& id) {
  for (const Json& plugin : plugins) {
    if (plugin.at("id") == id) return &plugin;
  }
  return nullptr;
}

TEST(PluginsAnswer, HoldsEveryPluginAndEveryRefusal) {
  const Json answer = jsonOf({"plugins", "--json"});
  EXPECT_EQ(keysOf(answer), (Keys{"plugins", "refused"}));
  for (const Json& plugin : answer.at("plugins")) {
    EXPECT_EQ(keysOf(plugin), (Keys{"id", "kind", "version", "file", "doc"}));
  }
  for (const Json& module : answer.at("refused")) EXPECT_EQ(keysOf(module), (Keys{"file", "reason"}));
  ASSERT_NE(withId(answer.at("plugins"), "flat"), nullptr);
  EXPECT_EQ(withId(answer.at("plugins"), "flat")->at("kind"), "generator");
  ASSERT_NE(withId(answer.at("plugins"), "raise"), nullptr);
  EXPECT_EQ(withId(answer.at("plugins"), "raise")->at("kind"), "filter");
  std::size_t broken = 0;
  for (const Json& module : answer.at("refused")) {
    if (module.at("file").get<std::string>().starts_with(TEREN_TEST_MODULES "/broken/")) ++broken;
  }
  EXPECT_EQ(broken, namesIn(TEREN_TEST_MODULES "/broken").size());
  // The shipped ones are found beside the engine, without the variable's help.
  EXPECT_NE(withId(answer.at("plugins"), "fault"), nullptr);
}

TEST(PluginsAnswer, TellsPeopleTheSame) {
  const Answer answer = teren({"plugins"});
  EXPECT_EQ(answer.exitCode, 0);
  EXPECT_NE(answer.output.find("flat (generator, version 1.0): one height everywhere"), std::string::npos);
  EXPECT_NE(answer.output.find("refused: it does not export the function terenPlugin"), std::string::npos);
}

TEST(DescribeAnswer, HoldsTheParameterTable) {
  const Json answer = jsonOf({"describe", "flat", "--json"});
  const Json expected = Json::parse(R"({
    "id": "flat", "kind": "generator", "version": "1.0", "doc": "one height everywhere",
    "parameters": [{"name": "height", "type": "real", "default": 1.0, "min": -1000.0, "max": 1000.0,
                    "unit": "m", "doc": "height of every sample"}]})");
  EXPECT_EQ(answer, expected);
}

TEST(DescribeAnswer, GivesIntegersAsIntegers) {
  const Json answer = jsonOf({"describe", "fault", "--json"});
  const Json faults = answer.at("parameters").at(0);
  EXPECT_EQ(faults.at("name"), "faults");
  EXPECT_EQ(faults.at("type"), "integer");
  EXPECT_TRUE(faults.at("default").is_number_integer());
  EXPECT_TRUE(faults.at("max").is_number_integer());
}

TEST(DescribeAnswer, SaysOfATextHowLongItMayBe) {
  const Json answer = jsonOf({"describe", "matrix", "--json"});
  EXPECT_EQ(answer.at("kind"), "filter");
  const Json& parameters = answer.at("parameters");
  const auto text = std::find_if(parameters.begin(), parameters.end(),
                                 [](const Json& row) { return row.at("type") == "text"; });
  ASSERT_NE(text, parameters.end());
  EXPECT_EQ(text->at("name"), "matrix");
  EXPECT_EQ(text->at("default"), "");
  EXPECT_EQ(text->at("max"), 32768);
  EXPECT_NE(teren({"describe", "matrix"}).output.find("matrix (text of at most 32768 bytes; default \"\")"),
            std::string::npos);
}

TEST(QueryAnswer, HoldsBothHeightsANormalAndAnErrorBound) {
  const Json answer =
      jsonOf({"query", "--generator", "fault", "--seed", "3", "12.25", "-7", "1e6", "0", "--json"});
  EXPECT_EQ(keysOf(answer), Keys{"points"});
  ASSERT_EQ(answer.at("points").size(), 2U);
  for (const Json& point : answer.at("points")) {
    EXPECT_EQ(keysOf(point), (Keys{"x", "y", "height", "drawn", "normal", "error"}));
    const Json& normal = point.at("normal");
    ASSERT_EQ(normal.size(), 3U);
    EXPECT_NEAR(std::hypot(normal[0].get<double>(), normal[1].get<double>(), normal[2].get<double>()), 1.0,
                1e-9);
    EXPECT_GT(normal[2].get<double>(), 0.0);
    EXPECT_LE(std::fabs(point.at("height").get<double>() - point.at("drawn").get<double>()),
              point.at("error").get<double>());
  }
  EXPECT_EQ(answer.at("points")[0].at("x"), 12.25);
  EXPECT_EQ(answer.at("points")[0].at("y"), -7.0);
}

TEST(QueryAnswer, DependsOnTheSeed) {
  const auto height = [](const std::string& seed) {
    return jsonOf({"query", "--generator", "fault", "--seed", seed, "1", "2", "--json"})
        .at("points")[0]
        .at("height");
  };
  EXPECT_EQ(height("5"), height("5"));
  EXPECT_NE(height("5"), height("6"));
  // The last bit of 64 counts, and is no sign.
  EXPECT_NE(height("18446744073709551615"), height("9223372036854775807"));
}

TEST(QueryAnswer, KnowsTheWorldShippedWithTeren) {
  EXPECT_EQ(jsonOf({"query", "0", "0", "--json"}).at("points").size(), 1U);
}

TEST(QueryAnswer, TakesAWorldFromAFile) {
  const ScratchFolder folder;
  folder.write("world.json", R"({"layers": [{"generator": "flat", "parameters": {"height": 12.5}}]})");
  const Json answer = jsonOf({"query", "--world", folder / "world.json", "3", "4", "--json"});
  EXPECT_EQ(answer.at("points")[0].at("height"), 12.5);
}

}  // namespace
}  // namespace teren
