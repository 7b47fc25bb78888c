// The window of the sandbox under keys and a mouse as the window system sends them.
#include "apps/sandbox/SandWindow.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <unistd.h>

#include <QApplication>
#include <QCheckBox>
#include <QColor>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPushButton>
#include <QTimer>
#include <QWheelEvent>
#include <gtest/gtest.h>

namespace teren {
namespace {

namespace fs = std::filesystem;

class SandWindowEvents : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    SandGround ground;
    ground.vertices = 1'500;
    session_ = std::make_unique<SandSession>(ground);
    window_ = std::make_unique<SandWindow>(*session_, QSize(800, 500), false);
    window_->begin(nullptr, std::nullopt);
    ASSERT_TRUE(settle());
    begin_ = hash();
  }
  void TearDown() override {
    window_.reset();
    QApplication::processEvents();
    fs::remove_all(folder_);
  }

  /// Until nothing is left to do and to show.
  bool settle() {
    return until([this] { return window_->settled() && window_->frameTimes().count() >= 4; });
  }
  bool until(const std::function<bool()>& there) {
    for (int n = 0; n < 200'000; ++n) {
      QApplication::processEvents(QEventLoop::AllEvents);
      if (there()) return true;
    }
    return false;
  }

  /// Lets the window tick so often without anything to do, and a little longer.
  static void idle(int ticks) {
    QTimer timer;
    timer.callOnTimeout([&ticks] { --ticks; });
    timer.start(20);
    while (ticks > 0) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
  }

  QWidget& canvas() { return *window_->focusProxy(); }
  void mouse(QEvent::Type type, QPoint at, Qt::MouseButton button,
             Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    const Qt::MouseButtons down = type == QEvent::MouseButtonRelease ? Qt::MouseButtons() : button;
    QMouseEvent event(type, at, type == QEvent::MouseMove ? Qt::NoButton : button, down, modifiers);
    QApplication::sendEvent(&canvas(), &event);
  }
  /// From a place of the level sand to another, in so many moves.
  void drag(QPoint from, QPoint to, Qt::MouseButton button = Qt::LeftButton,
            Qt::KeyboardModifiers modifiers = Qt::NoModifier, int moves = 8) {
    mouse(QEvent::MouseButtonPress, from, button, modifiers);
    for (int n = 1; n <= moves; ++n) {
      mouse(QEvent::MouseMove, from + (to - from) * n / moves, button, modifiers);
      QApplication::processEvents();
    }
    mouse(QEvent::MouseButtonRelease, to, button, modifiers);
  }
  QPoint seen(double x, double y) const { return window_->seenAt(x, y, 0.0); }
  void digAlongTheMiddle() {
    drag(seen(0.3, 0.5), seen(0.7, 0.5));
    EXPECT_TRUE(settle());
  }

  void key(int key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    QKeyEvent event(QEvent::KeyPress, key, modifiers);
    QApplication::sendEvent(&canvas(), &event);
  }
  void wheel(int turned) {
    QWheelEvent event(QPointF(100, 100), QPointF(100, 100), {}, {0, turned}, Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&canvas(), &event);
  }
  void click(const char* button) { window_->panel().findChild<QPushButton*>(button)->click(); }
  std::uint64_t hash() const { return hashOf(session_->sandbox().surface()); }
  double ground(double x, double y) const { return session_->groundHeight(x, y); }

  /// There is none until the display has shown the window, which may take its time.
  QImage picture() {
    const std::string file = (folder_ / "picture.png").string();
    EXPECT_TRUE(settle());
    bool taken = false;
    for (int n = 0; n < 1'000 && !taken; ++n) {
      QApplication::processEvents();
      taken = window_->screenshot(file).ok();
    }
    EXPECT_TRUE(taken);
    return QImage(QString::fromStdString(file));
  }
  static int count(const QImage& picture, const std::function<bool(const QColor&)>& wanted) {
    int found = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) found += wanted(QColor(picture.pixel(x, y))) ? 1 : 0;
    }
    return found;
  }
  static bool isRed(const QColor& c) { return c.red() > 130 && c.green() < 60 && c.blue() < 60; }
  static bool isSand(const QColor& c) { return c.red() > c.blue() + 30; }

  const fs::path folder_ = fs::temp_directory_path() / ("teren-sand-window-" + std::to_string(getpid()));
  std::unique_ptr<SandSession> session_;
  std::unique_ptr<SandWindow> window_;
  std::uint64_t begin_ = 0;
};

