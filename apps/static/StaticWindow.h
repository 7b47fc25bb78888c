// The window that shows nine patches, whole or taken apart.
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include <QImage>
#include <QTimer>
#include <QWidget>

#include "teren/Engine.h"

#include "apps/static/ExaminerView.h"
#include "apps/static/StaticScene.h"
#include "apps/window/FrameStatistics.h"

namespace teren {

/// How the window begins.
struct StaticLook {
  bool apart = false, wireframe = false;
};

/// Keys: E takes the pieces apart and puts them together, W draws them as wire or solid, Q and Escape quit;
/// all else is the examiner viewer's. Make it after SoQt::init and SoTerrain::initClass and delete it before
/// SoQt::done.
class StaticWindow : public QWidget {
 public:
  using Clock = std::chrono::steady_clock;

  /// `engine` draws the nine nodes around its one object and must outlive the window.
  StaticWindow(Engine& engine, QSize size, const StaticLook& look);
  ~StaticWindow() override;

  /// Shows the window and works until the nine patches are there. Returns false if the person closed it
  /// meanwhile.
  bool settle();

  /// After settle(): shows the pieces; leaves QApplication::exec() when the person quits or asks by a signal,
  /// or after `duration`.
  void begin(std::optional<Clock::duration> duration);

  /// Whether the pieces are on their way apart or together.
  bool moving() const noexcept { return way_ != (look_.apart ? 1.0 : 0.0); }

  /// Afterwards: the last frame; null if nothing could be drawn.
  const QImage& lastPicture() const noexcept { return lastPicture_; }
  const FrameStatistics& frameTimes() const noexcept { return view_->frameTimes(); }
  /// [us] of each of the engine's updates.
  const FrameStatistics& engineTimes() const noexcept { return engineTimes_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  bool keyPressed(int key);
  void tick();
  void finish();
  void placeCamera();
  void setWireframe(bool wireframe);

  Engine& engine_;
  StaticLook look_;
  ExaminerView* view_;  // owned; goes before its widgets
  std::unique_ptr<StaticScene> scene_;
  QTimer timer_;
  Clock::time_point lastTick_{}, end_ = Clock::time_point::max();
  double way_ = 0.0;  // gone between together (0) and apart (1)
  bool leaving_ = false, begun_ = false;
  FrameStatistics engineTimes_;
  QImage lastPicture_;
};

}  // namespace teren
