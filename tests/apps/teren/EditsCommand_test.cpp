// teren edits, and --edits of bake and query, as a person meets them.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "teren/EditJournal.h"
#include "teren/PluginRegistry.h"
#include "teren/World.h"

#include "tests/apps/teren/BakedFiles.h"

namespace teren {
namespace {

/// A world in a file, with room beside it.
class Land {
 public:
  Land() {
    folder_.write("land.json", R"({"seed": 3, "layers": [{"generator": "fault"}]})");
    folder_.write("other.json", R"({"seed": 4, "layers": [{"generator": "fault"}]})");
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  /// "press" presses one sample down.
  std::string text(const std::string& name, const std::string& lines) const {
    folder_.write(name, lines);
    return file(name);
  }
  Answer edits(const Arguments& rest) const {
    Arguments all = {"edits", "--world", file("land.json")};
    all.insert(all.end(), rest.begin(), rest.end());
    return teren(all);
  }
  nlohmann::json editsJson(Arguments rest) const {
    rest.push_back("--json");
    const Answer answer = edits(rest);
    EXPECT_EQ(answer.exitCode, 0) << answer.complaint;
    return answer.exitCode == 0 ? nlohmann::json::parse(answer.output) : nlohmann::json();
  }
  nlohmann::json bake(const Arguments& added) const {
    Arguments all = {"bake", "--world", file("land.json"), "--patches", "-2", "-2", "4",
                     "4",    "-o",      file("land.r32"),  "--json"};
    all.insert(all.end(), added.begin(), added.end());
    const Answer answer = teren(all);
    EXPECT_EQ(answer.exitCode, 0) << answer.complaint;
    return nlohmann::json::parse(answer.output);
  }

 private:
  ScratchFolder folder_;
};

constexpr const char* kTwoEdits =
    "# two dents\nstamp press 10 20 0 1 2.5 7 0\n\nstamp press -30.5 6 0 1 1 8 3 strength=2.0\n";

TEST(EditsCommand, ListsWhatWasAppliedAsATextThatCanBeAppliedAgain) {
  const Land land;
  const Answer applied = land.edits({"apply", land.text("dents.txt", kTwoEdits)});
  EXPECT_EQ(applied.exitCode, 0) << applied.complaint;
  EXPECT_EQ(applied.complaint, "");
  EXPECT_EQ(applied.output.find(land.file("land.edits") + ": 2 edits applied, 2 in all, hash of the ground "),
            0U)
      << applied.output;
  const Answer listed = land.edits({"list"});
  EXPECT_EQ(listed.output, "stamp press 10 20 0 1 2.5 7 0\nstamp press -30.5 6 0 1 1 8 3 strength=2\n");
  const auto json = land.editsJson({"list"});
  EXPECT_EQ(json["file"], land.file("land.edits"));
  EXPECT_EQ(json["edits"][1],
            nlohmann::json::parse(R"({"kind": "press", "x": -30.5, "y": 6.0, "z": 0.0, "size": 1.0,
      "depth": 1.0, "seed": 8, "steps": 3, "parameters": {"strength": 2}})"));
  const auto again =
      land.editsJson({"apply", land.text("again.txt", listed.output), "--edits", land.file("again.edits")});
  const auto verified = land.editsJson({"verify"});
  EXPECT_EQ(again["hash"], verified["hash"]);
  EXPECT_EQ(verified["verified"], 2);
  EXPECT_EQ(verified["edits"], 2);
  EXPECT_EQ(verified["ended"], (nlohmann::json{{"surfaces", 0}, {"error", 0.0}, {"absolute", 0.0}}));
}

TEST(EditsCommand, TellsWhatVolumeBecameOfSurfacesThatEnded) {
  const Land land;
  const std::string text =
      "stamp sand 10 20 0 12 4 7 0\nstamp crater 10 20 0 12 2 7 1000000\nstamp sand 10 20 0 12 4 7 9\n";
  const Answer applied = land.edits({"apply", land.text("both.txt", text)});
  EXPECT_EQ(applied.exitCode, 0) << applied.complaint;
  EXPECT_NE(applied.output.find("\n2 live surfaces became samples: "), std::string::npos) << applied.output;
  EXPECT_NE(applied.output.find(" m^3 more by that, "), std::string::npos) << applied.output;
}

TEST(EditsCommand, OfTwoProgramsThatApplyTheSameTextEndWithTheSameGround) {
  const Land land;
  const std::string first = "stamp press 10 20 0 1 2.5 7 0\nstamp press 70 20 0 1 2 7 0\n";
  const std::string second = "stamp press 12 21 0 1 2.5 7 4\nstamp press 10 20 0 1 1 7 1\n";
  const auto whole =
      land.editsJson({"apply", land.text("whole.txt", first + second), "--edits", land.file("a.edits")});
  land.editsJson({"apply", land.text("first.txt", first), "--edits", land.file("b.edits")});
  const auto parts =
      land.editsJson({"apply", land.text("second.txt", second), "--edits", land.file("b.edits")});
  EXPECT_EQ(parts["applied"], 2);
  EXPECT_EQ(parts["edits"], 4);
  EXPECT_EQ(parts["hash"], whole["hash"]);
  for (const char* level : {"0", "2"}) {
    const auto plain = land.bake({"--level", level});
    const auto a = land.bake({"--level", level, "--edits", land.file("a.edits")});
    const auto b =
        land.bake({"--level", level, "--edits", land.file("b.edits"), "--workers", "2", "--slice-us", "50"});
    EXPECT_EQ(a["hash"], b["hash"]);
    // (10, 20) is sample (5, 10), (70, 20) is (35, 10), (12, 21) is (6, 11): none of them is one of level 2.
    EXPECT_EQ(a["hash"] == plain["hash"], std::string(level) == "2");
  }
}

TEST(EditsCommand, OfTwoProgramsThatApplyTheSameCratersEndWithTheSameGround) {
  const Land land;
  // Craters over each other and over patches' borders, smoothed before those before have come to rest.
  std::string first, second;
  for (int k = 0; k < 40; ++k) {
    const std::string place =
        std::to_string(-100 + 37 * k % 180) + ".5 " + std::to_string(-90 + 53 * k % 190);
    const std::string tool =
        k % 3 == 2 ? " 0 30 6 " + std::to_string(k) + " 2 tool=smooth\n"
                   : " 0 " + std::to_string(8 + k % 5 * 7) + " 4.25 " + std::to_string(k) + " 1 rim=0.3\n";
    (k < 23 ? first : second) += "stamp crater " + place + tool;
  }
  const auto whole =
      land.editsJson({"apply", land.text("whole.txt", first + second), "--edits", land.file("a.edits")});
  land.editsJson({"apply", land.text("first.txt", first), "--edits", land.file("b.edits")});
  const auto parts =
      land.editsJson({"apply", land.text("second.txt", second), "--edits", land.file("b.edits")});
  EXPECT_EQ(parts["edits"], 40);
  EXPECT_EQ(parts["hash"], whole["hash"]);
  // The steps between edits count: were they forgotten, this list would make the same ground.
  std::string hasty = first + second;
  for (std::size_t at = 0; (at = hasty.find(" 2 tool", at)) != std::string::npos;) hasty[at + 1] = '9';
  EXPECT_NE(land.editsJson({"apply", land.text("hasty.txt", hasty), "--edits", land.file("c.edits")})["hash"],
            whole["hash"]);
  for (const char* level : {"0", "1", "2"}) {
    const auto a = land.bake({"--level", level, "--edits", land.file("a.edits")});
    const auto b =
        land.bake({"--level", level, "--edits", land.file("b.edits"), "--workers", "2", "--slice-us", "50"});
    EXPECT_EQ(a["hash"], b["hash"]);
    EXPECT_NE(a["hash"], land.bake({"--level", level})["hash"]);
  }
}

TEST(EditsCommand, DigsWhatIsQueriedAndBaked) {
  const Land land;
  land.editsJson({"apply", land.text("dents.txt", "stamp press 16 24 0 1 2.5 7 0\n")});
  const auto at = [&](const Arguments& added) {
    Arguments all = {"query", "--world", land.file("land.json"), "16", "24", "200", "24", "--json"};
    all.insert(all.end(), added.begin(), added.end());
    const Answer answer = teren(all);
    EXPECT_EQ(answer.exitCode, 0) << answer.complaint;
    return nlohmann::json::parse(answer.output)["points"];
  };
  const auto before = at({}), after = at({"--edits", land.file("land.edits")});
  EXPECT_NEAR(after[0]["drawn"].get<double>(), before[0]["drawn"].get<double>() - 2.5, 1e-4);
  EXPECT_NEAR(after[0]["height"].get<double>(), before[0]["height"].get<double>() - 2.5, 1e-4);
  EXPECT_EQ(after[1], before[1]);
  // (16, 24) is a sample of level 2 as well; nothing is edited unless it is asked for.
  for (const char* level : {"0", "2"}) {
    EXPECT_NE(land.bake({"--level", level, "--edits", land.file("land.edits")})["hash"],
              land.bake({"--level", level})["hash"]);
  }
}

TEST(EditsCommand, KeepsTheEditsOfAWorldWithoutAFileInTheUsersFolder) {
  const Land land;
  const char* const former = std::getenv("XDG_DATA_HOME");
  const std::string kept = former == nullptr ? "" : former;
  setenv("XDG_DATA_HOME", land.file("data").c_str(), 1);
  const Arguments world = {"edits", "--generator", "fault", "--seed", "5"};
  const auto run = [&](const Arguments& rest) {
    Arguments all = world;
    all.insert(all.end(), rest.begin(), rest.end());
    return teren(all);
  };
  const Answer applied = run({"apply", land.text("dents.txt", kTwoEdits)});
  EXPECT_EQ(applied.exitCode, 0) << applied.complaint;
  EXPECT_EQ(applied.output.find(land.file("data/teren/")), 0U) << applied.output;
  EXPECT_EQ(run({"list"}).output,
            "stamp press 10 20 0 1 2.5 7 0\nstamp press -30.5 6 0 1 1 8 3 strength=2\n");
  const Answer other = teren({"edits", "--generator", "fault", "--seed", "6", "list"});
  EXPECT_EQ(other.exitCode, 2);
  EXPECT_NE(other.complaint.find("is not there, expected an edit journal"), std::string::npos)
      << other.complaint;
  if (former == nullptr) {
    unsetenv("XDG_DATA_HOME");
  } else {
    setenv("XDG_DATA_HOME", kept.c_str(), 1);
  }
}

TEST(EditsCommand, SaysInOneSentenceWhatIsWrongAndAddsNothing) {
  const Land land;
  land.editsJson({"apply", land.text("dents.txt", kTwoEdits)});
  const std::string before = fileBytes(land.file("land.edits"));
  const auto refused = [&](const Answer& answer, const std::string& sentence) {
    EXPECT_EQ(answer.exitCode, 2);
    EXPECT_EQ(answer.output, "");
    EXPECT_EQ(answer.complaint, "teren: " + sentence + "\n");
    EXPECT_EQ(fileBytes(land.file("land.edits")), before);
  };
  const std::string quoted = "\"" + land.file("land.edits") + "\"";
  refused(land.edits({}), "edits: the ACTION is \"\", expected list, apply FILE, verify or compact");
  refused(land.edits({"mend"}),
          "edits: the ACTION is \"mend\", expected list, apply FILE, verify or compact");
  refused(land.edits({"apply"}), "edits apply: the FILE of edits to apply is missing");
  refused(land.edits({"list", "dents.txt"}),
          "edits list: \"dents.txt\" follows, which only apply knows what to do with");
  refused(land.edits({"verify", "--edits="}), "\"--edits=\" has no value after the '='");
  refused(land.edits({"apply", land.file("none.txt")}),
          "\"" + land.file("none.txt") + "\" is not a file that can be read, expected a list of edits");
  refused(land.edits({"apply", land.text("bad.txt", "stamp press 1 2 3 4 nan 6 7\n")}),
          land.file("bad.txt") +
              ", line 1: DEPTH is \"nan\" but must be a number of metres from -1e+06 to 1e+06");
  const Answer unknown = land.edits(
      {"apply", land.text("unknown.txt", "stamp press 1 2 0 1 1 6 7\nstamp spade 1 2 0 1 1 6 7\n")});
  EXPECT_EQ(unknown.exitCode, 2);
  EXPECT_EQ(unknown.complaint.find("teren: nothing was added to " + quoted + ": edit 4: "), 0U)
      << unknown.complaint;
  EXPECT_EQ(fileBytes(land.file("land.edits")), before);
  const Answer other =
      teren({"edits", "--world", land.file("other.json"), "list", "--edits", land.file("land.edits")});
  EXPECT_EQ(other.exitCode, 2);
  EXPECT_NE(other.complaint.find("has the edits of another world"), std::string::npos) << other.complaint;
  for (const Arguments& asked : {Arguments{"query", "1", "2"}, Arguments{"bake", "--patches", "0", "0", "1",
                                                                         "1", "-o", land.file("x.r32")}}) {
    Arguments all = asked;
    all.insert(all.end(), {"--world", land.file("land.json"), "--edits", land.file("none.edits")});
    refused(teren(all), "\"" + land.file("none.edits") + "\" is not there, expected an edit journal");
  }
  EXPECT_FALSE(std::filesystem::exists(land.file("x.r32")));
  // Nor does it begin a journal with nothing in it.
  EXPECT_EQ(land.edits({"apply", land.file("unknown.txt"), "--edits", land.file("new.edits")}).exitCode, 2);
  EXPECT_FALSE(std::filesystem::exists(land.file("new.edits")));
}

TEST(EditsCommand, TellsDamageAndListsWhatIsGood) {
  const Land land;
  std::string lines;
  for (int k = 0; k < 200; ++k) lines += "stamp press " + std::to_string(k) + " 20 0 1 2.5 7 0\n";
  land.editsJson({"apply", land.text("dents.txt", lines)});
  std::string bytes = fileBytes(land.file("land.edits"));
  const std::size_t at = bytes.find("stamp press 120 20");
  ASSERT_NE(at, std::string::npos);
  bytes[at + 12] = '7';
  std::ofstream(land.file("land.edits"), std::ios::binary) << bytes;
  const std::string sentence =
      "teren: \"" + land.file("land.edits") +
      "\" is damaged: entry 121 of 200 does not fit its checksum; 120 entries from the first on are good\n";
  const Answer verified = land.edits({"verify"}), listed = land.edits({"list"});
  for (const Answer& answer :
       {verified, listed, land.edits({"compact"}), land.edits({"apply", land.file("dents.txt")})}) {
    EXPECT_EQ(answer.exitCode, 2);
    EXPECT_EQ(answer.complaint, sentence);
  }
  EXPECT_EQ(verified.output, "");
  EXPECT_EQ(listed.output, lines.substr(0, lines.find("stamp press 120 20")));
  EXPECT_EQ(fileBytes(land.file("land.edits")), bytes);
}

TEST(EditsCommand, CompactsAJournalThatThenSaysTheSame) {
  const Land land;
  std::string lines;
  for (int k = 0; k < 300; ++k) {
    lines += "stamp press " + std::to_string(k) + " 20 0 1 2.5 " + std::to_string(k) + " 0\n";
  }
  const auto applied = land.editsJson({"apply", land.text("dents.txt", lines)});
  EXPECT_EQ(land.editsJson({"verify"})["hash"], applied["hash"]) << "with ground that is kept beside it";
  const auto baked = land.bake({"--edits", land.file("land.edits")})["hash"];
  const auto compacted = land.editsJson({"compact"});
  EXPECT_EQ(compacted["edits"], 300);
  EXPECT_EQ(compacted["entries"]["after"], 300);
  EXPECT_EQ(compacted["hash"], applied["hash"]);
  EXPECT_EQ(land.edits({"list"}).output, lines);
  EXPECT_EQ(land.editsJson({"verify"})["hash"], applied["hash"]);
  EXPECT_EQ(land.bake({"--edits", land.file("land.edits")})["hash"], baked);
  const Answer none = land.edits({"compact", "--edits", land.file("none.edits")});
  EXPECT_EQ(none.exitCode, 2);
  EXPECT_EQ(none.complaint,
            "teren: \"" + land.file("none.edits") + "\" is not there, expected an edit journal\n");
  EXPECT_FALSE(std::filesystem::exists(land.file("none.edits")));
}

TEST(EditsCommand, SaysNothingOfGroundThatIsKeptOfEditsThatWereUndone) {
  const Land land;
  std::string lines;
  for (int k = 0; k < 128; ++k) lines += "stamp press " + std::to_string(k) + " 20 0 1 2.5 7 0\n";
  land.editsJson({"apply", land.text("dents.txt", lines)});
  {
    const auto description = WorldDescription::fromFile(land.file("land.json"));
    ASSERT_TRUE(description);
    const auto world = World::create(*description, *PluginRegistry::standard());
    ASSERT_TRUE(world);
    const auto journal = EditJournal::open(land.file("land.edits"), (*world)->descriptionHash());
    ASSERT_TRUE(journal);
    ASSERT_TRUE((*journal)->record().checkpoint);
    (*journal)->appendUndo();
  }
  for (const char* action : {"verify", "compact"}) {
    const Answer answer = land.edits({action});
    EXPECT_EQ(answer.exitCode, 0);
    EXPECT_EQ(answer.complaint, "");
  }
  EXPECT_EQ(land.editsJson({"verify"})["edits"], 127);
}

TEST(EditsCommand, SaysThatADiskIsFull) {
  const Land land;
  land.editsJson({"apply", land.text("dents.txt", kTwoEdits)});
  std::string lines;
  for (int k = 0; k < 30'000; ++k) {
    lines +=
        "stamp press " + std::to_string(k % 50) + ".0123456789 20.0123456789 0 1 0.0123456789 1234567890 0\n";
  }
  Program::Settings settings;
  // The modules must have room, since copies of them are loaded.
  std::uintmax_t module = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TEREN_TEST_MODULES "/good")) {
    module = std::max(module, entry.file_size());
  }
  settings.largestFile = std::max<rlim_t>(module, 1'000'000);
  ASSERT_GT(lines.size(), settings.largestFile);
  Program program({"edits", "--world", land.file("land.json"), "apply", land.text("many.txt", lines)},
                  settings);
  const Answer answer = program.finish();
  EXPECT_EQ(answer.exitCode, 1);
  EXPECT_EQ(answer.complaint.find("teren: cannot write \"" + land.file("land.edits") + "\": "), 0U)
      << answer.complaint;
  EXPECT_EQ(land.editsJson({"verify"})["edits"], 2);
}

}  // namespace
}  // namespace teren
