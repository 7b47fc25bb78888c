// Runs teren-static as a person would, and presses its keys; looks at the pictures.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

#include <QApplication>
#include <QKeyEvent>
#include <QTimer>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "apps/static/StaticWindow.h"
#include "apps/window/WindowProgram.h"
#include "tests/apps/static/PictureParts.h"
#include "tests/support/PrivateDisplay.h"
#include "tests/support/WindowedRun.h"

namespace teren {
namespace {

namespace fs = std::filesystem;
using test::Colour;
using test::contents;
using test::countParts;
using test::countPixels;
using test::Outcome;

constexpr const char* kGentle = "--generator fault --set deviation=1 --seed 5 ";  // no hill hides a piece

/// The background that the pieces surround: gaps between them, and holes.
int backgroundInside(const QImage& picture) {
  const auto background = [&](int x, int y) { return test::colourAt(picture, x, y) == Colour::background; };
  int all = 0, largest = 0;  // the largest part is what is around everything
  for (const int size : test::partsOf(picture, background)) {
    all += size;
    largest = std::max(largest, size);
  }
  return all - largest;
}

void expectTogether(const QImage& picture) {
  ASSERT_FALSE(picture.isNull());
  const int pixels = picture.width() * picture.height();
  EXPECT_GT(countPixels(picture, Colour::ground), pixels / 8);
  EXPECT_GT(countPixels(picture, Colour::background), pixels / 4);
  EXPECT_EQ(countParts(picture, Colour::ground, 100), 1) << "one surface";
  EXPECT_EQ(countPixels(picture, Colour::seam), 0);
  EXPECT_EQ(countPixels(picture, Colour::corner), 0);
  EXPECT_EQ(countPixels(picture, Colour::black), 0);
  EXPECT_EQ(backgroundInside(picture), 0) << "no crack";
}

void expectApart(const QImage& picture) {
  ASSERT_FALSE(picture.isNull());
  EXPECT_EQ(countParts(picture, Colour::ground, 500), 9) << "patches";
  EXPECT_EQ(countParts(picture, Colour::seam, 100), 12) << "seams";
  EXPECT_EQ(countParts(picture, Colour::corner, 8), 4) << "corner pieces";
  EXPECT_EQ(countPixels(picture, Colour::black), 0);
}

class Static : public testing::Test {
 protected:
  Static() { fs::create_directories(folder_); }
  ~Static() override { fs::remove_all(folder_); }

  Outcome run(const std::string& arguments) const {
    return test::runOnDisplay(std::getenv("DISPLAY"), TEREN_STATIC_PROGRAM " " + arguments, folder_);
  }

  /// The picture that a run of one second leaves.
  QImage picture(const std::string& arguments) const {
    const fs::path file = folder_ / "a.png";
    const Outcome outcome = run(arguments + " --size 900x700 --seconds 1 --screenshot " + file.string());
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_EQ(outcome.output, "");
    EXPECT_EQ(outcome.errors, "");
    return QImage(QString::fromStdString(file.string()));
  }

