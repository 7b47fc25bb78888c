// Runs teren-embed inside this process and does to its window what a person, or a larger program, might do.
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <string>

#include <QApplication>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QSpinBox>
#include <QTest>
#include <QTimer>
#include <QVBoxLayout>
#include <gtest/gtest.h>

#include "qt/ParameterPanel.h"
#include "qt/TerrainWidget.h"
#include "tests/qt/Sight.h"
#include "tests/support/PrivateDisplay.h"

/// The program's main, under another name.
int embedMain(int count, char** arguments);

/// Read by the address sanitizer: the program ends its QApplication, which unloads the GL driver before leaks
/// are looked for, so the driver's own could not be told by name.
extern "C" __attribute__((visibility("default"))) const char* __asan_default_options() {
  return "detect_leaks=0";
}

namespace teren {
namespace {

std::function<void()> visit;

/// Called by every QApplication that is made.
void startVisit() {
  QTimer::singleShot(0, qApp, [] {
    visit();
    QApplication::quit();
  });
}

/// Runs the program with a visitor, who comes when its window is there; on a display of its own, or on none.
void runProgram(std::function<void()> visitor, bool onDisplay = true) {
  const auto display = onDisplay ? std::make_unique<PrivateDisplay>() : nullptr;
  if (display) {
    ASSERT_FALSE(display->name().empty()) << "Xvfb did not start";
    setenv("DISPLAY", display->name().c_str(), 1);
  } else {
    unsetenv("DISPLAY");
  }
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  setenv("QT_QPA_PLATFORM", onDisplay ? "xcb" : "offscreen", 1);
  visit = std::move(visitor);
  char name[] = "teren-embed";
  char* arguments[] = {name, nullptr};
  EXPECT_EQ(embedMain(1, arguments), 0);
}

/// The program's window and what is in it.
struct Window {
  Window() {
    for (QWidget* widget : QApplication::topLevelWidgets()) {
      if (widget->windowTitle() == QStringLiteral("Teren")) window = widget;
    }
    land = window->findChild<TerrainWidget*>();
    seed = window->findChild<QSpinBox*>();
    label = window->findChild<QLabel*>(QString(), Qt::FindDirectChildrenOnly);  // the panel has some too
  }
  QWidget* window = nullptr;
  TerrainWidget* land = nullptr;
  QSpinBox* seed = nullptr;
  QLabel* label = nullptr;
};

Q_COREAPP_STARTUP_FUNCTION(startVisit)

TEST(Embed, IsAProgramOfLessThanFiftyLines) {
  std::ifstream source(TEREN_EMBED_SOURCE);
  int lines = 0;
  for (std::string line; std::getline(source, line);) lines += line.empty() ? 0 : 1;
  EXPECT_GT(lines, 10);
  EXPECT_LT(lines, 50);
}

TEST(Embed, ShowsTheLandOfTheSeedAndTheHeightUnderTheCursor) {
  runProgram([] {
    const Window program;
    ASSERT_TRUE(comesToRest(*program.land));
    const QImage first = screenOf(*program.land);
    EXPECT_GT(landShare(first), 0.3);
    if (const char* file = std::getenv("TEREN_EMBED_PICTURE")) screenOf(*program.window).save(QString(file));

    const QPoint below(program.land->width() / 3, program.land->height() - 10);
    QTest::mouseMove(&canvasOf(*program.land), below);
    ASSERT_TRUE(QTest::qWaitFor([&] { return program.label->text().endsWith(QStringLiteral(" m")); }));
    const double shown = program.label->text().chopped(2).toDouble();
    const auto ground = program.land->pick(below);
    ASSERT_TRUE(ground.has_value());
    EXPECT_NEAR(shown, ground->height, 0.05);
    EXPECT_NEAR(shown, program.land->world()->height(ground->position), 20.0) << "drawn at level 2";

    QTest::mouseMove(&canvasOf(*program.land), QPoint(program.land->width() - 20, 5));
    EXPECT_TRUE(QTest::qWaitFor([&] { return program.label->text() == QStringLiteral("sky"); }));

    program.seed->setValue(3);
    EXPECT_EQ(program.land->world()->seed(), 3U);
    ASSERT_TRUE(comesToRest(*program.land));
    EXPECT_GT(difference(screenOf(*program.land), first), 0.3);
  });
}

TEST(Embed, ChangesTheLandWithItsParameters) {
  runProgram([] {
    const Window program;
    ASSERT_TRUE(comesToRest(*program.land));
    const QImage first = screenOf(*program.land);
    auto* panel = program.window->findChild<ParameterPanel*>();
    ASSERT_NE(panel, nullptr);
    auto* deviation = panel->findChild<QDoubleSpinBox*>(QStringLiteral("deviation"));
    ASSERT_NE(deviation, nullptr);
    const double before = program.land->world()->deviation();
    deviation->setValue(2.0 * deviation->value());
    EXPECT_GT(program.land->world()->deviation(), 1.5 * before);
    ASSERT_TRUE(comesToRest(*program.land));
    EXPECT_GT(difference(screenOf(*program.land), first), 0.3);
  });
}

TEST(Embed, GoesOnWhenItsLandIsMovedHiddenDeletedAndMadeAgain) {
  runProgram([] {
    const Window program;
    ASSERT_TRUE(comesToRest(*program.land));
    const QSize size = program.land->size();
    const QImage first = screenOf(*program.land);

    QWidget other;
    auto* layout = new QVBoxLayout(&other);
    layout->addWidget(program.land);
    program.land->setFixedSize(size);
    other.move(600, 200);
    other.show();
    ASSERT_TRUE(comesToRest(*program.land));
    EXPECT_LT(difference(screenOf(*program.land), first), 0.01) << "in another window";

    program.land->hide();
    program.seed->setValue(3);  // still bound to it
    timerEvents(200);
    EXPECT_EQ(timerEvents(300), 0) << "while it is hidden";
    program.land->show();
    ASSERT_TRUE(comesToRest(*program.land));
    EXPECT_GT(difference(screenOf(*program.land), first), 0.3) << "the other seed";

    delete program.land;
    other.hide();
    program.seed->setValue(5);
    auto* again = new TerrainWidget;
    static_cast<QBoxLayout*>(program.window->layout())->insertWidget(0, again, 1);
    again->setFixedSize(size);
    WorldDescription world = WorldDescription::standard();
    world.seed = 42;
    ASSERT_TRUE(again->setWorld(world).ok());
    ASSERT_TRUE(comesToRest(*again));
    EXPECT_LT(difference(screenOf(*again), first), 0.01) << "made again in the program's window";
  });
}

TEST(Embed, SaysSoWhereThereIsNoOpenGL) {
  runProgram(
      [] {
        const Window program;
        const std::string said = program.label->text().toStdString();
        EXPECT_NE(said.find("OpenGL"), std::string::npos) << said;
        EXPECT_TRUE(comesToRest(*program.land));
      },
      false);
}

}  // namespace
}  // namespace teren
