// Runs teren-sandbox as a person would, and looks at what it leaves.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <unistd.h>
#include <vector>

#include <QColor>
#include <QImage>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/PrivateDisplay.h"
#include "tests/support/WindowedRun.h"

namespace teren {
namespace {

namespace fs = std::filesystem;
using test::contents;
using test::Outcome;

class Sandbox : public testing::Test {
 protected:
  static void SetUpTestSuite() { display_ = std::make_unique<PrivateDisplay>(); }
  static void TearDownTestSuite() { display_.reset(); }
  Sandbox() { fs::create_directories(folder_); }
  ~Sandbox() override { fs::remove_all(folder_); }
  void SetUp() override { ASSERT_FALSE(display_->name().empty()) << "Xvfb did not start"; }

  Outcome run(const std::string& arguments) const { return runOn(display_->name(), arguments); }
  Outcome runOn(const std::string& display, const std::string& arguments) const {
    return test::runOnDisplay(display, TEREN_SANDBOX_PROGRAM " " + arguments, folder_);
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  /// A file with a script; its name.
  std::string script(const std::string& text) const {
    std::ofstream(folder_ / "script.txt", std::ios::binary) << text;
    return file("script.txt");
  }
  static void expectOneSentence(const Outcome& outcome, int code, const std::string& what) {
    EXPECT_EQ(outcome.exitCode, code) << what << ": " << outcome.errors;
    EXPECT_TRUE(outcome.errors.starts_with("teren-sandbox: ")) << what << ": " << outcome.errors;
    EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  }

  static std::unique_ptr<PrivateDisplay> display_;
  const fs::path folder_ = fs::temp_directory_path() / ("teren-sandbox-test-" + std::to_string(getpid()));
};

std::unique_ptr<PrivateDisplay> Sandbox::display_;

constexpr const char* kDig =
    "sand 1500 seed=5\ntool round size=0.1 depth=0.04\ndrag 0.3 0.3 to 0.7 0.7\nbeats 20\nhash\n";

TEST_F(Sandbox, ShowsSandAndEndsByItselfWithoutAWord) {
  const Outcome shown = run("--vertices 2000 --seconds 0.5 --size 700x400 --screenshot " + file("a.png") +
                            " --stats " + file("a.json"));
  EXPECT_EQ(shown.exitCode, 0);
  EXPECT_EQ(shown.output, "");
  EXPECT_EQ(shown.errors, "");
  const QImage picture(QString::fromStdString(file("a.png")));
  ASSERT_FALSE(picture.isNull());
  int sand = 0, sky = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const QColor colour(picture.pixel(x, y));
      sand += colour.red() > colour.blue() + 30 ? 1 : 0;
      sky += colour.blue() > colour.red() + 10 && colour.lightness() > 190 ? 1 : 0;
    }
  }
  const int pixels = picture.width() * picture.height();
  EXPECT_GT(sand, pixels / 8);
  EXPECT_GT(sky, pixels / 4);
  EXPECT_GT(sand + sky, pixels * 99 / 100);
}

TEST_F(Sandbox, LeavesTheFiguresThatScriptsReadOn) {
  EXPECT_EQ(run("--vertices 2000 --seconds 0 --size 400x300 --stats " + file("a.json")).exitCode, 0);
  const nlohmann::json stats = nlohmann::json::parse(contents(file("a.json")), nullptr, false);
  ASSERT_TRUE(stats.is_object());
  std::set<std::string> keys;
  for (const auto& item : stats.items()) keys.insert(item.key());
  EXPECT_EQ(keys, (std::set<std::string>{"frames", "frame_ms", "engine_us", "vertices", "triangles",
                                         "constrained", "bytes"}));
  EXPECT_EQ(stats["vertices"], 2000);
  EXPECT_EQ(stats["constrained"], 0);
  EXPECT_GE(stats["frames"].get<int>(), 3);
  EXPECT_GT(stats["frame_ms"]["p50"].get<double>(), 0.0);
  EXPECT_GE(stats["frame_ms"]["max"].get<double>(), stats["frame_ms"]["p99"].get<double>());
  EXPECT_GT(stats["bytes"].get<double>(), 2000 * 60.0);
}

TEST_F(Sandbox, MakesTheSameOfAScriptWithAndWithoutAWindow) {
  const std::string dig = script(kDig);
  const Outcome seen = run("--script " + dig + " --seconds 0 --size 400x300");
  const Outcome unseen = run("--script " + dig + " --no-window");
  const Outcome alone = runOn("''", "--script " + dig);
  EXPECT_EQ(seen.exitCode, 0) << seen.errors;
  EXPECT_EQ(unseen.exitCode, 0) << unseen.errors;
  EXPECT_EQ(alone.exitCode, 0) << "no display, and none is needed: " << alone.errors;
  EXPECT_TRUE(unseen.output.starts_with("hash ")) << unseen.output;
  EXPECT_EQ(seen.output, unseen.output);
  EXPECT_EQ(alone.output, unseen.output);
}

TEST_F(Sandbox, MakesThePicturesOfAScriptAndEndsWhereItSaysSo) {
  const std::string wire = script("sand 1500\ncamera tilt=60 turn=10\nscreenshot " + file("a.png") +
                                  "\nstamp 0.5 0.5\nwireframe on\nscreenshot " + file("b.png") + "\nquit\n");
  const Outcome played = run("--script " + wire + " --size 500x300");
  EXPECT_EQ(played.exitCode, 0) << played.errors;
  const QImage surface(QString::fromStdString(file("a.png"))), edges(QString::fromStdString(file("b.png")));
  ASSERT_FALSE(surface.isNull());
  ASSERT_EQ(surface.size(), edges.size());
  const auto red = [](const QImage& picture) {
    int count = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const QColor colour(picture.pixel(x, y));
        count += colour.red() > 130 && colour.green() < 60 && colour.blue() < 60 ? 1 : 0;
      }
    }
    return count;
  };
  EXPECT_EQ(red(surface), 0);
  EXPECT_GT(red(edges), 30);
}

