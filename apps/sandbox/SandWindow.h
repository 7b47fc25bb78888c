// The window of the sandbox: sand on the left, under the mouse, and the panel on the right.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include <QImage>
#include <QLabel>
#include <QPoint>
#include <QTimer>
#include <QWidget>

#include "apps/options/CommandLine.h"
#include "apps/sandbox/SandCamera.h"
#include "apps/sandbox/SandKeys.h"
#include "apps/sandbox/SandPanel.h"
#include "apps/sandbox/SandPlayer.h"
#include "apps/sandbox/SandScene.h"
#include "apps/sandbox/SandSession.h"
#include "apps/window/FrameStatistics.h"
#include "apps/window/RenderArea.h"

class QMouseEvent;
class SoPerspectiveCamera;
class SoSeparator;

namespace teren {

/// The left button drags the tool through the sand, at the height of the ground where it was pressed down;
/// the right one (or with Shift) turns the view, the middle one (or with Control) moves it, the wheel comes
/// nearer. Keys: SandKeys.h. While a script is played, only ending and a picture are obeyed. Work goes on in
/// slices between frames, so the window answers whatever slides.
///
/// Make it after SoQt::init and delete it before SoQt::done; the session must outlive it.
class SandWindow : public QWidget, public SandStage {
 public:
  using Clock = std::chrono::steady_clock;

  SandWindow(SandSession& session, QSize size, bool wireframe);
  ~SandWindow() override;

  /// Shows the window, plays the script (if any; it must outlive the window), and from then on obeys the
  /// person. Leaves QApplication::exec() when the person quits or asks by a signal, `duration` after the
  /// script's end, or when the sand to begin with does not come, or the script fails or says so. What
  /// commands print goes to standard output.
  void begin(const SandScript* script, std::optional<Clock::duration> duration);

  /// Why it ended by itself: the sand to begin with did not come, or the script failed; and with what the
  /// program should end then.
  const std::optional<Error>& error() const noexcept { return error_; }
  ExitCode failure() const noexcept { return failure_; }

  /// As the buttons do once a file is named; what fails is said in the panel and on standard error. While
  /// sand is on its way, none is saved or exported; while that to begin with is, none is loaded either.
  void save(const std::string& file);
  void load(const std::string& file);
  void exportTo(const std::string& file);

  void setWireframe(bool on) override;
  void setCamera(const Values& values) override;
  Result<void> screenshot(const std::string& file) override;

  SandPanel& panel() noexcept { return *panel_; }
  /// Where in the picture [pixels of the widget] a place of the sand [m] is seen.
  QPoint seenAt(double x, double y, double height) const;
  /// Nothing is left to compute, and the picture shows it.
  bool settled() const { return session_.idle() && !player_ && !dirty_; }

  /// Afterwards: the last frame; null if nothing could be drawn.
  const QImage& lastPicture() const noexcept { return lastPicture_; }
  /// [ms] of each frame that showed something new: its work, publishing and drawing.
  const FrameStatistics& frameTimes() const noexcept { return frameTimes_; }
  /// [us] of work in each frame that had any.
  const FrameStatistics& workTimes() const noexcept { return workTimes_; }
  /// Of the sand and of what is drawn.
  std::size_t bytes() const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  enum class Drag { none, tool, turn, move };

  SandPanelActions panelActions();
  void layOut(QSize size);
  void tick();
  void compute(Clock::time_point until);
  void receiveFirst(const SandSession::Over& over);
  void playOn(const SandPlayer::Over& over);
  void publish();
  void draw(Clock::time_point begin);
  void finish();
  void showState();
  void noticeNewSand();
  Values sandValues() const;

  bool keyPressed(int key, bool control);
  void act(SandAction action);
  void mousePressed(const QMouseEvent& event);
  void mouseMoved(const QMouseEvent& event);
  SandRay rayAt(QPoint pixel) const;
  std::optional<ToolPlace> groundAt(QPoint pixel) const;
  std::optional<ToolPlace> levelAt(QPoint pixel, double height) const;
  void pressTool(const QMouseEvent& event);
  void dragTool(const QMouseEvent& event);
  void endDrag();
  void outline(const ToolPlace& place, double east, double north);
  void showTool(QPoint pixel);
  void hideTool();

  void takeTool(const Values& values);
  void takeChecked(std::span<const Values::Entry> entries);
  void scaleTool(const char* parameter, double factor);
  void nextTool();
  void setSand(const Values& values);
  void bring(std::function<Result<Sandbox>()> maker);
  void chooseAndSave();
  void chooseAndLoad();
  void chooseAndExport();
  void tell(const Result<void>& done, const std::string& success);
  void complain(const std::string& sentence);

  SandSession& session_;
  SoSeparator* root_;  // referenced
  SoPerspectiveCamera* eye_;
  SandScene scene_;
  SandCamera camera_;
  RenderArea* area_;  // owned; goes before its nodes
  SandPanel* panel_ = nullptr;
  std::unique_ptr<SandPlayer> player_;
  std::shared_ptr<const SandSnapshot> shown_;

  QTimer timer_;
  std::optional<Clock::duration> duration_;
  Clock::duration drawing_{};  // how long it took last
  Clock::time_point end_ = Clock::time_point::max(), lastFigures_{};
  double moisture_ = 0.0;  // as it is shown
  bool wireframe_, dirty_ = true, leaving_ = false;
  bool beginning_ = false;   // the sand to begin with is still on its way
  std::uint64_t sands_ = 0;  // SandSession::sands() when the camera was placed

  Drag drag_ = Drag::none;
  Qt::MouseButton dragButton_ = Qt::NoButton;  // whose release ends it
  QPoint dragFrom_;
  ToolPlace dragPlace_;         // where the tool was last
  unsigned long dragTime_ = 0;  // [ms] then

  std::optional<Error> error_;
  ExitCode failure_ = kWorkFailed;
  FrameStatistics frameTimes_, workTimes_;
  QImage lastPicture_;
};

}  // namespace teren
