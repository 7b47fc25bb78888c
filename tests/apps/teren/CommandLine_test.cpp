// Law 8 at the command line: whatever is typed wrong is one sentence and exit code 2.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/teren/Program.h"

namespace teren {
namespace {

struct Case {
  Arguments arguments;
  std::string culprit;  ///< what the sentence must name
};

void expectRefused(const std::vector<Case>& cases) {
  for (const Case& wrong : cases) {
    std::string line = "teren";
    for (const std::string& text : wrong.arguments) line += " '" + text.substr(0, 100) + "'";
    const Answer answer = teren(wrong.arguments);
    EXPECT_EQ(answer.exitCode, 2) << line << "\n" << answer.complaint.substr(0, 2000);
    EXPECT_TRUE(isOneSentence(answer.complaint)) << line << "\n" << answer.complaint.substr(0, 2000);
    EXPECT_NE(answer.complaint.find(wrong.culprit), std::string::npos) << line << "\n"
                                                                       << answer.complaint.substr(0, 2000);
    EXPECT_EQ(answer.output, "") << line;
  }
}

/// A bake that would be right but for what is added.
Arguments bakeWith(const Arguments& added) {
  Arguments all = {"bake", "--generator", "flat", "--patches", "0", "0", "1", "1", "-o", "never.r32"};
  all.insert(all.end(), added.begin(), added.end());
  return all;
}

Arguments queryWith(const Arguments& added) {
  Arguments all = {"query", "0", "0"};
  all.insert(all.end(), added.begin(), added.end());
  return all;
}

TEST(CommandLine, RefusesCommandsThatDoNotExist) {
  expectRefused({{{}, "command"},
                 {{"fly"}, "fly"},
                 {{""}, "not expected"},
                 {{"--nonsense"}, "--nonsense"},
                 {{"plugins", "extra"}, "extra"},
                 {{"plugins", "query"}, "query"},
                 {{"plugins", "--jsn"}, "--jsn"},
                 {{"plugins", "--json=5"}, "json"},
                 {{"plugins", "-j"}, "-j"},
                 {{"describe"}, "ID"},
                 {{"describe", "nobody"}, "nobody"},
                 {{"describe", ""}, "\"\""},
                 {{"describe", "flat", "raise"}, "raise"}});
}

TEST(CommandLine, RefusesRegionsThatCannotBe) {
  const auto patches = [](const Arguments& numbers) {
    Arguments all = {"bake", "--generator", "flat", "-o", "never.r32", "--patches"};
    all.insert(all.end(), numbers.begin(), numbers.end());
    return all;
  };
  expectRefused({{patches({}), "--patches"},
                 {patches({"0", "0", "1"}), "--patches"},
                 {patches({"0", "0", "1", "1", "1"}), "1"},
                 {{"bake", "--patches", "0", "0", "1", "-o", "never.r32"}, "--patches"},
                 {{"bake", "-o", "never.r32"}, "--patches"},
                 {{"bake", "--patches", "0", "0", "1", "1"}, "-o"},
                 {patches({"0.5", "0", "1", "1"}), "\"0.5\""},
                 {patches({"0", "0x10", "1", "1"}), "\"0x10\""},
                 {patches({"0", "1e3", "1", "1"}), "\"1e3\""},
                 {patches({"", "0", "1", "1"}), "I of --patches"},
                 {patches({"0", "0", "-1", "1"}), "COLUMNS of --patches"},
                 {patches({"0", "0", "1", "0"}), "ROWS of --patches"},
                 {patches({"99999999999999999999", "0", "1", "1"}), "99999999999999999999"},
                 {patches({"4503599627370497", "0", "1", "1"}), "4503599627370497"},
                 {patches({"4503599627370496", "0", "1", "1"}), "columns"},
                 {patches({"0", "0", "100000", "100000"}), "samples"},
                 {patches({"0", "0", "4503599627370496", "4503599627370496"}), "samples"}});
}

TEST(CommandLine, RefusesNumbersThatCannotBe) {
  expectRefused({{bakeWith({"--level", "-1"}), "--level is \"-1\""},
                 {bakeWith({"--level", "two"}), "\"two\""},
                 {bakeWith({"--level", "61"}), "\"61\""},
                 {bakeWith({"--level", "30"}), "30"},
                 {bakeWith({"--level"}), "--level"},
                 {bakeWith({"--workers", "65"}), "--workers is \"65\""},
                 {bakeWith({"--workers", "many"}), "--workers is \"many\""},
                 {bakeWith({"--workers", "-1"}), "--workers is \"-1\""},
                 {bakeWith({"--slice-us", "-5"}), "--slice-us is \"-5\""},
                 {bakeWith({"--slice-us", "99999999999999999999"}), "--slice-us"},
                 {bakeWith({"--seed", "-1"}), "--seed is \"-1\""},
                 {bakeWith({"--seed", "18446744073709551616"}), "18446744073709551616"},
                 {bakeWith({"--seed", "1e3"}), "\"1e3\""},
                 {bakeWith({"--seed", "1.0"}), "\"1.0\""},
                 {bakeWith({"--seed", "0x1"}), "\"0x1\""},
                 {bakeWith({"--seed", ""}), "--seed is \"\""},
                 {bakeWith({"--seed", " 1"}), "\" 1\""},
                 {bakeWith({"--seed="}), "--seed="},
                 {bakeWith({"--seed", "1", "--seed", "2"}), "--seed"},
                 {bakeWith({"--pitch", "0"}), "--pitch is \"0\""},
                 {bakeWith({"--pitch", "-64"}), "--pitch is \"-64\""},
                 {bakeWith({"--pitch", "nan"}), "\"nan\""},
                 {bakeWith({"--pitch", "inf"}), "\"inf\""},
                 {bakeWith({"--pitch", "1e999"}), "\"1e999\""},
                 {bakeWith({"--samples", "64"}), "64"},
                 {bakeWith({"--samples", "4"}), "\"4\""},
                 {bakeWith({"--samples", "3000000000"}), "\"3000000000\""},
                 {bakeWith({"--blend", "cubic"}), "\"cubic\""}});
}

TEST(CommandLine, RefusesWorldsThatCannotBe) {
  const ScratchFolder folder;
  folder.write("broken.json", "{\"layers\": [");
  folder.write("odd.json", R"({"layers": [{"generator": "flat"}], "colour": 3})");
  expectRefused({{queryWith({"--generator", "nobody"}), "\"nobody\""},
                 {queryWith({"--generator", ""}), "\"\""},
                 {queryWith({"--generator", "raise"}), "\"raise\" is a filter"},
                 {queryWith({"--generator", "wrong-magic"}), "\"wrong-magic\""},
                 {queryWith({"--generator", "flat", "--world", "w.json"}), "--world"},
                 {queryWith({"--set", "height=1"}), "--set"},
                 {queryWith({"--blend", "linear"}), "--blend"},
                 {queryWith({"--generator", "flat", "--set", "height"}), "\"height\""},
                 {queryWith({"--generator", "flat", "--set", "height=abc"}), "\"abc\""},
                 {queryWith({"--generator", "flat", "--set", "height=1e9"}), "1e+09"},
                 {queryWith({"--generator", "flat", "--set", "hight=1"}), "\"hight\""},
                 {queryWith({"--generator", "flat", "--set", "height=1", "--set", "height=2"}), "twice"},
                 {queryWith({"--generator", "flat", "--set"}), "--set"},
                 {queryWith({"--world", folder / "absent.json"}), "absent.json"},
                 {queryWith({"--world", folder.path()}), folder.path()},
                 {queryWith({"--world", folder / "broken.json"}), "broken.json"},
                 {queryWith({"--world", folder / "odd.json"}), "colour"},
                 {queryWith({"--world", ""}), "\"\""}});
}

TEST(CommandLine, RefusesPointsThatCannotBe) {
  const auto query = [](const Arguments& points) {
    Arguments all = {"query", "--generator", "flat"};
    all.insert(all.end(), points.begin(), points.end());
    return all;
  };
  expectRefused({{query({}), "POINTS"},
                 {query({"1"}), "POINTS"},
                 {query({"1", "2", "3"}), "\"3\""},
                 {query({"nan", "0"}), "\"nan\""},
                 {query({"0", "inf"}), "\"inf\""},
                 {query({"-inf", "0"}), "-inf"},
                 {query({"1e300", "0"}), "1e+300"},
                 {query({"0", "0x1"}), "\"0x1\""},
                 {query({"0", "1,5"}), "\"1,5\""},
                 {query({"", "0"}), "\"\""},
                 {query({"0", "1 "}), "\"1 \""}});
}

TEST(CommandLine, RefusesFlightsThatCannotBe) {
  const auto flight = [](const Arguments& added) {
    Arguments all = {"flight", "--generator", "flat", "--seconds", "0.1", "--fast"};
    all.insert(all.end(), added.begin(), added.end());
    return all;
  };
  expectRefused({{flight({"--speed", "-1"}), "--speed is \"-1\""},
                 {flight({"--speed", "nan"}), "\"nan\""},
                 {flight({"--speed", "1e6"}), "--speed is \"1e6\""},
                 {flight({"--speed"}), "--speed"},
                 {{"flight", "--seconds", "0"}, "--seconds is \"0\""},
                 {{"flight", "--seconds", "-5"}, "--seconds is \"-5\""},
                 {{"flight", "--seconds", "100000"}, "--seconds is \"100000\""},
                 {{"flight", "--seconds", "soon"}, "\"soon\""},
                 {flight({"--objects", "0"}), "--objects is \"0\""},
                 {flight({"--objects", "1.5"}), "--objects is \"1.5\""},
                 {flight({"--objects", "1001"}), "--objects is \"1001\""},
                 {flight({"--start", "1"}), "--start"},
                 {flight({"--start", "1", "2", "3"}), "3"},
                 {flight({"--start", "here", "2"}), "X of --start"},
                 {flight({"--start", "1", "nan"}), "Y of --start"},
                 {flight({"--start", "1e300", "0"}), "--start: x = 1e+300"},
                 {flight({"--start", "0", "288230376151711743", "--objects", "9"}), "beyond the world"},
                 {flight({"--path", "sideways"}), "--path is \"sideways\""},
                 {flight({"--path", ""}), "--path is \"\""},
                 {flight({"--view-distance", "0"}), "--view-distance is \"0\""},
                 {flight({"--view-distance", "1e12"}), "--view-distance is \"1e12\""},
                 {flight({"--pixel-error", "0.05"}), "--pixel-error is \"0.05\""},
                 {flight({"--workers", "-1"}), "--workers is \"-1\""},
                 {flight({"--workers", "65"}), "--workers is \"65\""},
                 {flight({"--budget-us", "0"}), "--budget-us is \"0\""},
                 {flight({"--budget-us", "1e3"}), "--budget-us is \"1e3\""},
                 {flight({"--budget-us", "1000001"}), "--budget-us is \"1000001\""},
                 {flight({"--cap-mib", "7"}), "--cap-mib is \"7\""},
                 {flight({"--cap-mib", "9999999"}), "--cap-mib is \"9999999\""},
                 {flight({"--cap-mib", "8", "--samples", "1025"}), "cap"},
                 {flight({"--edits", "/no/such/edits.db"}), "edits.db"},
                 {flight({"--fast=no"}), "fast"},
                 {flight({"--set", "height=1e9"}), "--set"},
                 {flight({"elsewhere"}), "elsewhere"}});
}

TEST(CommandLine, RefusesFormatsItDoesNotWrite) {
  for (const std::string name : {"a.tif", "a.wrl", "a.OBJ", "a.png.gz", "a", ".png", "png", ""}) {
    expectRefused(
        {{{"bake", "--generator", "flat", "--patches", "0", "0", "1", "1", "-o", name}, "\"" + name + "\""}});
  }
}

TEST(CommandLine, KeepsItsSentencesShortAndOnOneLine) {
  const std::string huge(100'000, 'z');
  expectRefused({{{huge}, "zzz"},
                 {{"describe", huge}, "zzz"},
                 {{"plugins", "--" + huge}, "zzz"},
                 {queryWith({"--generator", huge}), "zzz"},
                 {queryWith({"--generator", "flat", "--set", huge}), "zzz"},
                 {queryWith({"--generator", "flat", "--set", "height=" + huge}), "zzz"},
                 {queryWith({"--world", huge}), "zzz"},
                 {queryWith({huge, "0"}), "zzz"},
                 {bakeWith({"--seed", huge}), "zzz"},
                 {{"describe", "a\nb\x1b[31m"}, "a?b?[31m"},
                 {{"two\nlines"}, "two?lines"}});
}

TEST(CommandLine, TakesNumbersAsPeopleTypeThem) {
  const Answer answer = teren({"query", "-.5", "--generator", "flat", "--seed", "18446744073709551615",
                               "--set", "height=-.25", "+2", "--pitch", "32", "-1e2", ".5", "--json"});
  ASSERT_EQ(answer.exitCode, 0) << answer.complaint;
  EXPECT_EQ(answer.complaint, "");
  const auto points = nlohmann::json::parse(answer.output).at("points");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].at("x"), -0.5);
  EXPECT_EQ(points[0].at("y"), 2.0);
  EXPECT_EQ(points[1].at("x"), -100.0);
  EXPECT_EQ(points[1].at("y"), 0.5);
  EXPECT_EQ(points[1].at("height"), -0.25);
}

TEST(CommandLine, HelpsOnStandardOutput) {
  for (const Arguments& arguments :
       {Arguments{"--help"}, Arguments{"bake", "--help"}, Arguments{"query", "-h"}}) {
    const Answer answer = teren(arguments);
    EXPECT_EQ(answer.exitCode, 0);
    EXPECT_EQ(answer.complaint, "");
    EXPECT_NE(answer.output.find("Usage: teren"), std::string::npos) << answer.output;
  }
}

TEST(CommandLine, SaysWhenItsAnswerCannotBeWritten) {
  Program::Settings settings;
  settings.output = "/dev/full";
  const Answer answer = Program({"plugins"}, settings).finish();
  EXPECT_EQ(answer.exitCode, 1);
  EXPECT_TRUE(isOneSentence(answer.complaint)) << answer.complaint;
}

}  // namespace
}  // namespace teren
