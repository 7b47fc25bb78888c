// The window of the demo under keys as the window system sends them.
#include "apps/fly/FlyWindow.h"

#include <chrono>
#include <memory>

#include <QApplication>
#include <QKeyEvent>
#include <gtest/gtest.h>

#include "teren/PluginRegistry.h"

namespace teren {
namespace {

class FlyWindowKeys : public testing::Test {
 protected:
  void SetUp() override {
    auto world = World::create(WorldDescription::standard(), *PluginRegistry::standard());
    ASSERT_TRUE(world.ok());
    auto engine = Engine::create(*world, {.view = {3, 1}});
    ASSERT_TRUE(engine.ok());
    flight_ = std::make_unique<Flight>(std::move(*engine), AircraftStart{.speed = 60.0});
    window_ = std::make_unique<FlyWindow>(*flight_, Daylight{}, QSize(160, 120),
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
  Aircraft& aircraft(std::size_t index) { return *flight_->aircraft()[index]; }

  std::unique_ptr<Flight> flight_;
  std::unique_ptr<FlyWindow> window_;
};

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
  EXPECT_GT(flight_->engine().figures().bytes, window_->bytes() / 2);
}

}  // namespace
}  // namespace teren
