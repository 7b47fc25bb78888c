// Runs teren-fly as a person would, and looks at what it leaves.
#include <algorithm>
#include <cstdlib>
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

class Fly : public testing::Test {
 protected:
  static constexpr int kWidth = 960, kHeight = 540;

  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("teren-fly-test-" + std::to_string(getpid()));
    fs::create_directories(folder_);
    display_ = std::make_unique<PrivateDisplay>();
    if (display_->name().empty()) return;
    flight_ = run("--seconds 2 --size 960x540 --radius 4 --screenshot " + (folder_ / "a.png").string() +
                  " --stats " + (folder_ / "a.json").string());
    picture_ = QImage(QString::fromStdString((folder_ / "a.png").string()));
  }
  static void TearDownTestSuite() {
    display_.reset();
    fs::remove_all(folder_);
  }
  void SetUp() override { ASSERT_FALSE(display_->name().empty()) << "Xvfb did not start"; }

  static Outcome run(const std::string& arguments) { return runOn(display_->name(), arguments); }
  /// Where `display` is followed by words, they run the program.
  static Outcome runOn(const std::string& display, const std::string& arguments) {
    return test::runOnDisplay(display, TEREN_FLY_PROGRAM " " + arguments, folder_);
  }

  /// The mean colour of a part of the picture, given in hundredths of its sides.
  static QColor mean(int left, int top, int right, int bottom) {
    double sums[3] = {};
    int count = 0;
    for (int y = kHeight * top / 100; y < kHeight * bottom / 100; ++y) {
      for (int x = kWidth * left / 100; x < kWidth * right / 100; ++x, ++count) {
        const QRgb color = picture_.pixel(x, y);
        sums[0] += qRed(color);
        sums[1] += qGreen(color);
        sums[2] += qBlue(color);
      }
    }
    return {static_cast<int>(sums[0] / count), static_cast<int>(sums[1] / count),
            static_cast<int>(sums[2] / count)};
  }

  static std::unique_ptr<PrivateDisplay> display_;
  static fs::path folder_;
  static Outcome flight_;
  static QImage picture_;
};

std::unique_ptr<PrivateDisplay> Fly::display_;
fs::path Fly::folder_;
Outcome Fly::flight_;
QImage Fly::picture_;

TEST_F(Fly, EndsByItselfWithoutAWord) {
  EXPECT_EQ(flight_.exitCode, 0);
  EXPECT_EQ(flight_.output, "");
  EXPECT_EQ(flight_.errors, "");
}

TEST_F(Fly, LeavesAPictureOfTheWindowsSize) {
  ASSERT_FALSE(picture_.isNull());
  EXPECT_EQ(picture_.width(), kWidth);
  EXPECT_EQ(picture_.height(), kHeight);
}

TEST_F(Fly, ShowsBlueSkyAboveAndLandBelow) {
  ASSERT_FALSE(picture_.isNull());
  const QColor sky = mean(0, 0, 50, 8), land = mean(0, 80, 85, 100);
  EXPECT_GT(sky.blue(), sky.red() + 25);
  EXPECT_GT(sky.lightness(), 90);
  EXPECT_LT(land.blue() - land.red(), sky.blue() - sky.red() - 15);
  EXPECT_LT(land.lightness(), sky.lightness());
  EXPECT_GT(land.lightness(), 20);
}

TEST_F(Fly, ShowsLandOfManyShadesAndNothingBlack) {
  ASSERT_FALSE(picture_.isNull());
  std::set<QRgb> shades;
  int black = 0;
  for (int y = kHeight * 3 / 4; y < kHeight; ++y) {
    for (int x = 0; x < kWidth * 85 / 100; ++x) {
      const QRgb color = picture_.pixel(x, y);
      shades.insert(color);
      if (std::max({qRed(color), qGreen(color), qBlue(color)}) < 6) ++black;
    }
  }
  EXPECT_GT(shades.size(), 500U);
  EXPECT_LT(black, kWidth * kHeight / 4 / 100);
}

TEST_F(Fly, ShowsItsFiguresAsBrightTextOnADarkPanel) {
  ASSERT_FALSE(picture_.isNull());
  int bright = 0, dark = 0;
  for (int y = 20; y < 260; ++y) {
    for (int x = kWidth - 260; x < kWidth - 20; ++x) {
      const int lightness = QColor(picture_.pixel(x, y)).lightness();
      if (lightness > 225) ++bright;
      if (lightness < 110) ++dark;
    }
  }
  EXPECT_GT(bright, 1000);
  EXPECT_GT(dark, 240 * 240 / 2);
}

