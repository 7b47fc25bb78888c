#include <cstdio>
#include <string>
#include <utility>

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

#include "teren/Parameter.h"

#include "apps/fly/FlyWindow.h"
#include "apps/fly/Steps.h"
#include "apps/window/SavedFiles.h"

// What keys, mouse and sliders do.

namespace teren {
namespace {

constexpr double kRadiansPerPixel = 0.005;
constexpr double kWheelNotch = 120.0;  // in Qt's eighths of a degree
constexpr std::chrono::seconds kSentenceTime(4);
const SbColor kInk(0.10F, 0.17F, 0.28F);  // of wires

}  // namespace

bool FlyWindow::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
    case QEvent::KeyPress:
    case QEvent::KeyRelease:
      return keyEvent(*static_cast<const QKeyEvent*>(event));
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonRelease:
    case QEvent::MouseMove:
      return mouseEvent(*event);
    case QEvent::Wheel:
      zoom(static_cast<const QWheelEvent*>(event)->angleDelta().y() / kWheelNotch);
      return true;
    case QEvent::FocusOut:  // their release would go elsewhere
      keys_.releaseAll();
      flight_.engine().letGo();
      dragFrom_.reset();
      digsByMouse_ = false;
      break;
    case QEvent::Leave:
      mouse_.reset();
      break;
    default:
      break;
  }
  return QWidget::eventFilter(watched, event);
}

bool FlyWindow::keyEvent(const QKeyEvent& event) {
  const bool keypad = event.modifiers().testFlag(Qt::KeypadModifier);
  const bool pressed = event.type() == QEvent::KeyPress;
  const bool shifted = !keypad && event.modifiers().testFlag(Qt::ShiftModifier);
  const int meant = shifted ? KeyMap::withShift(event.key()) : event.key();
  const int key = frozen_ && !keypad ? KeyMap::whileFrozen(meant) : meant;
  const std::optional<Action> action = KeyMap::action(key, keypad);
  if (!action) {
    if (frozen_) return true;  // nobody is to be steered
    const std::string name = KeyMap::name(key, keypad);
    return !name.empty() && (event.isAutoRepeat() || flight_.engine().handle({name, pressed ? 1.0 : 0.0}));
  }
  if (event.isAutoRepeat() && !isRepeatedAction(*action)) return true;
  if (!pressed) {
    keys_.release(key, keypad);
  } else if (isHeldAction(*action)) {
    keys_.press(key, keypad);
    if (*action == Action::dig && canDig()) {
      digsOnce_ = true;
      aimsByMouse_ = false;
    }
  } else {
    act(*action);
  }
  return true;
}

// The right button presses the tool in hand, the others look around.
bool FlyWindow::mouseEvent(const QEvent& event) {
  const auto& mouse = static_cast<const QMouseEvent&>(event);
  const bool digs = mouse.button() == Qt::RightButton;
  if (event.type() == QEvent::MouseMove) {
    if (dragFrom_) {
      const QPoint moved = mouse.pos() - *dragFrom_;
      const double right = kRadiansPerPixel * moved.x(), up = -kRadiansPerPixel * moved.y();
      frozen_ ? frozen_->camera.look(right, up) : rig_.look(right, up);
      dragFrom_ = mouse.pos();
    } else {
      aimsByMouse_ = true;
    }
  } else if (event.type() == QEvent::MouseButtonPress) {
    if (!digs) {
      dragFrom_ = mouse.pos();
    } else if (canDig()) {
      digsByMouse_ = digsOnce_ = aimsByMouse_ = true;
    }
  } else if (event.type() == QEvent::MouseButtonRelease) {
    if (digs) {
      digsByMouse_ = false;
    } else {
      dragFrom_.reset();
    }
  }
  mouse_ = mouse.pos();
  return true;
}

void FlyWindow::zoom(double steps) {
  frozen_ ? frozen_->camera.zoom(steps) : rig_.zoom(steps);
}

void FlyWindow::act(Action action) {
  switch (action) {
    case Action::cameraReset:
      if (frozen_) {
        frozen_->camera = FreeCamera(frozen_->eye);
      } else {
        rig_.reset();
      }
      break;
    case Action::switchPerson:
      if (!frozen_) rig_.togglePerson();
      break;
    case Action::nextObject:
      if (frozen_) break;  // it would see other land
      flight_.nextObject();
      say("you fly " + flight_.activeObject().name());
      showHelp();
      break;
    case Action::pause:
      togglePause();
      break;
    case Action::help:
      display_.toggleHelp();
      break;
    case Action::reload:
      reload();
      break;
    case Action::fullScreen:
      toggleFullScreen();
      break;
    case Action::screenshot:
      pictureWanted_ = true;
      break;
    case Action::quit:
      close();
      break;
    default:
      actOnLook(action);
      break;
  }
}

