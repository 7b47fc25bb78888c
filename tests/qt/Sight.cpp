#include "tests/qt/Sight.h"

#include <cstdlib>

#include <QApplication>
#include <QElapsedTimer>
#include <QGLWidget>
#include <QPixmap>
#include <QScreen>
#include <QTest>
#include <QTimer>
#include <gtest/gtest.h>

#include "coin/SoTerrain.h"

namespace teren {
namespace {

class TimerEventCount : public QObject {
 public:
  int count = 0;
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::Timer) ++count;
    return QObject::eventFilter(watched, event);
  }
};

}  // namespace

void showSmallLand(TerrainWidget& land, std::uint64_t seed) {
  WorldDescription description = WorldDescription::standard();
  description.seed = seed;
  land.terrain().waterLevel = -1e6F;
  ASSERT_TRUE(land.setOptions({.view = {.level = 1, .radius = 3}}).ok());
  ASSERT_TRUE(land.setWorld(description).ok());
}

std::unique_ptr<TerrainWidget> landAtRest() {
  auto land = std::make_unique<TerrainWidget>();
  land->resize(kWidth, kHeight);
  land->show();
  showSmallLand(*land);
  EXPECT_TRUE(comesToRest(*land));
  return land;
}

bool isWorking(const TerrainWidget& land) {
  return land.findChild<QTimer*>(QString(), Qt::FindDirectChildrenOnly)->isActive();
}

bool comesToRest(const TerrainWidget& land) {
  QElapsedTimer time;
  for (time.start(); time.elapsed() < 60'000;) {
    QTest::qWait(5);
    if (!isWorking(land)) return true;
  }
  return false;
}

QImage screenOf(const QWidget& widget) {
  QTest::qWait(50);
  const QPoint corner = widget.mapToGlobal(QPoint(0, 0));
  return QGuiApplication::primaryScreen()
      ->grabWindow(0, corner.x(), corner.y(), widget.width(), widget.height())
      .toImage()
      .convertToFormat(QImage::Format_RGB32);
}

double landShare(const QImage& picture) {
  const QColor haze = QColor::fromRgbF(0.76, 0.84, 0.92);
  int land = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const QColor color = picture.pixelColor(x, y);
      const int off = std::abs(color.red() - haze.red()) + std::abs(color.green() - haze.green()) +
                      std::abs(color.blue() - haze.blue());
      if (off > 12 && color.lightness() > 8) ++land;
    }
  }
  return static_cast<double>(land) / (picture.width() * picture.height());
}

double difference(const QImage& one, const QImage& other) {
  if (one.size() != other.size()) return 1.0;
  int count = 0;
  for (int y = 0; y < one.height(); ++y) {
    for (int x = 0; x < one.width(); ++x) count += one.pixel(x, y) != other.pixel(x, y) ? 1 : 0;
  }
  return static_cast<double>(count) / (one.width() * one.height());
}

QWidget& canvasOf(const TerrainWidget& land) {
  return *land.findChild<QGLWidget*>();
}

int timerEvents(int milliseconds) {
  TimerEventCount counter;
  qApp->installEventFilter(&counter);
  // qWait has timers of its own.
  QElapsedTimer time;
  for (time.start(); time.elapsed() < milliseconds;) {
    QCoreApplication::processEvents(QEventLoop::AllEvents);
    QTest::qSleep(1);
  }
  return counter.count;
}

}  // namespace teren
