// The window of the demo under keys as the window system sends them.
#include "apps/fly/FlyWindow.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <QApplication>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QSlider>
#include <QWheelEvent>
#include <gtest/gtest.h>

#include "teren/PluginRegistry.h"

#include "tests/engine/plugin/ScratchFolder.h"

namespace teren {
namespace {

class FlyWindowKeys : public testing::Test {
 protected:
  void SetUp() override { open(WorldDescription::standard(), {.view = {3, 1}}, QSize(160, 120)); }
  void open(const WorldDescription& description, const EngineOptions& options, QSize size) {
    auto world = World::create(description, *PluginRegistry::standard());
    ASSERT_TRUE(world.ok());
    auto engine = Engine::create(*world, options);
    ASSERT_TRUE(engine.ok());
    flight_ = std::make_unique<Flight>(std::move(*engine), AircraftStart{.speed = 60.0});
    prepare(*flight_, *world);
    window_ = std::make_unique<FlyWindow>(*flight_, Daylight{}, size,
                                          [] { return Error{"this test flies over one land"}; });
    ASSERT_TRUE(window_->settle());
    window_->fly(std::nullopt);
  }
  virtual void prepare(Flight& /*flight*/, std::shared_ptr<const World> /*world*/) {}
  void TearDown() override {
    window_.reset();
    QApplication::processEvents();
  }

  void send(QEvent::Type type, int key, bool repeated = false) {
    QKeyEvent event(type, key, Qt::NoModifier, QString(), repeated);
    QApplication::sendEvent(window_->focusProxy(), &event);
  }
  void press(int key) { send(QEvent::KeyPress, key); }
  void release(int key) { send(QEvent::KeyRelease, key); }
  void fly(int frames) {
    const std::size_t end = window_->frameTimes().count() + static_cast<std::size_t>(frames);
    while (window_->frameTimes().count() < end) QApplication::processEvents();
  }
  /// Until it is so, without drawing: where that alone takes longer than a frame, as it does under
  /// sanitizers, the land has next to nothing of one.
  void flyUnseenUntil(const std::function<bool()>& isSo) {
    fly(1);  // what was pressed takes effect in a frame
    for (int turn = 0; turn < 5000 && !isSo(); ++turn) {
      flight_->advance(window_->isFrozen() ? 0.0 : 1.0 / 60.0);
      flight_->frameDone();
    }
    ASSERT_TRUE(isSo());
    fly(1);
  }
  void tap(int key) {
    press(key);
    release(key);
  }
  const std::optional<DetailSettings>& detail() { return flight_->engine().options().view.detail; }
  Aircraft& aircraft(std::size_t index) { return *flight_->aircraft()[index]; }