TEST_F(Sandbox, GoesOnWithSandThatWasSaved) {
  const std::string saved = file("a.sand");
  const Outcome first = run("--no-window --script " + script(std::string(kDig) + "save " + saved + "\n"));
  EXPECT_EQ(first.exitCode, 0) << first.errors;
  const Outcome second = run("--no-window --load " + saved + " --script " + script("hash\n"));
  EXPECT_EQ(second.exitCode, 0) << second.errors;
  EXPECT_EQ(second.output, first.output);
}

TEST_F(Sandbox, ListsTheCommandsOfScripts) {
  const Outcome help = run("--script-help");
  EXPECT_EQ(help.exitCode, 0);
  EXPECT_NE(help.output.find("  drag X Y"), std::string::npos);
}

TEST_F(Sandbox, RefusesAWrongCommandLineInOneSentence) {
  const std::string good = script("undo\n"), picture = file("picture.txt");
  std::ofstream(picture) << "screenshot a.png\n";
  for (const std::string& arguments :
       std::vector<std::string>{"--vertices 3",
                                "--vertices -1",
                                "--vertices 1e9",
                                "--vertices nan",
                                "--size-m 0",
                                "--size-m inf",
                                "--size-m 1e300",
                                "--roughness-m -1",
                                "--size 0x0",
                                "--seconds -1",
                                "--screenshot ''",
                                "--load ''",
                                "--load a --vertices 100",
                                "--no-window",
                                "--no-window=3",
                                "--wireframe=yes",
                                "extra",
                                "--script /no/such/script",
                                "--script /",
                                "--script ''",
                                "--script /dev/zero",
                                "--no-window --seconds 1 --script " + good,
                                "--no-window --screenshot a.png --script " + good,
                                "--no-window --stats a.json --script " + good,
                                "--no-window --script " + picture,
                                "--script-help --script " + good}) {
    const Outcome refused = run(arguments);
    expectOneSentence(refused, 2, arguments);
    EXPECT_EQ(refused.output, "") << arguments;
  }
}

