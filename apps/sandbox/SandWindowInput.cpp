// The keys and the mouse of the sandbox's window.
#include <algorithm>
#include <cmath>

#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <QCloseEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

#include "apps/sandbox/SandTool.h"
#include "apps/sandbox/SandWindow.h"
#include "apps/window/SavedFiles.h"

namespace teren {
namespace {

constexpr double kWheelNotch = 120.0;  // in Qt's eighths of a degree
constexpr double kLarger = 1.25;       // by a key

}  // namespace

bool SandWindow::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
    case QEvent::KeyPress: {
      const auto* key = static_cast<const QKeyEvent*>(event);
      return keyPressed(key->key(), key->modifiers().testFlag(Qt::ControlModifier));
    }
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonDblClick:
      mousePressed(*static_cast<const QMouseEvent*>(event));
      return true;
    case QEvent::MouseMove:
      mouseMoved(*static_cast<const QMouseEvent*>(event));
      return true;
    case QEvent::MouseButtonRelease:
      if (static_cast<const QMouseEvent*>(event)->button() == dragButton_) endDrag();
      return true;
    case QEvent::Wheel:
      if (player_ != nullptr) return true;
      camera_.approach(static_cast<const QWheelEvent*>(event)->angleDelta().y() / kWheelNotch);
      dirty_ = true;
      return true;
    case QEvent::Leave:
      hideTool();
      break;
    case QEvent::FocusOut:  // the button's release would go elsewhere
      endDrag();
      break;
    case QEvent::Resize:
    case QEvent::Show:
      dirty_ = true;
      break;
    default:
      break;
  }
  return QWidget::eventFilter(watched, event);
}

/// Keys that the panel's fields do not want; whoever leaves a field by Escape does not want to leave the
/// sand.
void SandWindow::keyPressEvent(QKeyEvent* event) {
  const bool control = event->modifiers().testFlag(Qt::ControlModifier);
  const bool quits = sandAction(event->key(), control) == SandAction::quit;
  if (quits || !keyPressed(event->key(), control)) QWidget::keyPressEvent(event);
}

bool SandWindow::keyPressed(int key, bool control) {
  const std::optional<SandAction> action = sandAction(key, control);
  if (!action) return false;
  const bool harmless = *action == SandAction::quit || *action == SandAction::screenshot;
  if (player_ == nullptr || harmless) act(*action);  // a script's sand and pictures are the script's alone
  return true;
}

void SandWindow::act(SandAction action) {
  switch (action) {
    case SandAction::undo:
      endDrag();
      if (!session_.undo()) panel_->say("there is nothing to take back");
      break;
    case SandAction::redo:
      if (!session_.redo()) panel_->say("there is nothing to do again");
      break;
    case SandAction::wireframe:
      setWireframe(!wireframe_);
      break;
    case SandAction::slides:
      session_.setSlides(!session_.slides());
      break;
    case SandAction::nextTool:
      nextTool();
      break;
    case SandAction::larger:
      scaleTool("size", kLarger);
      break;
    case SandAction::smaller:
      scaleTool("size", 1.0 / kLarger);
      break;
    case SandAction::deeper:
      scaleTool("depth", kLarger);
      break;
    case SandAction::flatter:
      scaleTool("depth", 1.0 / kLarger);
      break;
    case SandAction::resetCamera:
      camera_.reset();
      dirty_ = true;
      break;
    case SandAction::save:
      chooseAndSave();
      break;
    case SandAction::load:
      chooseAndLoad();
      break;
    case SandAction::exportObj:
      chooseAndExport();
      break;
    case SandAction::screenshot: {
      const std::string file = newPictureName();
      tell(screenshot(file), "screenshot: " + file);
      break;
    }
    case SandAction::quit:
      close();
  }
  showState();
}

void SandWindow::closeEvent(QCloseEvent* event) {
  leaving_ = true;
  // Once begun, the last frame is still to be drawn; tick() ends the program then.
  event->setAccepted(!timer_.isActive());
}

// ---- Mouse ----

/// Through the middle of a pixel.
SandRay SandWindow::rayAt(QPoint pixel) const {
  const QSize size = area_->getGLWidget()->size();
  SbViewVolume volume =
      eye_->getViewVolume(static_cast<float>(size.width()) / static_cast<float>(size.height()));
  SbVec3f near, far;
  volume.projectPointToLine(
      {(static_cast<float>(pixel.x()) + 0.5F) / static_cast<float>(size.width()),
       1.0F - (static_cast<float>(pixel.y()) + 0.5F) / static_cast<float>(size.height())},
      near, far);
  const SbVec3f way = far - near;
  const LatticeFrame& frame = session_.sandbox().surface().mesh().frame();  // the scene's zero is its corner
  return {{frame.x + near[0], frame.y + near[1], near[2]}, {way[0], way[1], way[2]}};
}

QPoint SandWindow::seenAt(double x, double y, double height) const {
  const QSize size = area_->getGLWidget()->size();
  const SbViewVolume volume =
      eye_->getViewVolume(static_cast<float>(size.width()) / static_cast<float>(size.height()));
  SbVec3f seen;
  volume.projectToScreen({static_cast<float>(x), static_cast<float>(y), static_cast<float>(height)}, seen);
  return {static_cast<int>(seen[0] * static_cast<float>(size.width())),
          static_cast<int>((1.0F - seen[1]) * static_cast<float>(size.height()))};
}