TEST_F(SandWindowEvents, OfTheLeftButtonDigAGrooveUnderTheMouse) {
  digAlongTheMiddle();
  for (const double x : {0.3, 0.4, 0.5, 0.6, 0.7}) EXPECT_LT(ground(x, 0.5), -0.008) << x;
  EXPECT_EQ(ground(0.5, 0.8), 0.0);
  EXPECT_EQ(ground(0.1, 0.5), 0.0);
  EXPECT_GT(ground(0.5, 0.56), 0.0) << "heaped up beside";
  EXPECT_TRUE(session_->sandbox().surface().validate());
}

TEST_F(SandWindowEvents, ReachThePanelBesideTheSandWhateverTheWindowsSize) {
  for (const QSize size : {QSize(800, 500), QSize(1200, 900), QSize(400, 300)}) {
    window_->resize(size);
    EXPECT_TRUE(settle());
    EXPECT_EQ(window_->size(), size);
    const QRect sand(canvas().mapTo(window_.get(), QPoint(0, 0)), canvas().size());
    const QRect panel(window_->panel().mapTo(window_.get(), QPoint(0, 0)),
                      QSize(window_->panel().width(), 100));
    EXPECT_FALSE(sand.intersects(panel));
    EXPECT_GT(sand.width(), size.width() / 4);
    EXPECT_GT(sand.height(), size.height() / 2);
  }
}

TEST_F(SandWindowEvents, BesideTheSandAndBeyondItsBorderHarmNothing) {
  drag({3, 3}, seen(0.5, 0.5));
  EXPECT_TRUE(settle());
  EXPECT_EQ(hash(), begin_) << "pressed down beside the sand";
  drag(seen(0.9, 0.5), {795, 3});
  EXPECT_TRUE(settle());
  EXPECT_NE(hash(), begin_) << "dragged over the border, the tool digs to it";
  EXPECT_TRUE(session_->sandbox().surface().validate());
  mouse(QEvent::MouseMove, seen(0.5, 0.5), Qt::NoButton);
  mouse(QEvent::MouseButtonRelease, seen(0.5, 0.5), Qt::LeftButton);
  QEvent away(QEvent::Leave);
  QApplication::sendEvent(&canvas(), &away);
  EXPECT_TRUE(settle());
}

TEST_F(SandWindowEvents, OfUndoAndRedoLeadBackAndForth) {
  digAlongTheMiddle();
  const std::uint64_t dug = hash();
  key(Qt::Key_Z);
  EXPECT_TRUE(settle());
  EXPECT_EQ(hash(), begin_);
  key(Qt::Key_Y, Qt::ControlModifier);
  EXPECT_TRUE(settle());
  EXPECT_EQ(hash(), dug);
  click("undo");
  EXPECT_TRUE(settle());
  EXPECT_EQ(hash(), begin_);
  click("redo");
  EXPECT_TRUE(settle());
  EXPECT_EQ(hash(), dug);
  key(Qt::Key_Y);
  EXPECT_EQ(window_->panel().sentence(), "there is nothing to do again");
}