  const fs::path folder_ = fs::temp_directory_path() / ("teren-static-test-" + std::to_string(getpid()));
};

TEST_F(Static, ShowsOneSurfaceWithoutCracks) {
  expectTogether(picture(kGentle));
}

TEST_F(Static, ShowsEveryPatchSeamAndCornerPieceApartWhenExploded) {
  expectApart(picture(std::string(kGentle) + "--explode"));
}

TEST_F(Static, ShowsTheBackgroundThroughWire) {
  const QImage wire = picture(std::string(kGentle) + "--wireframe");
  EXPECT_GT(countPixels(wire, Colour::ground), 10'000);
  EXPECT_GT(backgroundInside(wire), 1000);
}

TEST_F(Static, ShowsGroundOfTheStandardWorldAndNoBlackPicture) {
  const QImage standard = picture("");
  EXPECT_EQ(countParts(standard, Colour::ground, 5000), 1);
  EXPECT_EQ(countPixels(standard, Colour::black), 0);
  const QImage exploded = picture("--explode");
  EXPECT_GE(countParts(exploded, Colour::ground, 2000), 9);
  EXPECT_GT(countPixels(exploded, Colour::seam), 2000);
}

TEST_F(Static, LeavesTheFiguresThatEveryProgramWithAWindowLeaves) {
  const fs::path file = folder_ / "a.json";
  EXPECT_EQ(run("--seconds 0.2 --size 300x200 --stats " + file.string()).exitCode, 0);
  const nlohmann::json stats = nlohmann::json::parse(contents(file), nullptr, false);
  ASSERT_TRUE(stats.is_object());
  EXPECT_EQ(stats.size(), 7U);
  EXPECT_EQ(stats["nodes"], 9);
  // Of 3 x 3 patches of 32 x 32 squares the outermost ring is not drawn.
  EXPECT_EQ(stats["triangles"], 2 * (3 * 32 - 2) * (3 * 32 - 2));
  EXPECT_GE(stats["frames"].get<int>(), 3);
  EXPECT_GT(stats["frame_ms"]["p50"].get<double>(), 0.0);
  EXPECT_GT(stats["engine_us"]["max"].get<double>(), 0.0);
  EXPECT_GT(stats["bytes"].get<double>(), 9 * 33 * 33 * 4.0);
  EXPECT_EQ(stats["pixel_error"]["max"], 0.0);  // all is level 0
}

TEST_F(Static, RefusesAWrongCommandLineInOneSentence) {
  for (const char* arguments :
       {"--seconds -1", "--size 0x0", "--size 800", "--screenshot ''", "--explode=no", "--generator nothing",
        "--generator fault --samples 5", "--world /no/such/file", "extra"}) {
    const Outcome refused = run(arguments);
    EXPECT_EQ(refused.exitCode, 2) << arguments;
    EXPECT_EQ(refused.output, "") << arguments;
    EXPECT_TRUE(refused.errors.starts_with("teren-static: ")) << arguments << ": " << refused.errors;
    EXPECT_EQ(std::count(refused.errors.begin(), refused.errors.end(), '\n'), 1) << refused.errors;
  }
}

// ---- Keys ----

class Stone final : public Object {
 public:
  void update(double, const Ground&) override {}
  Motion motion() const override { return {}; }
};

std::unique_ptr<Engine> gentleLand() {
  WorldDescription description;
  LayerDescription layer;
  layer.generator = "fault";
  layer.parameters = {{"deviation", 1.0}};
  description.layers = {layer};
  EngineOptions options;
  options.view = {.level = 0, .radius = 1};
  std::unique_ptr<Engine> engine =
      Engine::create(World::create(description, *PluginRegistry::standard()).value(), options).value();
  engine->add(std::make_unique<Stone>());
  return engine;
}

/// Presses keys, each once the movement begun by the one before is over, then Q; the last picture. Ends only
/// if Q quits.
QImage pictureAfter(const std::vector<int>& keys) {
  const std::unique_ptr<Engine> engine = gentleLand();
  StaticWindow window(*engine, {900, 700}, {});
  EXPECT_TRUE(window.settle());
  window.begin(std::nullopt);
  std::size_t pressed = 0;
  QTimer timer;
  timer.callOnTimeout([&] {
    if (window.moving()) return;
    const int key = pressed < keys.size() ? keys[pressed++] : Qt::Key_Q;
    for (const QEvent::Type type : {QEvent::KeyPress, QEvent::KeyRelease}) {
      QKeyEvent event(type, key, Qt::NoModifier);
      QApplication::sendEvent(window.focusProxy(), &event);
    }
  });
  timer.start(50);
  QApplication::exec();
  return window.lastPicture();
}

TEST(StaticKeys, EMovesThePiecesApart) {
  expectApart(pictureAfter({Qt::Key_E}));
}

TEST(StaticKeys, EAgainPutsThePiecesTogether) {
  expectTogether(pictureAfter({Qt::Key_E, Qt::Key_E}));
}

TEST(StaticKeys, WShowsWireAndWAgainTheSurface) {
  EXPECT_GT(backgroundInside(pictureAfter({Qt::Key_W})), 1000);
  expectTogether(pictureAfter({Qt::Key_W, Qt::Key_W}));
}

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const teren::PrivateDisplay display;
  if (display.name().empty()) {
    std::fputs("Xvfb did not start\n", stderr);
    return 1;
  }
  setenv("DISPLAY", display.name().c_str(), 1);
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  unsetenv("WAYLAND_DISPLAY");
  int failed = 1;
  const auto tested = teren::runWithWindows("test-static-program", argv, [&] {
    failed = RUN_ALL_TESTS();
    return teren::Result<void>();
  });
  return tested ? failed : 1;
}