TEST_F(Fly, LeavesExactlyTheFiguresThatScriptsReadOn) {
  const nlohmann::json stats = nlohmann::json::parse(contents(folder_ / "a.json"), nullptr, false);
  ASSERT_TRUE(stats.is_object());
  std::set<std::string> keys;
  for (const auto& item : stats.items()) keys.insert(item.key());
  EXPECT_EQ(keys, (std::set<std::string>{"frames", "frame_ms", "engine_us", "triangles", "nodes", "bytes",
                                         "pixel_error"}));
  EXPECT_GE(stats["frames"].get<int>(), 3);
  for (const char* key : {"frame_ms", "engine_us"}) {
    ASSERT_EQ(stats[key].size(), 3U) << key;
    const double p50 = stats[key]["p50"].get<double>(), p99 = stats[key]["p99"].get<double>();
    EXPECT_GT(p50, 0.0) << key;
    EXPECT_GE(p99, p50) << key;
    EXPECT_GE(stats[key]["max"].get<double>(), p99) << key;
  }
  EXPECT_GE(stats["nodes"].get<int>(), 9 * 8);  // of 9 * 9; a column of them may be on its way
  EXPECT_GT(stats["triangles"].get<int>(), 2 * stats["nodes"].get<int>());
  EXPECT_GT(stats["bytes"].get<double>(), 12.0 * stats["triangles"].get<double>() / 2.0);
  ASSERT_EQ(stats["pixel_error"].size(), 2U);
  EXPECT_GT(stats["pixel_error"]["p99"].get<double>(), 0.0);
  EXPECT_GE(stats["pixel_error"]["max"].get<double>(), stats["pixel_error"]["p99"].get<double>());
}

TEST_F(Fly, HasNothingToSayAboutAWorldOfAnotherPitch) {
  const Outcome flown = run("--generator fault --pitch 1024 --seconds 0 --size 200x100");
  EXPECT_EQ(flown.exitCode, 0);
  EXPECT_EQ(flown.errors, "");
}

TEST_F(Fly, RefusesAWrongCommandLineInOneSentence) {
  for (const char* arguments : {"--speed fast",
                                "--speed -3",
                                "--speed nan",
                                "--size 1280",
                                "--size 0x0",
                                "--size 1280x720x3",
                                "--seconds -1",
                                "--view-level -1",
                                "--view-level 99",
                                "--radius 0",
                                "--radius 65",
                                "--radius 2.5",
                                "--workers -1",
                                "--workers 65",
                                "--cap-mib 7",
                                "--cap-mib nan",
                                "--view-distance 0",
                                "--view-distance 1e9",
                                "--view-distance 500 --radius 3",
                                "--screenshot ''",
                                "--edits ''",
                                "--stats=",
                                "--autopilot=7",
                                "--pixel-error 0",
                                "--pixel-error nan",
                                "--pixel-error 101",
                                "--pixel-error 8 --radius 3",
                                "--pixel-error 8 --view-level 1",
                                "--pixel-error 8 --view-distance 2e6",
                                "--generator nothing-of-that-name",
                                "--world /no/such/file",
                                "extra"}) {
    const Outcome refused = run(arguments);
    EXPECT_EQ(refused.exitCode, 2) << arguments;
    EXPECT_EQ(refused.output, "") << arguments;
    EXPECT_TRUE(refused.errors.starts_with("teren-fly: ")) << arguments << ": " << refused.errors;
    EXPECT_EQ(std::count(refused.errors.begin(), refused.errors.end(), '\n'), 1) << refused.errors;
  }
}

TEST_F(Fly, LeavesNoFileOfEditsBehindWhereNothingWasDug) {
  EXPECT_FALSE(fs::exists(folder_ / "teren")) << "the user's data folder";
  const fs::path file = folder_ / "nothing.edits";
  EXPECT_EQ(run("--seconds 0 --size 200x100 --radius 1 --edits " + file.string()).exitCode, 0);
  EXPECT_FALSE(fs::exists(file));
}

/// How many pixels of two pictures of one size differ plainly.
int differences(const QImage& one, const QImage& other) {
  int count = 0;
  for (int y = 0; y < one.height(); ++y) {
    for (int x = 0; x < one.width(); ++x) {
      const QColor a(one.pixel(x, y)), b(other.pixel(x, y));
      if (std::abs(a.lightness() - b.lightness()) > 12) ++count;
    }
  }
  return count;
}