/// The place of the sand [m from its corner] that is seen there.
std::optional<ToolPlace> SandWindow::groundAt(QPoint pixel) const {
  if (shown_ == nullptr) return std::nullopt;
  const std::optional<SandHit> hit = shown_->hit(rayAt(pixel));
  if (!hit) return std::nullopt;
  return ToolPlace{hit->x - shown_->frame().x, hit->y - shown_->frame().y, hit->height};
}

/// The place at the tool's height that is seen there; nothing where the line of sight never gets there.
std::optional<ToolPlace> SandWindow::levelAt(QPoint pixel, double height) const {
  const SandRay ray = rayAt(pixel);
  const double part = (height - ray.from[2]) / ray.direction[2];
  if (!std::isfinite(part) || part < 0.0 || shown_ == nullptr) return std::nullopt;
  return ToolPlace{ray.from[0] + part * ray.direction[0] - shown_->frame().x,
                   ray.from[1] + part * ray.direction[1] - shown_->frame().y, height};
}

void SandWindow::mousePressed(const QMouseEvent& event) {
  if (drag_ != Drag::none) return;  // a second button changes nothing
  area_->getGLWidget()->setFocus();
  if (player_ != nullptr) return;
  dragFrom_ = event.pos();
  dragButton_ = event.button();
  const bool left = event.button() == Qt::LeftButton;
  if (event.button() == Qt::RightButton || (left && event.modifiers().testFlag(Qt::ShiftModifier))) {
    drag_ = Drag::turn;
  } else if (event.button() == Qt::MiddleButton ||
             (left && event.modifiers().testFlag(Qt::ControlModifier))) {
    drag_ = Drag::move;
  } else if (left) {
    pressTool(event);
  }
}

void SandWindow::pressTool(const QMouseEvent& event) {
  const std::optional<ToolPlace> ground = session_.arriving() ? std::nullopt : groundAt(event.pos());
  if (!ground) return;
  const ToolPlace place = session_.inside(*ground);
  if (const Result<void> pressed = session_.press(place); !pressed) return complain(pressed.error().message);
  drag_ = Drag::tool;
  dragPlace_ = place;
  dragTime_ = event.timestamp();
}

void SandWindow::mouseMoved(const QMouseEvent& event) {
  const QPoint moved = event.pos() - dragFrom_;
  dragFrom_ = event.pos();
  if (drag_ == Drag::turn) {
    camera_.turn(moved.x(), moved.y());
    dirty_ = true;
  } else if (drag_ == Drag::move) {
    camera_.move(moved.x(), moved.y(), area_->getGLWidget()->height());
    dirty_ = true;
  } else if (drag_ == Drag::tool) {
    dragTool(event);
  } else {
    showTool(event.pos());
  }
}

void SandWindow::dragTool(const QMouseEvent& event) {
  const std::optional<ToolPlace> level = levelAt(event.pos(), *dragPlace_.height);
  if (!level) return;
  const ToolPlace place = session_.inside(*level);
  const double east = place.x - dragPlace_.x, north = place.y - dragPlace_.y;
  const double way = std::sqrt(east * east + north * north);
  const double time = 1e-3 * static_cast<double>(event.timestamp() - dragTime_);
  if (const Result<void> dragged = session_.dragTo(place, time > 0.0 ? way / time : 0.0); !dragged) {
    complain(dragged.error().message);
  }
  dragPlace_ = place;
  dragTime_ = event.timestamp();
  outline(place, way > 0.0 ? east / way : 0.0, way > 0.0 ? north / way : 0.0);
}

void SandWindow::endDrag() {
  if (drag_ == Drag::tool) session_.release();
  drag_ = Drag::none;
}

/// Where the tool would be pressed in.
void SandWindow::showTool(QPoint pixel) {
  const std::optional<ToolPlace> ground = player_ != nullptr ? std::nullopt : groundAt(pixel);
  if (!ground) return hideTool();
  outline(session_.inside(*ground), 0.0, 0.0);
}

void SandWindow::outline(const ToolPlace& place, double east, double north) {
  const LatticeFrame& frame = shown_->frame();
  scene_.setTool(session_.tool(),
                 {frame.x + place.x, frame.y + place.y, place.height.value_or(0.0), east, north});
  dirty_ = true;
}

void SandWindow::hideTool() {
  scene_.hideTool();
  dirty_ = true;
}

// ---- Tools by keys ----

void SandWindow::scaleTool(const char* parameter, double factor) {
  std::vector<Values::Entry> entries(session_.toolValues().entries().begin(),
                                     session_.toolValues().entries().end());
  for (Values::Entry& entry : entries) {
    if (entry.first == parameter) entry.second = factor * std::get<double>(entry.second);
  }
  takeChecked(entries);
}

void SandWindow::nextTool() {
  const std::span<const std::string_view> tools = SandTool::parameters().front().choices;
  const std::string& now = session_.toolValues().choice("tool");
  const auto at = std::find(tools.begin(), tools.end(), now) - tools.begin();
  std::vector<Values::Entry> entries(session_.toolValues().entries().begin(),
                                     session_.toolValues().entries().end());
  entries.front().second = std::string(tools[static_cast<std::size_t>(at + 1) % tools.size()]);
  takeChecked(entries);
}

void SandWindow::takeChecked(std::span<const Values::Entry> entries) {
  const Result<Values> values = Values::check(SandTool::parameters(), entries, "tool");
  if (!values) return complain(values.error().message);
  takeTool(*values);
}

}  // namespace teren
