// The window of the demo under keys as the window system sends them.
#include "apps/fly/FlyWindow.h"

#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include <QApplication>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QSlider>
#include <QWheelEvent>
#include <gtest/gtest.h>

#include "teren/PluginRegistry.h"

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
    window_ = std::make_unique<FlyWindow>(*flight_, Daylight{}, size,
                                          [] { return Error{"this test flies over one land"}; });
    ASSERT_TRUE(window_->settle());
    window_->fly(std::nullopt);
  }
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
  fly(60);
  EXPECT_GT(flight_->engine().figures().triangles, coarse) << "it takes effect in flight";
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
  const auto arrive = [this](int changes) {
    for (int turn = 0; turn < 600 && flight_->changes() < changes; ++turn) fly(1);
    ASSERT_EQ(flight_->changes(), changes);
  };
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
  for (int turn = 0; turn < 5000 && (turn < 5 || isBusy()); ++turn) fly(1);
  ASSERT_FALSE(isBusy()) << "it is made for the eye left behind";
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
  EXPECT_EQ(window_->pixelError().max, pixelError(flight_->engine().world(), *scene, eye).max)
      << "and errors are told as they are seen from there";
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