  std::unique_ptr<Flight> flight_;
  std::unique_ptr<FlyWindow> window_;
};

/// With detail by error, coarse and near, so that it is there soon.
class FlyWindowDetail : public FlyWindowKeys {
 protected:
  void SetUp() override {
    open(land(), {.view = {.detail = DetailSettings{.pixelError = 11.0, .distance = 3000.0}}},
         QSize(640, 200));
  }
  /// Of one layer, whose errors are soon measured.
  static WorldDescription land() {
    return WorldDescription::fromJson(R"({ "layers": [ { "generator": "fault" } ] })", "the test's").value();
  }
  QSlider& slider(const char* name) { return *window_->findChild<QSlider*>(QString::fromLatin1(name)); }
  QString says(const char* name) { return window_->findChild<QLabel*>(QString::fromLatin1(name))->text(); }
  /// As a hand does it: one page along the groove.
  void clickBeside(QSlider& slider, bool right) {
    const QPointF place(right ? 0.9 * slider.width() : 0.1 * slider.width(), 0.3 * slider.height());
    for (const QEvent::Type type : {QEvent::MouseButtonPress, QEvent::MouseButtonRelease}) {
      QMouseEvent event(type, place, Qt::LeftButton,
                        type == QEvent::MouseButtonPress ? Qt::LeftButton : Qt::NoButton, Qt::NoModifier);
      QApplication::sendEvent(&slider, &event);
    }
  }
  double farOff(const Viewpoint& from) {
    const Offset away =
        offset(from.pose.position, window_->viewpoint().pose.position, flight_->engine().world().pitch());
    return std::hypot(away.east, away.north, window_->viewpoint().pose.height - from.pose.height);
  }
};

TEST_F(FlyWindowDetail, IsChosenByKeysWhileItFlies) {
  tap(Qt::Key_Plus);
  EXPECT_EQ(detail()->pixelError, 8.0);
  for (int turn = 0; turn < 6; ++turn) tap(Qt::Key_Minus);
  EXPECT_EQ(detail()->pixelError, 64.0);
  tap(Qt::Key_Minus);
  EXPECT_EQ(detail()->pixelError, 64.0) << "the table ends here";
  EXPECT_EQ(window_->lastSentence(), "3 km of land, at most 64 px off");
  fly(30);
  tap(Qt::Key_Period);
  EXPECT_EQ(detail()->distance, 4000.0);
  tap(Qt::Key_Comma);
  tap(Qt::Key_Comma);
  EXPECT_EQ(detail()->distance, 2000.0);
  const std::size_t coarse = flight_->engine().figures().triangles;
  for (int turn = 0; turn < 10; ++turn) tap(Qt::Key_Plus);
  flyUnseenUntil(
      [&] { return flight_->engine().figures().triangles > coarse; });  // it takes effect in flight
  EXPECT_EQ(detail()->lines, 200.0) << "the picture's own numbers stay";
}

TEST_F(FlyWindowDetail, IsChosenBySlidersThatShowWhatTheKeysChose) {
  EXPECT_FALSE(slider("distance").isVisible());
  tap(Qt::Key_F2);
  fly(3);
  ASSERT_TRUE(slider("distance").isVisible());
  EXPECT_EQ(says("distanceValue"), "3 km");
  EXPECT_EQ(says("pixelErrorValue"), "11 px");
  clickBeside(slider("distance"), true);
  EXPECT_EQ(detail()->distance, 4000.0);
  EXPECT_EQ(says("distanceValue"), "4 km");
  clickBeside(slider("pixelError"), false);
  EXPECT_EQ(detail()->pixelError, 8.0);
  tap(Qt::Key_Plus);
  EXPECT_EQ(says("pixelErrorValue"), "5.6 px");
  EXPECT_EQ(detail()->pixelError, 5.6);
  for (const char* name : {"distance", "pixelError"}) {
    slider(name).setValue(slider(name).maximum() + 100);
    slider(name).setValue(slider(name).minimum() - 100);
  }
  EXPECT_EQ(detail()->pixelError, 0.25) << "no end of a slider is refused";
  EXPECT_EQ(detail()->distance, 1000.0);
  EXPECT_EQ(slider("distance").focusPolicy(), Qt::NoFocus) << "the keys stay the flight's";
  fly(3);
  EXPECT_LT(detail()->lines, 200.0) << "the picture is lower by the sliders";
  tap(Qt::Key_F2);
  fly(3);
  EXPECT_FALSE(slider("distance").isVisible());
}

TEST_F(FlyWindowDetail, KeepsWhatWasChosenOnOtherLand) {
  const auto goOver = [this] {
    auto world = World::create(land(), *PluginRegistry::standard());
    auto engine =
        Engine::create(*world, {.view = {.detail = DetailSettings{.pixelError = 64.0, .distance = 1000.0}}});
    flight_->goOverTo(std::move(*engine));
  };
  const auto arrive = [this](int changes) { flyUnseenUntil([&] { return flight_->changes() == changes; }); };
  for (int turn = 0; turn < 4; ++turn) tap(Qt::Key_Minus);
  goOver();
  arrive(1);
  EXPECT_EQ(detail()->pixelError, 45.0);
  EXPECT_EQ(detail()->distance, 3000.0);
  goOver();
  tap(Qt::Key_Comma);
  arrive(2);
  EXPECT_EQ(detail()->pixelError, 45.0);
  EXPECT_EQ(detail()->distance, 2000.0) << "chosen while it was made";
}

TEST_F(FlyWindowKeys, SayThatLandOfOneLevelHasNoDetailToChoose) {
  for (const int key : {Qt::Key_Plus, Qt::Key_Minus, Qt::Key_Period, Qt::Key_Comma}) {
    tap(key);
    EXPECT_TRUE(window_->lastSentence().starts_with("the land is of one level")) << window_->lastSentence();
  }
  EXPECT_FALSE(detail());
  tap(Qt::Key_F2);
  fly(2);
  EXPECT_FALSE(window_->findChild<QSlider*>("distance")->isEnabled());
}

TEST_F(FlyWindowDetail, GoesThroughItsColoursAndWiresAndShowsItsGraph) {
  tap(Qt::Key_F3);
  fly(2);
  EXPECT_EQ(window_->landColours(), LandColours::levels);
  tap(Qt::Key_F6);
  fly(2);
  EXPECT_TRUE(window_->showsWires());
  tap(Qt::Key_F3);
  fly(2);
  EXPECT_EQ(window_->landColours(), LandColours::errors);
  tap(Qt::Key_F7);
  fly(2);
  EXPECT_TRUE(window_->showsGraph());
  for (const int key : {Qt::Key_F3, Qt::Key_F6, Qt::Key_F7}) tap(key);
  fly(2);
  EXPECT_EQ(window_->landColours(), LandColours::natural);
  EXPECT_FALSE(window_->showsWires());
  EXPECT_FALSE(window_->showsGraph());
}

TEST_F(FlyWindowDetail, StaysAsItIsWhileTheCameraFliesOffAlone) {
  tap(Qt::Key_F4);
  ASSERT_TRUE(window_->isFrozen());
  const auto isBusy = [this] {
    const EngineFigures figures = flight_->engine().figures();
    return figures.pending > 0 || figures.measuring;
  };
  fly(5);
  flyUnseenUntil([&] { return !isBusy(); });  // then it is made for the eye left behind
  const auto scene = flight_->engine().scene();
  const Viewpoint begin = window_->viewpoint();
  const Motion before = aircraft(0).motion();
  const double fieldOfView = detail()->fieldOfView;
  press(Qt::Key_S);
  press(Qt::Key_R);
  for (int turn = 0; turn < 2000 && farOff(begin) < 1500.0; ++turn) fly(1);
  release(Qt::Key_S);
  release(Qt::Key_R);
  QWheelEvent wheel(QPointF(50, 60), QPointF(50, 60), QPoint(), QPoint(0, 480), Qt::NoButton, Qt::NoModifier,
                    Qt::NoScrollPhase, false);
  QApplication::sendEvent(window_->focusProxy(), &wheel);
  fly(3);
  EXPECT_GT(farOff(begin), 1000.0);
  EXPECT_GT(window_->viewpoint().pose.height, begin.pose.height + 200.0);
  EXPECT_EQ(flight_->engine().scene(), scene) << "what is drawn was chosen for the eye left behind";
  EXPECT_EQ(aircraft(0).motion().position, before.position);
  EXPECT_EQ(aircraft(0).speed(), 60.0) << "nobody was steered";
  const Eye eye{begin.pose.position, begin.pose.height, lensPixels(200, begin.fieldOfView)};
  const World& world = flight_->engine().world();
  EXPECT_EQ(window_->pixelError().max, pixelError(world, *scene, eye, {before.position, before.height}).max)
      << "and errors are told as they are seen from there";
  EXPECT_GT(window_->pixelError().max, pixelError(world, *scene, eye).max)
      << "of vertices that move with the aircraft, 27 m before the camera";
  EXPECT_LT(window_->viewpoint().fieldOfView, begin.fieldOfView);
  EXPECT_EQ(detail()->fieldOfView, fieldOfView) << "nor does the zoom choose";
  tap(Qt::Key_Home);
  EXPECT_LT(farOff(begin), 1e-6);
  const std::size_t seenBy = flight_->active();
  tap(Qt::Key_Tab);
  EXPECT_EQ(flight_->active(), seenBy) << "whose eye is frozen";
  tap(Qt::Key_F4);
  EXPECT_FALSE(window_->isFrozen());
  fly(5);
  EXPECT_NE(aircraft(0).motion().position, before.position);
  EXPECT_LT(farOff(begin), 200.0) << "the camera is back with the aircraft";
}

TEST_F(FlyWindowDetail, IsFlownOverByTheAutopilotUntilAKeySteers) {
  tap(Qt::Key_Space);
  EXPECT_TRUE(aircraft(0).hasAutopilot());
  fly(5);
  EXPECT_TRUE(aircraft(0).hasAutopilot());
  tap(Qt::Key_Left);
  EXPECT_FALSE(aircraft(0).hasAutopilot());
}

/// Over land with a deformer, small and near enough to be there soon; its edits are kept in a folder.
class FlyWindowTools : public FlyWindowKeys {
 protected:
  void SetUp() override { begin(); }
  /// A program that starts again, over the same file.
  void begin() {
    window_.reset();
    flight_.reset();
    open(land(), {.view = {1, 4}}, QSize(320, 240));
  }
  void prepare(Flight& flight, std::shared_ptr<const World> world) override {
    flight.setEdits(std::make_unique<LandEdits>(
        std::move(world),
        [this, deformers = deformersOf(PluginRegistry::standard())](std::string_view id) {
          while (editsWait_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
          return deformers(id);
        },
        [this](const World&) -> Result<std::filesystem::path> { return file_; }));
  }
  void TearDown() override {
    editsWait_ = false;
    FlyWindowKeys::TearDown();
    flight_.reset();  // its edits ask whether they wait
  }
  static WorldDescription land() {
    return WorldDescription::fromJson(
               R"({ "layers": [ { "generator": "constant", "parameters": { "height": 30 } } ] })",
               "the test's")
        .value();
  }
  void waitUntil(const std::function<bool()>& isSo) {
    for (int turn = 0; turn < 20'000 && !isSo(); ++turn) fly(1);
    ASSERT_TRUE(isSo());
  }
  void waitUntilShown() {
    fly(2);  // what was pressed is asked for in the next frame
    waitUntil(
        [this] { return flight_->edits()->unfinished() == 0 && flight_->engine().figures().pending == 0; });
    fly(2);
  }
  std::size_t edits() { return flight_->edits()->edits(); }
  double heightAt(const Position& place) { return flight_->engine().drawnHeight(place).value_or(-1e9); }
  void pause() {
    tap(Qt::Key_P);
    fly(2);
  }
  void mouse(QEvent::Type type, QPoint place, Qt::MouseButton button) {
    QMouseEvent event(type, place, button, type == QEvent::MouseButtonPress ? button : Qt::NoButton,
                      Qt::NoModifier);
    QApplication::sendEvent(window_->focusProxy(), &event);
  }

  std::atomic<bool> editsWait_ = false;  // whoever applies them
  ScratchFolder folder_;
  std::filesystem::path file_ = folder_ / "land.edits";
};

TEST_F(FlyWindowTools, DigAheadWithAKeyHoweverShortItIsPressed) {
  pause();
  tap(Qt::Key_G);
  EXPECT_EQ(window_->lastSentence(), "no tool is in hand; T takes one");
  tap(Qt::Key_T);
  EXPECT_EQ(window_->lastSentence(), "dig, 40 m wide, 4 m deep");
  const std::optional<Position> aim = window_->aim();
  ASSERT_TRUE(aim);
  const Offset ahead = offset(aircraft(0).motion().position, *aim, 64.0);
  EXPECT_GT(ahead.north, 30.0) << "in front of the aircraft, where it is seen";
  EXPECT_FALSE(std::filesystem::exists(file_)) << "nothing was dug yet";
  tap(Qt::Key_G);
  waitUntilShown();
  fly(5);
  EXPECT_EQ(edits(), 1U);
  EXPECT_NEAR(heightAt(*aim), 26.0, 0.5);
  tap(Qt::Key_T);
  EXPECT_EQ(window_->lastSentence(), "heap, 40 m wide, 4 m high");
  tap(Qt::Key_B);
  tap(Qt::Key_M);
  EXPECT_EQ(window_->lastSentence(), "heap, 60 m wide, 6 m high");
  tap(Qt::Key_V);
  tap(Qt::Key_N);
  EXPECT_EQ(window_->lastSentence(), "heap, 40 m wide, 4 m high");
  tap(Qt::Key_G);
  waitUntilShown();
  EXPECT_NEAR(heightAt(*aim), 30.0, 1.5) << "filled in again, about: the hole's floor is hit farther off";
}

TEST_F(FlyWindowTools, DrawAFurrowWhileTheKeyIsHeldInFlight) {
  tap(Qt::Key_T);
  fly(2);
  press(Qt::Key_G);
  waitUntil([this] { return edits() > 4; });
  release(Qt::Key_G);
  fly(2);
  waitUntilShown();
  const std::size_t all = edits();
  fly(20);
  EXPECT_EQ(edits(), all) << "it is let go";
}

TEST_F(FlyWindowTools, DigWhereTheMouseIsWithItsRightButton) {
  pause();
  tap(Qt::Key_T);
  const QPoint low(60, 200);
  mouse(QEvent::MouseMove, low, Qt::NoButton);
  const std::optional<Position> aim = window_->aim();
  ASSERT_TRUE(aim);
  const Offset away = offset(aircraft(0).motion().position, *aim, 64.0);
  EXPECT_LT(away.east, -20.0) << "to the left of the middle";
  mouse(QEvent::MouseButtonPress, low, Qt::RightButton);
  mouse(QEvent::MouseButtonRelease, low, Qt::RightButton);
  waitUntilShown();
  EXPECT_NEAR(heightAt(*aim), 26.0, 0.5);
  const std::size_t before = edits();
  mouse(QEvent::MouseMove, QPoint(60, 5), Qt::NoButton);
  EXPECT_FALSE(window_->aim()) << "the sky";
  mouse(QEvent::MouseButtonPress, QPoint(60, 5), Qt::RightButton);
  fly(3);
  mouse(QEvent::MouseButtonRelease, QPoint(60, 5), Qt::RightButton);
  fly(3);
  EXPECT_EQ(edits(), before);
}

TEST_F(FlyWindowTools, UndoAndRedoAcrossRestarts) {
  pause();
  tap(Qt::Key_Z);
  EXPECT_EQ(window_->lastSentence(), "there is nothing to undo");
  tap(Qt::Key_T);
  const Position aim = window_->aim().value_or(Position{});
  tap(Qt::Key_G);
  waitUntilShown();
  ASSERT_NEAR(heightAt(aim), 26.0, 0.5);
  begin();
  EXPECT_EQ(edits(), 1U);
  EXPECT_NEAR(heightAt(aim), 26.0, 0.5) << "the hole is there before it flies";
  pause();
  tap(Qt::Key_Z);
  EXPECT_EQ(window_->lastSentence(), "undone");
  waitUntilShown();
  EXPECT_EQ(heightAt(aim), 30.0);
  EXPECT_EQ(edits(), 0U);
  begin();
  pause();
  EXPECT_EQ(heightAt(aim), 30.0);
  QKeyEvent redo(QEvent::KeyPress, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  QApplication::sendEvent(window_->focusProxy(), &redo);
  waitUntilShown();
  EXPECT_NEAR(heightAt(aim), 26.0, 0.5);
}

TEST_F(FlyWindowTools, StayInTheLandThatIsMadeAnew) {
  pause();
  tap(Qt::Key_T);
  const Position aim = window_->aim().value_or(Position{});
  tap(Qt::Key_G);
  waitUntilShown();
  auto world = World::create(land(), *PluginRegistry::standard()).value();
  editsWait_ = true;
  flight_->goOverTo(Engine::create(world, {.view = {1, 4}}).value(), world);
  fly(60);
  EXPECT_TRUE(flight_->isLeaving()) << "however soon the new land is there";
  editsWait_ = false;
  while (flight_->isLeaving()) {
    ASSERT_NEAR(heightAt(aim), 26.0, 0.5);
    fly(1);
  }
  EXPECT_NEAR(heightAt(aim), 26.0, 0.5) << "nobody sees the new land without its hole";
  tap(Qt::Key_G);
  waitUntilShown();
  EXPECT_NEAR(heightAt(aim), 22.0, 1.5) << "and it is dug on";
}

TEST_F(FlyWindowTools, StayInTheLandThatIsMadeAnewWhileTheFirstIsMade) {
  flight_->edits()->press(craterEdit({}, 64.0, 20.0, 4.0, 0.0, 0.0));
  waitUntilShown();
  ASSERT_NEAR(heightAt({}), 26.0, 0.5);
  window_.reset();
  flight_.reset();
  auto world = World::create(land(), *PluginRegistry::standard()).value();
  const EngineOptions options{.view = {1, 4}};
  flight_ = std::make_unique<Flight>(Engine::create(world, options).value(), AircraftStart{});
  prepare(*flight_, world);
  flight_->settle([&](std::size_t, std::size_t) {
    if (flight_->isLeaving()) return true;
    auto next = World::create(land(), *PluginRegistry::standard()).value();
    flight_->goOverTo(Engine::create(next, options).value(), next);
    return true;
  });
  ASSERT_TRUE(flight_->isLeaving());
  for (int turn = 0; turn < 100'000 && flight_->isLeaving(); ++turn) flight_->advance(0.001);
  EXPECT_EQ(flight_->changes(), 1);
  EXPECT_NEAR(heightAt({}), 26.0, 0.5);
}

TEST_F(FlyWindowTools, LeaveLandAloneThatIsNotSeenYet) {
  pause();
  tap(Qt::Key_T);
  const Position aim = window_->aim().value_or(Position{});
  tap(Qt::Key_G);
  waitUntilShown();
  const auto description = WorldDescription::fromJson(
      R"({ "layers": [ { "generator": "constant", "parameters": { "height": 20 } } ] })", "the test's");
  auto other = World::create(*description, *PluginRegistry::standard()).value();
  file_ = folder_ / "other.edits";
  flight_->goOverTo(Engine::create(other, {.view = {1, 4}}).value(), other);
  QKeyEvent redo(QEvent::KeyPress, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  const auto sentenceAfter = [this](const std::function<void()>& ask) {
    ask();
    return window_->lastSentence();
  };
  const std::string refusal = "another land is being made; it can be dug once it is there";
  EXPECT_EQ(sentenceAfter([this] { tap(Qt::Key_Z); }), refusal);
  EXPECT_EQ(sentenceAfter([&] { QApplication::sendEvent(window_->focusProxy(), &redo); }), refusal);
  EXPECT_EQ(sentenceAfter([this] { press(Qt::Key_G); }), refusal);
  while (flight_->isLeaving()) {
    ASSERT_EQ(edits() + flight_->edits()->unfinished(), 0U);
    ASSERT_NEAR(heightAt(aim), 26.0, 0.5);
    fly(1);
  }
  fly(2);
  release(Qt::Key_G);
  waitUntilShown();
  EXPECT_GT(edits(), 0U) << "the key was still held there";
}

TEST_F(FlyWindowTools, ForgetAPressOnceNoneIsInHand) {
  pause();
  tap(Qt::Key_T);
  tap(Qt::Key_G);
  for (int turn = 0; turn < 7; ++turn) tap(Qt::Key_T);
  ASSERT_FALSE(window_->tools().inHand());
  fly(2);
  tap(Qt::Key_T);
  fly(2);
  EXPECT_EQ(edits() + flight_->edits()->unfinished(), 0U) << "nobody has pressed this one";
}

TEST_F(FlyWindowTools, BeginAnewWhereTheMouseComesBackFromTheSky) {
  pause();
  tap(Qt::Key_T);
  const QPoint left(100, 200), right(220, 200), sky(160, 5);
  mouse(QEvent::MouseMove, left, Qt::NoButton);
  mouse(QEvent::MouseButtonPress, left, Qt::RightButton);
  fly(2);
  mouse(QEvent::MouseMove, sky, Qt::NoButton);
  fly(2);
  mouse(QEvent::MouseMove, right, Qt::NoButton);
  fly(2);
  mouse(QEvent::MouseButtonRelease, right, Qt::RightButton);
  waitUntilShown();
  EXPECT_EQ(edits(), 2U) << "nothing between";
}

TEST_F(FlyWindowTools, AreTakenBackByWholeStrokes) {
  tap(Qt::Key_T);
  fly(2);
  press(Qt::Key_G);
  waitUntil([this] { return edits() > 3; });
  release(Qt::Key_G);
  fly(2);
  pause();
  waitUntilShown();
  tap(Qt::Key_G);
  waitUntilShown();
  const std::size_t all = edits();
  tap(Qt::Key_Z);
  waitUntilShown();
  EXPECT_EQ(edits(), all - 1);
  tap(Qt::Key_Z);
  waitUntilShown();
  EXPECT_EQ(edits(), 0U);
  tap(Qt::Key_Y);
  waitUntilShown();
  EXPECT_EQ(edits(), all - 1);
}

TEST_F(FlyWindowTools, SayTheirSizeAsTheGroundAllowsAtOnce) {
  window_.reset();
  flight_.reset();
  open(WorldDescription::fromJson(R"({ "pitch": 16, "layers": [ { "generator": "constant" } ] })",
                                  "the test's")
           .value(),
       {.view = {1, 4}}, QSize(320, 240));
  for (int turn = 0; turn < 6; ++turn) tap(Qt::Key_T);
  EXPECT_EQ(window_->lastSentence(), "shovel, 16 m wide, 2 m deep") << "before it was ever aimed";
}

TEST_F(FlyWindowTools, AreThrownUpToByAHeapThatGrowsUnderAnAircraft) {
  pause();
  const Position place = aircraft(0).motion().position;
  flight_->edits()->press(craterEdit(place, 64.0, 200.0, -190.0, 0.0, 0.0));
  waitUntilShown();
  EXPECT_GT(aircraft(0).motion().height, 200.0) << "however long the heap took";
  pause();
  for (int turn = 0; turn < 100; ++turn) {
    fly(1);
    const auto ground = flight_->engine().ground().height(aircraft(0).motion().position);
    if (ground) {
      ASSERT_GE(aircraft(0).motion().height, *ground);
    }
  }
}

TEST_F(FlyWindowTools, SayOnceThatAnotherProgramHasTheFileAndDigInMemory) {
  pause();
  tap(Qt::Key_T);
  tap(Qt::Key_G);
  waitUntilShown();
  LandEdits other(World::create(land(), *PluginRegistry::standard()).value(),
                  deformersOf(PluginRegistry::standard()),
                  [this](const World&) -> Result<std::filesystem::path> { return file_; });
  other.press(craterEdit({}, 64.0, 20.0, 4.0, 0.0, 0.0));
  while (other.unfinished() > 0) {
    other.handTo(flight_->engine());
  }
  const std::vector<std::string> messages = other.takeMessages();
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_NE(messages[0].find("memory"), std::string::npos) << messages[0];
  EXPECT_EQ(other.takeMessages().size(), 0U);
}

TEST_F(FlyWindowTools, SayOnceThatAFileCannotBeWrittenAndDigInMemory) {
  file_ = "/proc/no-such-folder/land.edits";
  begin();
  pause();
  tap(Qt::Key_T);
  const Position aim = window_->aim().value_or(Position{});
  tap(Qt::Key_G);
  waitUntilShown();
  EXPECT_NEAR(heightAt(aim), 26.0, 0.5);
  waitUntil([this] { return window_->lastSentence().find("in memory") != std::string::npos; });
  tap(Qt::Key_Z);
  waitUntilShown();
  EXPECT_EQ(heightAt(aim), 30.0);
}

TEST_F(FlyWindowKeys, SayThatNobodyKeepsEditsWhereNobodyDoes) {
  tap(Qt::Key_T);
  EXPECT_EQ(window_->lastSentence(), "nobody keeps edits of this land");
  EXPECT_FALSE(window_->tools().inHand());
}

TEST_F(FlyWindowKeys, SteerTheActiveAircraftWhileTheyAreDown) {
  press(Qt::Key_Up);
  fly(5);
  const double faster = aircraft(0).speed();
  EXPECT_GT(faster, 60.0);
  release(Qt::Key_Up);
  fly(5);
  EXPECT_EQ(aircraft(0).speed(), faster);
  EXPECT_TRUE(aircraft(1).followsScript());
}

TEST_F(FlyWindowKeys, ReachTheOtherAircraftAfterTabAndLetGoOfTheFirst) {
  press(Qt::Key_Up);
  press(Qt::Key_Tab);
  EXPECT_EQ(flight_->active(), 1U);
  const double before = aircraft(0).speed();
  press(Qt::Key_S);
  fly(5);
  EXPECT_EQ(aircraft(0).speed(), before);
  EXPECT_LT(aircraft(1).speed(), 60.0 + Flight::kFaster);
  EXPECT_FALSE(aircraft(1).followsScript());
  press(Qt::Key_Tab);
  EXPECT_EQ(flight_->active(), 0U);
}

TEST_F(FlyWindowKeys, AreLetGoWithTheKeyboard) {
  press(Qt::Key_Up);
  fly(3);
  QFocusEvent away(QEvent::FocusOut);
  QApplication::sendEvent(window_->focusProxy(), &away);
  const double speed = aircraft(0).speed();
  fly(5);
  EXPECT_EQ(aircraft(0).speed(), speed);
}

TEST_F(FlyWindowKeys, OfTheProgramDoNotReachTheAircraft) {
  press(Qt::Key_P);
  fly(2);
  const Position place = aircraft(0).motion().position;
  fly(3);
  EXPECT_EQ(aircraft(0).motion().position, place) << "paused";
  press(Qt::Key_P);
  send(QEvent::KeyPress, Qt::Key_P, true);
  fly(3);
  EXPECT_NE(aircraft(0).motion().position, place) << "a repeated key is no second press";
}

}  // namespace
}  // namespace teren
