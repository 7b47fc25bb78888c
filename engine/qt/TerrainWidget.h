// The landscape as a Qt widget: put a TerrainWidget into a window of your own and give it a world.
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include <QPoint>
#include <QSize>
#include <QString>
#include <QWidget>

#include "teren/Engine.h"
#include "teren/Position.h"
#include "teren/Result.h"
#include "teren/World.h"

#include "qt/Viewer.h"

class SoTerrain;

namespace teren {

/// A point of the ground that is drawn.
struct GroundPoint {
  Position position;
  double height = 0.0;  ///< [m] of the triangle there
};

/// Draws a world through the eye of a viewer, and works at what is missing from a timer, within a budget, on
/// the thread it lives on. It rests, without timers and without drawing, while nothing is missing or
/// still to be measured and nothing changes, and while it is hidden. Like any widget it may be moved to
/// another parent, hidden, deleted and made again, and a window may have several; each has an engine of its
/// own.
///
/// A drag with the left button turns the view; the wheel moves it forwards and backwards, with Shift or Ctrl
/// up and down; other keys and buttons are the program's. To give the mouse another meaning, override the
/// handlers.
///
/// Needs a QApplication with OpenGL 2.1. The first widget calls SoQt::init() unless the program has done so;
/// Open Inventor then stays until the process ends. All calls from the GUI thread; no signal is emitted while
/// the scene is drawn. Nothing throws. Errors come back as a Result, and errorOccurred says the same
/// sentence.
class TerrainWidget : public QWidget {
  Q_OBJECT

 public:
  explicit TerrainWidget(QWidget* parent = nullptr);
  ~TerrainWidget() override;

  /// Shows this world; until its first ground is there, what was shown before. What is refused leaves the
  /// world as it was. Plugins come from PluginRegistry::standard(), whose first call loads them. Costs
  /// milliseconds.
  Result<void> setWorld(const WorldDescription& description);
  /// The same from the JSON text of a world.
  Result<void> setWorldText(const QString& json);
  /// The same from a world file.
  Result<void> setWorldFile(const QString& file);
  /// nullptr before the first world.
  std::shared_ptr<const World> world() const;

  /// Where plugins come from, at first PluginRegistry::standard(). With a world there it is made anew from
  /// the same description, and the land stays until the new one is there: what to do with
  /// PluginRegistry::reloaded(). What is refused leaves plugins and land as they were.
  Result<void> setPlugins(std::shared_ptr<const PluginRegistry> plugins);

  /// The view, the worker threads and the byte cap. Of a view with detail by error, the picture's height and
  /// the field of view are the widget's to say, whatever its size. With a world there it takes a new
  /// engine, which makes the view anew; what is refused leaves the options as they were. Without a world
  /// nothing is refused yet.
  Result<void> setOptions(const EngineOptions& options);
  /// As they were set.
  const EngineOptions& options() const noexcept;

  /// How long each frame may work at what is missing, brought into 0.1 ms ... 1 s. More fills the view
  /// sooner, and the program's other widgets answer later meanwhile. Default: 4 ms.
  void setFrameBudget(std::chrono::nanoseconds budget);
  std::chrono::nanoseconds frameBudget() const noexcept;

  /// Moves the eye, at once and however far. Where the ground is not known yet, the eye keeps its height
  /// until it is.
  Result<void> setViewer(const Viewer& viewer);
  const Viewer& viewer() const noexcept;
  /// [m] Of the eye, in the world.
  double eyeHeight() const noexcept;

  /// The ground that is seen at a point of the widget; empty where there is sky. Water is never picked: what
  /// comes back lies below it; nor is, for the moment until a new world has something to show, the old one.
  std::optional<GroundPoint> pick(const QPoint& point) const;

  /// All zero before the first world.
  EngineFigures figures() const;

  /// The node that draws, owned by the widget: its waterLevel and hazeColor are the program's to set, its
  /// other fields and its scene the widget's.
  SoTerrain& terrain() const noexcept;

  QSize sizeHint() const override;

 Q_SIGNALS:
  /// The viewer was moved, by the program or the mouse, or the ground below it has become known.
  void positionChanged(const teren::Viewer& viewer, double eyeHeight);
  /// At most ten times a second while the engine works, and when it comes to rest.
  void figuresChanged(const teren::EngineFigures& figures);
  /// One sentence: what a call has refused, a plugin that misbehaves, or, when the widget is first shown,
  /// that OpenGL is missing.
  void errorOccurred(const QString& sentence);
  /// The mouse was moved over the widget, with or without a button.
  void cursorMoved(const QPoint& point);

 protected:
  bool event(QEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  class Private;
  std::unique_ptr<Private> private_;
};

}  // namespace teren

Q_DECLARE_METATYPE(teren::Viewer)
Q_DECLARE_METATYPE(teren::EngineFigures)