TEST_F(Sandbox, RefusesHostileScriptsInOneSentence) {
  const std::vector<std::string> scripts = {
      std::string("\x7f"
                  "ELF\0\1\2\3",
                  8),
      std::string(100'000, 'x'),
      "stamp nan nan\n",
      "stamp 0.5 1e999\n",
      "tool polygon outline=\"\"\n",
      "tool polygon outline=\"0,0 1,1 1,0 0,1\"\n",
      "sand 1500\nstamp 1.001 0.5\n",
      "sand 1500\ndrag 0.5 0.5 to 900 900\n",
      "load " + file("script.txt") + "\n",
      "load /dev/zero\n",
      "tool polygon file=" + file("script.txt") + "\n",
      "undo\n",
  };
  for (const std::string& text : scripts) {
    const Outcome refused = run("--vertices 500 --no-window --script " + script(text));
    expectOneSentence(refused, 2, text.substr(0, 60));
    EXPECT_NE(refused.errors.find("script.txt, line "), std::string::npos) << refused.errors;
  }
}

TEST_F(Sandbox, EndsAWindowWhoseScriptFails) {
  expectOneSentence(run("--script " + script("sand 500\nstamp 0.5 0.5\nstamp 1.001 0.5\n")), 2,
                    "off the edge");
  expectOneSentence(run("--script " + script("sand 500\nscreenshot /no/such/folder/a.png\n")), 1,
                    "no folder");
}

TEST_F(Sandbox, SaysInOneSentenceThatSandCannotBeLoaded) {
  std::ofstream(folder_ / "bad.sand") << "no sand";
  expectOneSentence(run("--no-window --load " + file("bad.sand") + " --script " + script("hash\n")), 2,
                    "bad");
  expectOneSentence(run("--load " + file("bad.sand") + " --seconds 0"), 2, "bad in a window");
}

TEST_F(Sandbox, SaysInOneSentenceThatItCannotOpenAWindow) {
  const std::string picture = script("screenshot a.png\n");
  for (const char* display : {"''", ":987654"}) {
    expectOneSentence(runOn(display, "--seconds 1"), 1, display);
    expectOneSentence(runOn(display, "--script " + picture), 1, display);
  }
}

TEST_F(Sandbox, EndsCleanlyWhenInterrupted) {
  const Outcome seen = runOn(display_->name() + " timeout -s INT 3",
                             "--vertices 500 --size 300x200 --stats " + file("b.json"));
  EXPECT_EQ(seen.exitCode, 124);  // timeout's own; a program killed by the signal would not have written
  EXPECT_EQ(seen.errors, "");
  EXPECT_TRUE(nlohmann::json::parse(contents(file("b.json")), nullptr, false).is_object());
  const std::string endless =
      script("sand 200000 roughness=0.5\nsettle 1000000\nsave " + file("c.sand") + "\n");
  const Outcome unseen = runOn("'' timeout -s INT 3", "--no-window --script " + endless);
  EXPECT_EQ(unseen.exitCode, 124);
  EXPECT_EQ(unseen.errors, "teren-sandbox: interrupted\n");
  EXPECT_FALSE(fs::exists(file("c.sand")));
}

TEST_F(Sandbox, EndsWithoutWaitingForTheSandToBeginWith) {
  const Outcome ended =
      runOn("'' timeout -s INT 1", "--no-window --vertices 4000000 --script " + script("hash\n"));
  EXPECT_EQ(ended.exitCode, 124);
  EXPECT_EQ(ended.errors, "teren-sandbox: interrupted\n");
  EXPECT_EQ(ended.output, "") << "no command of the script has been reached";
}

}  // namespace
}  // namespace teren