TEST_F(Fly, ShowsAHoleThatTheLandsFileOfEditsHolds) {
  std::ofstream(folder_ / "land.json")
      << R"({ "layers": [ { "generator": "constant", "parameters": { "height": 30 } } ] })";
  std::ofstream(folder_ / "hole.txt") << "stamp crater 60 420 0 120 90 7 0\n";
  const std::string world = "--world " + (folder_ / "land.json").string();
  const auto fly = [&](const std::string& name) {
    const Outcome flown =
        run(world + " --speed 5 --seconds 0 --size 480x300 --radius 8 --view-level 1 --screenshot " +
            (folder_ / (name + ".png")).string() + " --stats " + (folder_ / (name + ".json")).string());
    EXPECT_EQ(flown.exitCode, 0);
    EXPECT_EQ(flown.errors, "");
    return QImage(QString::fromStdString((folder_ / (name + ".png")).string()));
  };
  const QImage plain = fly("plain");
  ASSERT_EQ(std::system((std::string(TEREN_PROGRAM " edits ") + world + " apply " +
                         (folder_ / "hole.txt").string() + " >/dev/null 2>&1")
                            .c_str()),
            0);
  ASSERT_TRUE(fs::exists(folder_ / "land.edits"));
  const QImage dug = fly("dug"), again = fly("again");
  // The head-up display takes the right of the picture.
  const QRect land(0, 150, 300, 150);
  EXPECT_GT(differences(plain.copy(land), dug.copy(land)), 2000);
  EXPECT_LT(differences(dug.copy(land), again.copy(land)), 500) << "the same after a restart";
  const nlohmann::json stats = nlohmann::json::parse(contents(folder_ / "dug.json"), nullptr, false);
  EXPECT_EQ(stats.value("edits", 0), 1);
  EXPECT_FALSE(nlohmann::json::parse(contents(folder_ / "plain.json")).contains("edits"));
}

TEST_F(Fly, SaysInOneSentenceThatAFileOfEditsCannotBeHadAndFliesOn) {
  const fs::path file = folder_ / "text.edits";
  std::ofstream(file) << "no journal";
  const Outcome flown = run("--seconds 0 --size 200x100 --radius 1 --edits " + file.string());
  EXPECT_EQ(flown.exitCode, 0);
  EXPECT_TRUE(flown.errors.starts_with("teren-fly: ")) << flown.errors;
  EXPECT_NE(flown.errors.find("text.edits"), std::string::npos) << flown.errors;
  EXPECT_EQ(std::count(flown.errors.begin(), flown.errors.end(), '\n'), 1) << flown.errors;
  EXPECT_EQ(contents(file), "no journal") << "and is left as it was";
}

TEST_F(Fly, SaysInOneSentenceThatItCannotOpenAWindow) {
  for (const char* display : {"''", ":987654"}) {
    const Outcome failed = runOn(display, "--seconds 1");
    EXPECT_EQ(failed.exitCode, 1);
    EXPECT_TRUE(failed.errors.starts_with("teren-fly: cannot open a window")) << failed.errors;
    EXPECT_EQ(std::count(failed.errors.begin(), failed.errors.end(), '\n'), 1) << failed.errors;
  }
}

TEST_F(Fly, SaysInOneSentenceThatItCannotWriteAFile) {
  const Outcome failed = run("--seconds 0 --size 200x100 --radius 1 --screenshot /no/such/folder/a.png");
  EXPECT_EQ(failed.exitCode, 1);
  EXPECT_NE(failed.errors.find("/no/such/folder/a.png"), std::string::npos);
  EXPECT_EQ(std::count(failed.errors.begin(), failed.errors.end(), '\n'), 1) << failed.errors;
}

TEST_F(Fly, EndsCleanlyWhenInterrupted) {
  const Outcome interrupted = runOn(display_->name() + " timeout -s INT 2",
                                    "--size 200x100 --radius 1 --stats " + (folder_ / "b.json").string());
  EXPECT_EQ(interrupted.exitCode,
            124);  // timeout's own; a program killed by the signal would not have written
  EXPECT_EQ(interrupted.errors, "");
  EXPECT_TRUE(nlohmann::json::parse(contents(folder_ / "b.json"), nullptr, false).is_object());
}

TEST_F(Fly, SaysWhatErrorAndDistanceItsFiguresAreOf) {
  const Outcome flown = run("--seconds 0.2 --size 200x100 --pixel-error 50 --view-distance 900 --stats " +
                            (folder_ / "c.json").string());
  EXPECT_EQ(flown.exitCode, 0) << flown.errors;
  const nlohmann::json stats = nlohmann::json::parse(contents(folder_ / "c.json"), nullptr, false);
  ASSERT_TRUE(stats.is_object() && stats.contains("detail"));
  EXPECT_EQ(stats["detail"], (nlohmann::json{{"pixel_error", 50.0}, {"distance", 900.0}, {"lines", 100.0}}));
}

}  // namespace
}  // namespace teren
