// A plugin is built anew while teren-fly flies over what it made: F5 shows the new land, and what cannot be
// taken leaves the old one. The window's own process first, then the whole program.
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>
#include <QApplication>
#include <QImage>
#include <QKeyEvent>
#include <gtest/gtest.h>

#include "apps/fly/FlyWindow.h"
#include "apps/fly/LandSource.h"
#include "apps/options/CommandLine.h"
#include "tests/engine/plugin/ScratchFolder.h"
#include "tests/support/KeyPress.h"
#include "tests/support/WindowedRun.h"

namespace teren {
namespace {

namespace fs = std::filesystem;

constexpr double kLow = -300.0, kHigh = 700.0;  // [m] of the two versions

/// A folder of plugins in which "plain" changes.
class PlainModule {
 public:
  PlainModule() {
    setenv("TEREN_PLUGIN_PATH", folder_.path().c_str(), 1);
    put("low");
  }
  /// Into the very file that is in use, as cp does.
  void put(const std::string& version) const {
    fs::copy_file(fs::path(TEREN_TEST_FLY_MODULES) / version / "teren-plain.so", folder_ / "teren-plain.so",
                  fs::copy_options::overwrite_existing);
  }
  void cutShort() const { fs::resize_file(folder_ / "teren-plain.so", 5000); }
  fs::path world(const std::string& json) const {
    folder_.write("world.json", json);
    return folder_ / "world.json";
  }
  const fs::path& folder() const { return folder_.path(); }

 private:
  ScratchFolder folder_;
};

class FlyReload : public testing::Test {
 protected:
  void SetUp() override {
    world_ = module_.world(R"({ "layers": [ { "generator": "plain" } ] })").string();
    const std::array<const char*, 7> arguments = {"fly",      "--world", world_.c_str(), "--view-level", "1",
                                                  "--radius", "1"};
    ASSERT_FALSE(parseCommandLine(application_, arguments.size(), arguments.data()));
    source_ = std::make_unique<LandSource>(options_, commandLine_);
    auto land = source_->make();
    ASSERT_TRUE(land.ok()) << land.error().message;
    flight_ = std::make_unique<Flight>(std::move(land->engine), AircraftStart{.speed = 60.0});
    window_ = std::make_unique<FlyWindow>(*flight_, Daylight{}, QSize(160, 120),
                                          [this] { return source_->make(); });
    ASSERT_TRUE(window_->settle());
    window_->fly(std::nullopt);
  }
  void TearDown() override {
    window_.reset();
    QApplication::processEvents();
  }

  void pressF5() {
    for (const QEvent::Type type : {QEvent::KeyPress, QEvent::KeyRelease}) {
      QKeyEvent event(type, Qt::Key_F5, Qt::NoModifier);
      QApplication::sendEvent(window_->focusProxy(), &event);
    }
  }
  void fly(std::size_t frames) {
    const std::size_t end = window_->frameTimes().count() + frames;
    while (window_->frameTimes().count() < end) QApplication::processEvents();
  }
  void flyToTheNewLand() {
    while (flight_->isLeaving()) fly(1);
    fly(2);
  }
  double ground() {
    return flight_->engine().finestHeight(flight_->activeObject().motion().position).value_or(1e9);
  }