void FlyWindow::actOnLook(Action action) {
  switch (action) {
    case Action::finer:
    case Action::coarser:
      return chooseDetail([action](DetailSettings& detail) {
        detail.pixelError = Steps::pixelErrors().next(detail.pixelError, action == Action::coarser ? 1 : -1);
      });
    case Action::farther:
    case Action::nearer:
      return chooseDetail([action](DetailSettings& detail) {
        detail.distance = Steps::distances().next(detail.distance, action == Action::farther ? 1 : -1);
      });
    case Action::detailPanel:
      return panel_->setVisible(panel_->isHidden());
    case Action::landColours:
      colours_ = after(colours_);
      return showColours();
    case Action::freeze:
      return toggleFreeze();
    case Action::wires:
      wires_ = !wires_;
      scene_.setWires(wires_);
      return showColours();
    case Action::frameGraph:
      graphShown_ = !graphShown_;
      return display_.setGraph(graphShown_ ? &graph_ : nullptr);
    default:
      return actOnTools(action);
  }
}

void FlyWindow::chooseDetail(const std::function<void(DetailSettings&)>& change) {
  const std::optional<DetailSettings>& present = flight_.engine().options().view.detail;
  if (!present)
    return say("the land is of one level; without --view-level and --radius its detail can be chosen");
  DetailSettings detail = *present;
  change(detail);
  if (const Result<void> chosen = flight_.setDetail(detail); !chosen) {
    say(chosen.error().message);
  } else {
    say(numberText(detail.distance / 1e3) + " km of land, at most " + numberText(detail.pixelError) +
        " px off");
  }
  panel_->showDetail(flight_.engine().options().view.detail);
}

void FlyWindow::showColours() {
  lookForColours();
  switch (colours_) {
    case LandColours::levels:
      scene_.setTint([](const Mesh& mesh) { return levelColour(mesh.nodeLevel); });
      break;
    case LandColours::errors:
      scene_.setTint([this](const Mesh& mesh) {
        const Engine& engine = flight_.engine();
        const double error =
            teren::pixelError(engine.world(), mesh, tintEye_, engine.scene()->morph(), tintMovedWith_);
        return errorColour(error / wantedPixelError());
      });
      break;
    default:
      scene_.setTint(wires_ ? [](const Mesh&) { return kInk; } : std::function<SbColor(const Mesh&)>());
  }
  showLegend(flight_.engine().figures());
}

void FlyWindow::toggleFreeze() {
  keys_.releaseAll();
  flight_.engine().letGo();
  if (frozen_) {
    frozen_.reset();
    scene_.thaw();
  } else {
    const Viewpoint here = viewpoint();
    frozen_.emplace(Frozen{here, FreeCamera(here)});
    const QSize pixels = area_->pixels();
    scene_.freeze(here, pixels.isEmpty() ? 1.0 : static_cast<double>(pixels.width()) / pixels.height());
  }
  say(frozen_ ? "frozen: the keys that steer move the camera; F4 goes on" : "it goes on");
}

void FlyWindow::togglePause() {
  paused_ = !paused_;
  display_.setBanner(paused_ ? "paused" : "");
}

void FlyWindow::say(const std::string& sentence) {
  lastSentence_ = sentence;
  display_.say(sentence, kSentenceTime);
}

void FlyWindow::complain(const std::string& sentence) {
  std::fprintf(stderr, "teren-fly: %s\n", sentence.c_str());
  say(sentence);
}

void FlyWindow::reload() {
  Result<NewLand> land = remake_();
  if (!land) {
    complain("the land stays as it is: " + land.error().message);
    return;
  }
  std::string changed;
  for (const std::string& id : land->changed) changed += (changed.empty() ? "" : ", ") + id;
  say((changed.empty() ? "no plugin has changed" : "changed: " + changed) + "; making the land anew");
  flight_.goOverTo(std::move(land->engine), std::move(land->world));
}

// What is wrong with plugins and objects, and that the land asked for is there.
void FlyWindow::tellMessages() {
  if (changes_ != flight_.changes()) say("this is the new land");
  changes_ = flight_.changes();
  for (const std::string& message : flight_.engine().takeMessages()) complain(message);
  if (!flight_.edits()) return;
  for (const std::string& message : flight_.edits()->takeMessages()) complain(message);
}

void FlyWindow::toggleFullScreen() {
  if (isFullScreen()) {
    showNormal();
  } else {
    showFullScreen();
  }
}

void FlyWindow::keepPicture(const QImage& picture) {
  pictureWanted_ = false;
  const std::string file = newPictureName();
  const Result<void> saved = savePicture(picture, file);
  say(saved ? "screenshot: " + file : saved.error().message);
}

}  // namespace teren