TEST_F(SandWindowEvents, OfWShowTheEdgesAndConstrainedOnesRed) {
  EXPECT_GT(count(picture(), isSand), 20'000);
  digAlongTheMiddle();
  mouse(QEvent::MouseMove, {3, 3}, Qt::NoButton);  // no outline of the tool in the picture
  EXPECT_EQ(count(picture(), isRed), 0);
  key(Qt::Key_W);
  EXPECT_GT(count(picture(), isRed), 300);
  key(Qt::Key_W);
  EXPECT_EQ(count(picture(), isRed), 0);
}

TEST_F(SandWindowEvents, ShowTheGrooveThatWasDug) {
  mouse(QEvent::MouseMove, {3, 3}, Qt::NoButton);
  const QImage before = picture();
  digAlongTheMiddle();
  mouse(QEvent::MouseMove, {3, 3}, Qt::NoButton);
  const QImage after = picture();
  ASSERT_EQ(before.size(), after.size());
  int changed = 0;
  for (int y = 0; y < after.height(); ++y) {
    for (int x = 0; x < after.width(); ++x) {
      const QColor one(before.pixel(x, y)), other(after.pixel(x, y));
      changed += std::abs(one.lightness() - other.lightness()) > 25 ? 1 : 0;
    }
  }
  EXPECT_GT(changed, 500);
  key(Qt::Key_Z);
  EXPECT_EQ(picture(), before) << "undone";
}

TEST_F(SandWindowEvents, ShowWhereTheToolWouldCut) {
  mouse(QEvent::MouseMove, {3, 3}, Qt::NoButton);
  const QImage without = picture();
  mouse(QEvent::MouseMove, seen(0.5, 0.5), Qt::NoButton);
  const QImage with = picture();
  EXPECT_NE(without, with);
  QEvent away(QEvent::Leave);
  QApplication::sendEvent(&canvas(), &away);
  EXPECT_EQ(picture(), without);
}

TEST_F(SandWindowEvents, OfTheOtherButtonsAndTheWheelMoveTheView) {
  struct Gesture {
    Qt::MouseButton button;
    Qt::KeyboardModifiers modifiers;
  };
  for (const Gesture& gesture :
       {Gesture{Qt::RightButton, {}}, Gesture{Qt::MiddleButton, {}},
        Gesture{Qt::LeftButton, Qt::ShiftModifier}, Gesture{Qt::LeftButton, Qt::ControlModifier}}) {
    const QPoint corner = seen(0.0, 0.0);
    drag(seen(0.5, 0.5), seen(0.5, 0.5) + QPoint(60, 25), gesture.button, gesture.modifiers);
    EXPECT_NE(seen(0.0, 0.0), corner);
    key(Qt::Key_Home);
    EXPECT_EQ(seen(0.0, 0.0), corner);
  }
  const int before = (seen(0.0, 0.0) - seen(1.0, 1.0)).manhattanLength();
  wheel(120);
  EXPECT_GT((seen(0.0, 0.0) - seen(1.0, 1.0)).manhattanLength(), before);
  EXPECT_EQ(hash(), begin_);
}

TEST_F(SandWindowEvents, MoveTheSandWithTheMouse) {
  const QPoint middle = seen(0.5, 0.5);
  drag(middle, middle + QPoint(50, 0), Qt::MiddleButton);
  EXPECT_NEAR(seen(0.5, 0.5).x(), middle.x() + 50, 3);
  EXPECT_NEAR(seen(0.5, 0.5).y(), middle.y(), 3);
}

TEST_F(SandWindowEvents, OfKeysChangeTheTool) {
  const double size = session_->toolValues().real("size"), depth = session_->toolValues().real("depth");
  key(Qt::Key_Plus, Qt::ShiftModifier);
  EXPECT_DOUBLE_EQ(session_->toolValues().real("size"), 1.25 * size);
  key(Qt::Key_Minus);
  key(Qt::Key_PageDown);
  EXPECT_DOUBLE_EQ(session_->toolValues().real("depth"), 1.25 * depth);
  key(Qt::Key_PageUp);
  key(Qt::Key_T);
  EXPECT_EQ(session_->toolValues().choice("tool"), "square");
  key(Qt::Key_S);
  EXPECT_FALSE(session_->slides());
  key(Qt::Key_S);
  EXPECT_TRUE(session_->slides());
}

TEST_F(SandWindowEvents, OfThePanelReachTheSand) {
  QWidget& panel = window_->panel();
  panel.findChild<QComboBox*>("tool")->setCurrentText("rake");
  EXPECT_EQ(session_->toolValues().choice("tool"), "rake");
  panel.findChild<QDoubleSpinBox*>("repose")->setValue(25.0);
  panel.findChild<QDoubleSpinBox*>("moisture")->setValue(0.5);
  EXPECT_EQ(session_->repose(), 25.0);
  EXPECT_EQ(session_->moisture(), 0.5);
  panel.findChild<QCheckBox*>("slides")->click();
  EXPECT_FALSE(session_->slides());
  panel.findChild<QCheckBox*>("wireframe")->click();
  EXPECT_GT(count(picture(), [](const QColor& c) { return c.lightness() < 70; }), 1'000);
}

TEST_F(SandWindowEvents, OfThePanelThatMakeNoToolAreSaidAndPutBack) {
  QWidget& panel = *window_->panel().findChild<QWidget*>("toolForm");
  panel.findChild<QComboBox*>("tool")->setCurrentText("ball");
  const double depth = session_->toolValues().real("depth");
  panel.findChild<QDoubleSpinBox*>("depth")->setValue(0.5);
  EXPECT_EQ(session_->toolValues().real("depth"), depth);
  EXPECT_EQ(panel.findChild<QDoubleSpinBox*>("depth")->value(), depth);
  EXPECT_NE(window_->panel().sentence().find("ball"), std::string::npos);
}

TEST_F(SandWindowEvents, DoNotReachASandThatAScriptPlaysIn) {
  const Result<SandScript> script = SandScript::fromText("wireframe off\nbeats 1\n", "test.txt");
  ASSERT_TRUE(script);
  const QImage before = picture();
  const QPoint corner = seen(0.0, 0.0);
  window_->begin(&*script, std::nullopt);
  drag(seen(0.5, 0.5), seen(0.5, 0.5) + QPoint(60, 25), Qt::RightButton, {}, 0);
  mouse(QEvent::MouseButtonPress, seen(0.3, 0.5), Qt::RightButton);
  mouse(QEvent::MouseMove, seen(0.7, 0.5), Qt::RightButton);
  wheel(120);
  EXPECT_EQ(seen(0.0, 0.0), corner);
  key(Qt::Key_W);
  key(Qt::Key_T);
  EXPECT_FALSE(window_->settled());
  mouse(QEvent::MouseButtonRelease, {3, 3}, Qt::RightButton);
  EXPECT_EQ(session_->toolValues().choice("tool"), "round");
  EXPECT_EQ(picture(), before);
  EXPECT_EQ(hash(), begin_);
  wheel(120);
  EXPECT_NE(seen(0.0, 0.0), corner) << "the script is over";
}

TEST_F(SandWindowEvents, OfAnotherButtonDoNotEndADrag) {
  mouse(QEvent::MouseButtonPress, seen(0.3, 0.5), Qt::LeftButton);
  mouse(QEvent::MouseMove, seen(0.5, 0.5), Qt::LeftButton);
  mouse(QEvent::MouseButtonPress, seen(0.5, 0.5), Qt::RightButton);
  mouse(QEvent::MouseButtonRelease, seen(0.5, 0.5), Qt::RightButton);
  mouse(QEvent::MouseMove, seen(0.7, 0.5), Qt::LeftButton);
  mouse(QEvent::MouseButtonRelease, seen(0.7, 0.5), Qt::LeftButton);
  EXPECT_TRUE(settle());
  EXPECT_LT(ground(0.7, 0.5), -0.008);
}

TEST_F(SandWindowEvents, OfEscapeInAFieldDoNotEndTheWindow) {
  QKeyEvent escape(QEvent::KeyPress, Qt::Key_Escape, Qt::NoModifier);
  QApplication::sendEvent(window_->panel().findChild<QDoubleSpinBox*>("repose"), &escape);
  idle(5);
  EXPECT_TRUE(window_->lastPicture().isNull());
  key(Qt::Key_Escape);
  EXPECT_TRUE(until([this] { return !window_->lastPicture().isNull(); }));
}

TEST_F(SandWindowEvents, LeaveNoOutlineOfTheToolOnNewSand) {
  mouse(QEvent::MouseMove, seen(0.5, 0.5), Qt::NoButton);
  click("make");
  const QImage made = picture();
  mouse(QEvent::MouseMove, {3, 3}, Qt::NoButton);
  EXPECT_EQ(picture(), made);
}

TEST_F(SandWindowEvents, MakeNewSand) {
  digAlongTheMiddle();
  QWidget* ground = window_->panel().findChild<QWidget*>("groundForm");
  ground->findChild<QDoubleSpinBox*>("size")->setValue(3.0);
  ground->findChild<QDoubleSpinBox*>("vertices")->setValue(900);
  click("make");
  EXPECT_FALSE(window_->settled());
  EXPECT_TRUE(settle());
  EXPECT_NEAR(session_->width(), 3.0, 1e-6);
  EXPECT_EQ(session_->figures().vertices, 900U);
  EXPECT_TRUE(canvas().rect().contains(seen(0.0, 0.0))) << "all is in view";
  EXPECT_TRUE(canvas().rect().contains(seen(3.0, 3.0)));
  const QImage untouched = picture();
  mouse(QEvent::MouseMove, seen(1.5, 1.5), Qt::NoButton);
  EXPECT_NE(picture(), untouched) << "the tool is shown on it";
  mouse(QEvent::MouseMove, {3, 3}, Qt::NoButton);
  EXPECT_EQ(picture(), untouched);
}

TEST_F(SandWindowEvents, MakeSandOfWhichAllIsInViewHoweverHighItIs) {
  session_->setSlides(false);
  QWidget* ground = window_->panel().findChild<QWidget*>("groundForm");
  ground->findChild<QDoubleSpinBox*>("roughness")->setValue(8.0);
  click("make");
  EXPECT_TRUE(settle());
  double high = 0.0;
  for (const double x : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    for (const double y : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const double height = session_->groundHeight(x, y);
      high = std::max(high, height);
      EXPECT_TRUE(canvas().rect().contains(window_->seenAt(x, y, height))) << x << " " << y << " " << height;
    }
  }
  EXPECT_GT(high, 3.0);
}

TEST_F(SandWindowEvents, AreAwaitedWithoutDrawing) {
  digAlongTheMiddle();
  mouse(QEvent::MouseMove, {3, 3}, Qt::NoButton);
  EXPECT_TRUE(settle());
  const std::size_t frames = window_->frameTimes().count();
  idle(50);
  EXPECT_EQ(window_->frameTimes().count(), frames);
}

TEST_F(SandWindowEvents, SaveNoSandThatIsOnItsWayElsewhere) {
  click("make");
  const std::string file = (folder_ / "old").string();
  window_->save(file);
  EXPECT_NE(window_->panel().sentence().find("still on its way"), std::string::npos);
  window_->exportTo(file);
  EXPECT_FALSE(fs::exists(file));
  EXPECT_TRUE(settle());
  window_->save(file);
  EXPECT_TRUE(fs::exists(file));
}

TEST_F(SandWindowEvents, BringNoOtherSandWhileTheFirstIsOnItsWay) {
  std::atomic<bool> told = false;
  window_.reset();
  SandGround first;
  first.vertices = 700;
  session_->bring([&told, first]() -> Result<Sandbox> {
    while (!told) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return makeSand(first);
  });
  window_ = std::make_unique<SandWindow>(*session_, QSize(800, 500), false);
  window_->begin(nullptr, std::nullopt);
  QApplication::processEvents();
  const auto refused = [this] {
    const bool said = window_->panel().sentence().find("still on its way") != std::string::npos;
    window_->panel().say("");
    return said;
  };
  click("make");
  EXPECT_TRUE(refused());
  window_->load((folder_ / "missing").string());
  EXPECT_TRUE(refused());
  window_->save((folder_ / "a.sand").string());
  EXPECT_TRUE(refused());
  told = true;
  EXPECT_TRUE(settle());
  EXPECT_FALSE(window_->error());
  EXPECT_EQ(session_->figures().vertices, 700U);
}

TEST_F(SandWindowEvents, SaveAndLoadTheSameSand) {
  digAlongTheMiddle();
  const std::uint64_t dug = hash();
  const std::string file = (folder_ / "a.sand").string();
  window_->save(file);
  key(Qt::Key_Z);
  EXPECT_EQ(hash(), begin_);
  window_->load(file);
  EXPECT_TRUE(settle());
  EXPECT_EQ(hash(), dug);
  window_->load((folder_ / "missing").string());
  EXPECT_TRUE(settle());
  EXPECT_NE(window_->panel().sentence().find("missing"), std::string::npos);
  EXPECT_EQ(hash(), dug);
  window_->exportTo((folder_ / "a.obj").string());
  EXPECT_GT(fs::file_size(folder_ / "a.obj"), 10'000U);
}

TEST_F(SandWindowEvents, EndTheWindowInTheMidstOfWork) {
  drag(seen(0.3, 0.5), seen(0.7, 0.5));
  EXPECT_FALSE(session_->idle());
  key(Qt::Key_Q);
  EXPECT_TRUE(until([this] { return !window_->lastPicture().isNull(); }));
  EXPECT_GT(count(window_->lastPicture(), isSand), 20'000);
}

}  // namespace
}  // namespace teren