  const PlainModule module_;
  std::string world_;
  CLI::App application_{"", "fly"};
  const WorldOptions options_{application_};
  const FlyCommandLine commandLine_{application_};
  std::unique_ptr<LandSource> source_;
  std::unique_ptr<Flight> flight_;
  std::unique_ptr<FlyWindow> window_;
};

TEST_F(FlyReload, ShowsTheLandOfTheNewModuleWhereOneFlies) {
  EXPECT_EQ(ground(), kLow);
  module_.put("high");
  fly(3);
  EXPECT_EQ(ground(), kLow) << "nobody has asked yet";
  const Motion before = flight_->activeObject().motion();
  pressF5();
  EXPECT_EQ(window_->lastSentence(), "changed: plain; making the land anew");
  flyToTheNewLand();
  EXPECT_EQ(ground(), kHigh);
  const Motion after = flight_->activeObject().motion();
  const Offset way = offset(before.position, after.position, flight_->engine().world().pitch());
  EXPECT_GT(way.north, 0.0);
  EXPECT_LT(way.north, 600.0) << "it flies on where it was";
  EXPECT_GE(after.height, kHigh) << "and never below the ground";
  pressF5();
  EXPECT_EQ(window_->lastSentence(), "no plugin has changed; making the land anew");
  flyToTheNewLand();
  EXPECT_EQ(flight_->changes(), 2);
}

TEST_F(FlyReload, KeepsTheLandAndSaysWhyWhereTheModuleIsRefused) {
  module_.cutShort();
  pressF5();
  EXPECT_EQ(window_->lastSentence(),
            "the land stays as it is: " + (module_.folder() / "teren-plain.so").string() +
                " was refused: it is cut short: its headers speak of more than the "
                "file holds");
  fly(5);
  EXPECT_FALSE(flight_->isLeaving());
  EXPECT_EQ(ground(), kLow);
  module_.put("high");
  pressF5();
  flyToTheNewLand();
  EXPECT_EQ(ground(), kHigh) << "once it is whole";
}

TEST_F(FlyReload, ReadsTheWorldAnewAndKeepsTheLandWhereThatIsRefused) {
  const std::pair<const char*, const char*> refused[] = {
      {R"({ "layers": [ { "generator": "plain", "parameters": { "height": 3 } } ] })", "height"},
      {R"({ "layers": [)", "world.json"},
      {R"({ "pitch": 32, "layers": [ { "generator": "plain" } ] })", "pitch is now 32 m, expected 64 m"}};
  for (const auto& [json, needle] : refused) {
    module_.world(json);
    pressF5();
    EXPECT_TRUE(window_->lastSentence().starts_with("the land stays as it is: ")) << window_->lastSentence();
    EXPECT_NE(window_->lastSentence().find(needle), std::string::npos) << window_->lastSentence();
    EXPECT_FALSE(flight_->isLeaving());
  }
  module_.world(R"({ "layers": [ { "generator": "plain" }, { "generator": "constant",
                     "parameters": { "height": 50 } } ] })");
  pressF5();
  flyToTheNewLand();
  EXPECT_EQ(ground(), kLow + 50.0);
}

/// The mean colour of the lower left of a picture, where the land is.
QColor landIn(const fs::path& file) {
  const QImage picture(QString::fromStdString(file.string()));
  const int width = picture.width() / 2, top = picture.height() * 3 / 4;
  if (picture.isNull()) return {};
  const QImage land = picture.copy(0, top, width, picture.height() - top);
  return land.scaled(1, 1, Qt::IgnoreAspectRatio, Qt::SmoothTransformation).pixelColor(0, 0);
}

TEST(FlyProgram, TurnsWaterIntoSnowWhenF5ComesAfterTheModuleHasChanged) {
  const PlainModule module;
  const std::string display = std::getenv("DISPLAY");
  const auto flown = [&](const std::string& picture, bool press) {
    module.put("low");
    const std::string words =
        TEREN_FLY_PROGRAM " --generator plain --radius 3 --size 640x480 --seconds 4 --screenshot " + picture;
    auto run =
        std::async(std::launch::async, [&] { return test::runOnDisplay(display, words, module.folder()); });
    while (test::pressKey(display, "Shift_L") == 0) {
      if (run.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready) break;
    }
    module.put("high");
    if (press) test::pressKey(display, "F5");
    const test::Outcome outcome = run.get();
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_EQ(outcome.errors, "");
    return landIn(picture);
  };
  const QColor water = flown(module.folder() / "water.png", false);
  const QColor snow = flown(module.folder() / "snow.png", true);
  EXPECT_GT(snow.lightness(), water.lightness() + 60) << "white, where before was the sea";
}

}  // namespace
}  // namespace teren
