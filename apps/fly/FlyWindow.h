// The window of the demo: keys and mouse in, one frame after another out.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include <QImage>
#include <QPoint>
#include <QTimer>
#include <QWidget>

#include "teren/PixelError.h"

#include "apps/fly/CameraRig.h"
#include "apps/fly/Daylight.h"
#include "apps/fly/Flight.h"
#include "apps/fly/FlyScene.h"
#include "apps/fly/HeadUpDisplay.h"
#include "apps/fly/KeyMap.h"
#include "apps/fly/LandSource.h"
#include "apps/window/FrameStatistics.h"
#include "apps/window/RenderArea.h"

namespace teren {

/// Shows a flight and lets a person steer it. Make it after SoQt::init and SoTerrain::initClass and delete it
/// before SoQt::done.
class FlyWindow : public QWidget {
 public:
  using Clock = std::chrono::steady_clock;

  /// Makes the land anew for F5.
  using Remake = std::function<Result<NewLand>()>;

  FlyWindow(Flight& flight, const Daylight& light, QSize size, Remake remake);
  ~FlyWindow() override;

  /// Shows the window while the flight settles: the land as it grows, and how much of it is there. Returns
  /// false if the person closed it meanwhile.
  bool settle();

  /// Starts flying; leaves QApplication::exec() when the person quits or asks by a signal, or after
  /// `duration`. At least kFramesAtLeast frames are flown.
  void fly(std::optional<Clock::duration> duration);
  static constexpr std::size_t kFramesAtLeast = 3;

  /// After the flight: the last frame, head-up display included; null if nothing could be drawn.
  const QImage& lastPicture() const noexcept { return lastPicture_; }
  /// [ms] between the moments at which successive frames were presented.
  const FrameStatistics& frameTimes() const noexcept { return frameTimes_; }
  std::size_t bytes() const;  ///< the engine's, the graphics buffers included
  /// Of the land as it is seen now.
  PixelError pixelError() const;
  /// The last sentence it has shown the person.
  const std::string& lastSentence() const noexcept { return lastSentence_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  void tick();
  void updateScene(double dt);
  Viewpoint viewpoint() const;
  /// Tells the engine the size of the picture, which detail by error depends on.
  void fitDetail(double fieldOfView);
  void showFigures();
  void showHelp();
  bool isLastFrame(Clock::time_point now) const;
  bool keyEvent(const QKeyEvent& event);
  bool mouseEvent(const QEvent& event);
  void act(Action action);
  void togglePause();
  void reload();
  void tellMessages();
  void say(const std::string& sentence);
  void complain(const std::string& sentence);  // on standard error too
  void toggleFullScreen();
  void keepPicture(const QImage& picture);

  Flight& flight_;
  Daylight daylight_;
  FlyScene scene_;
  HeadUpDisplay display_;
  CameraRig rig_;
  HeldKeys keys_;
  Remake remake_;
  QTimer timer_;
  RenderArea* area_;  // owned; goes before its widgets
  std::optional<QPoint> dragFrom_;
  bool paused_ = false, leaving_ = false, pictureWanted_ = false;
  std::optional<Clock::duration> duration_;
  Clock::time_point begin_{}, lastTick_{}, lastPresented_{}, lastFigures_{};
  int changes_ = 0;  // of the flight's engine, told so far
  std::string lastSentence_;
  FrameStatistics frameTimes_;
  QImage lastPicture_;
};

}  // namespace teren
