// The window of the demo: keys and mouse in, one frame after another out.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <QImage>
#include <QPoint>
#include <QTimer>
#include <QWidget>

#include "teren/PixelError.h"

#include "apps/fly/CameraRig.h"
#include "apps/fly/Daylight.h"
#include "apps/fly/DetailPanel.h"
#include "apps/fly/Flight.h"
#include "apps/fly/FlyScene.h"
#include "apps/fly/FrameGraph.h"
#include "apps/fly/FreeCamera.h"
#include "apps/fly/HeadUpDisplay.h"
#include "apps/fly/KeyMap.h"
#include "apps/fly/LandColours.h"
#include "apps/fly/LandSource.h"
#include "apps/fly/ToolBelt.h"
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
  /// Of the land as it is seen now, its vertices moved with the active aircraft; while frozen, from where the
  /// camera was then.
  PixelError pixelError() const;
  /// Where the camera is.
  Viewpoint viewpoint() const;
  LandColours landColours() const noexcept { return colours_; }
  bool showsWires() const noexcept { return wires_; }
  bool showsGraph() const noexcept { return graphShown_; }
  /// Whether all but the camera stands still.
  bool isFrozen() const noexcept { return frozen_.has_value(); }
  const ToolBelt& tools() const noexcept { return tools_; }
  /// Where the tool in hand would press now: at the mouse where that moved last, else in front of the active
  /// object.
  std::optional<Position> aim() const;
  /// The last sentence it has shown the person.
  const std::string& lastSentence() const noexcept { return lastSentence_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  void tick();
  void present(bool last);
  void updateScene(double dt);
  /// From where errors are seen.
  Eye eye() const;
  void lookForColours();
  /// Tells the engine the size of the picture, which detail by error depends on.
  void fitDetail(double fieldOfView);
  void showFigures();
  void showLegend(const EngineFigures& figures);
  void showHelp();
  double wantedPixelError() const;
  bool isLastFrame(Clock::time_point now) const;
  bool keyEvent(const QKeyEvent& event);
  bool mouseEvent(const QEvent& event);
  void zoom(double steps);
  void act(Action action);
  void actOnLook(Action action);
  void actOnTools(Action action);
  bool canDig();
  /// Once a frame: shows where the tool points, and presses it while its key or button is held.
  void dig();
  /// To the ground that is seen.
  void fitTools();
  /// Or redoes.
  void undo(bool back);
  void takeTool();
  void sayTool();
  std::string toolText() const;
  void addToolLines(std::vector<DisplayLine>& lines);
  /// Changes what is drawn, by steps or to what a slider says.
  void chooseDetail(const std::function<void(DetailSettings&)>& change);
  void showColours();
  void toggleFreeze();
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
  DetailPanel* panel_;
  std::optional<QPoint> dragFrom_;
  ToolBelt tools_;
  std::optional<QPoint> mouse_;  // over the picture
  bool aimsByMouse_ = false, digsByMouse_ = false;
  bool digsOnce_ = false;  // pressed since the last frame, however short
  bool paused_ = false, leaving_ = false, pictureWanted_ = false;
  bool wires_ = false, graphShown_ = false;
  LandColours colours_ = LandColours::natural;
  Eye tintEye_;              // of the picture that is drawn
  DetailEye tintMovedWith_;  // likewise
  struct Frozen {
    Viewpoint eye;
    FreeCamera camera;
  };
  std::optional<Frozen> frozen_;
  std::optional<Clock::duration> duration_;
  Clock::time_point begin_{}, lastTick_{}, lastPresented_{}, lastFigures_{};
  int changes_ = 0;  // of the flight's engine, told so far
  std::string lastSentence_;
  FrameStatistics frameTimes_;
  FrameGraph graph_;
  QImage lastPicture_;
};

}  // namespace teren
