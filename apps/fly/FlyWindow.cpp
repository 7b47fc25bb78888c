#include "apps/fly/FlyWindow.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include <Inventor/nodes/SoSeparator.h>
#include <QApplication>
#include <QCloseEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QVBoxLayout>
#include <QWheelEvent>

#include "apps/fly/FlightFigures.h"
#include "apps/window/SavedFiles.h"
#include "apps/window/WindowProgram.h"

namespace teren {
namespace {

constexpr double kRadiansPerPixel = 0.005;
constexpr double kWheelNotch = 120.0;  // in Qt's eighths of a degree
constexpr std::chrono::milliseconds kBetweenFigures(150);
constexpr std::chrono::milliseconds kBetweenHiddenFrames(50);
constexpr std::chrono::milliseconds kBetweenSettlingPictures(250);
constexpr std::chrono::seconds kSentenceTime(4);
constexpr std::size_t kFramesShown = 30;  // that the times on the display look back

double seconds(FlyWindow::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

double frameStep(FlyWindow::Clock::duration duration) {
  return std::clamp(seconds(duration), 0.0, Flight::kLongestStep);
}

}  // namespace

FlyWindow::FlyWindow(Flight& flight, const Daylight& light, QSize size, Remake remake)
    : flight_(flight),
      daylight_(light),
      scene_(light, flight.engine()),
      remake_(std::move(remake)),
      area_(new RenderArea(this)) {
  setWindowTitle(QStringLiteral("Teren"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(area_->getWidget());
  area_->setBackgroundColor(light.haze);
  area_->setSceneGraph(scene_.node());
  area_->setOverlay([this](QSize pixels) { display_.draw(pixels); });
  QWidget* canvas = area_->getGLWidget();
  canvas->setFocusPolicy(Qt::StrongFocus);
  canvas->installEventFilter(this);  // after SoQt's own, so it sees the events first
  setFocusProxy(canvas);
  timer_.callOnTimeout(this, [this] { tick(); });
  resize(size);
}

FlyWindow::~FlyWindow() {
  delete area_;
}

bool FlyWindow::settle() {
  show();
  area_->show();
  setFocus();
  Clock::time_point nextPicture{};
  flight_.settle([this, &nextPicture](std::size_t done, std::size_t wanted) {
    QApplication::processEvents();
    if (Clock::now() < nextPicture) return !leaving_ && !endAsked();
    nextPicture = Clock::now() + kBetweenSettlingPictures;
    const std::size_t percent = wanted == 0 ? 100 : 100 * done / wanted;
    display_.setBanner("making the land: " + std::to_string(percent) + " %");
    updateScene(0.0);
    area_->render();
    return !leaving_ && !endAsked();
  });
  display_.setBanner({});
  showHelp();
  return !leaving_ && !endAsked();
}

void FlyWindow::fly(std::optional<Clock::duration> duration) {
  duration_ = duration;
  begin_ = lastTick_ = lastPresented_ = Clock::now();
  timer_.start(0);
}

bool FlyWindow::isLastFrame(Clock::time_point now) const {
  if (leaving_ || endAsked()) return true;
  return duration_ && now - begin_ >= *duration_ && frameTimes_.count() + 1 >= kFramesAtLeast;
}

void FlyWindow::tick() {
  const Clock::time_point now = Clock::now();
  const double dt = frameStep(now - lastTick_);
  lastTick_ = now;
  const bool last = isLastFrame(now);
  flight_.advance(paused_ ? 0.0 : dt);
  rig_.update(dt, keys_.cameraMoves(), poseOf(flight_.activeObject()));
  updateScene(paused_ ? 0.0 : dt);
  if (last || now - lastFigures_ > kBetweenFigures) {
    showFigures();
    tellMessages();
    lastFigures_ = now;
  }
  if (last || pictureWanted_) {
    const QImage picture = area_->renderAndRead();
    if (pictureWanted_) keepPicture(picture);
    if (last) lastPicture_ = picture;
  } else {
    area_->render();
  }
  flight_.frameDone();
  const Clock::time_point presented = Clock::now();
  frameTimes_.add(1e3 * seconds(presented - lastPresented_));
  lastPresented_ = presented;
  timer_.setInterval(isMinimized() ? kBetweenHiddenFrames : std::chrono::milliseconds(0));
  if (last) {
    timer_.stop();
    QApplication::exit(0);
  }
}

Viewpoint FlyWindow::viewpoint() const {
  return rig_.viewpoint(poseOf(flight_.activeObject()), flight_.engine().ground(),
                        static_cast<double>(daylight_.waterLevel));
}

void FlyWindow::updateScene(double dt) {
  const Viewpoint view = viewpoint();
  scene_.show(flight_, view, rig_.person(), dt);
  fitDetail(view.fieldOfView);
  flight_.engine().setRendererBytes(scene_.bufferBytes());
}

void FlyWindow::fitDetail(double fieldOfView) {
  Engine& engine = flight_.engine();
  if (!engine.options().view.detail || area_->pixels().isEmpty()) return;
  DetailSettings detail = *engine.options().view.detail;
  detail.lines = area_->pixels().height();
  detail.fieldOfView = fieldOfView;
  if (const Result<void> fitted = engine.setDetail(detail); !fitted) complain(fitted.error().message);
}

std::size_t FlyWindow::bytes() const {
  return flight_.engine().figures().bytes;
}

PixelError FlyWindow::pixelError() const {
  const Viewpoint view = viewpoint();
  const int rows = area_->pixels().height();
  const Eye eye{view.pose.position, view.pose.height, lensPixels(rows, view.fieldOfView)};
  return teren::pixelError(flight_.engine().world(), *flight_.engine().scene(), eye);
}

void FlyWindow::showFigures() {
  const EngineFigures engine = flight_.engine().figures();
  CostFigures figures;
  figures.frameMilliseconds = frameTimes_.latest(kFramesShown).p50;
  figures.engineMilliseconds = 1e-3 * flight_.engineTimes().latest(kFramesShown).p50;
  figures.nodes = engine.nodes;
  figures.triangles = engine.triangles;
  figures.bytes = bytes();
  figures.pending = engine.pending;
  figures.pixelError = pixelError();
  std::vector<DisplayLine> lines = flight_.activeObject().headUpDisplay();
  for (DisplayLine& line : costLines(figures)) lines.push_back(std::move(line));
  display_.setLines(std::move(lines));
}

// The active object's keys, then the program's.
void FlyWindow::showHelp() {
  std::vector<KeyHelp> help = flight_.activeObject().keys();
  help.insert(help.end(), KeyMap::help().begin(), KeyMap::help().end());
  display_.setHelp(help);
}

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
      rig_.zoom(static_cast<const QWheelEvent*>(event)->angleDelta().y() / kWheelNotch);
      return true;
    case QEvent::FocusOut:  // their release would go elsewhere
      keys_.releaseAll();
      flight_.engine().letGo();
      dragFrom_.reset();
      break;
    default:
      break;
  }
  return QWidget::eventFilter(watched, event);
}

bool FlyWindow::keyEvent(const QKeyEvent& event) {
  const bool keypad = event.modifiers().testFlag(Qt::KeypadModifier);
  const bool pressed = event.type() == QEvent::KeyPress;
  const std::optional<Action> action = KeyMap::action(event.key(), keypad);
  if (!action) {
    const std::string name = KeyMap::name(event.key(), keypad);
    return !name.empty() && (event.isAutoRepeat() || flight_.engine().handle({name, pressed ? 1.0 : 0.0}));
  }
  if (event.isAutoRepeat()) return true;
  if (!pressed) {
    keys_.release(event.key(), keypad);
  } else if (isHeldAction(*action)) {
    keys_.press(event.key(), keypad);
  } else {
    act(*action);
  }
  return true;
}

bool FlyWindow::mouseEvent(const QEvent& event) {
  const auto& mouse = static_cast<const QMouseEvent&>(event);
  if (event.type() == QEvent::MouseMove && dragFrom_) {
    const QPoint moved = mouse.pos() - *dragFrom_;
    rig_.look(kRadiansPerPixel * moved.x(), -kRadiansPerPixel * moved.y());
    dragFrom_ = mouse.pos();
  } else if (event.type() == QEvent::MouseButtonPress) {
    dragFrom_ = mouse.pos();
  } else if (event.type() == QEvent::MouseButtonRelease) {
    dragFrom_.reset();
  }
  return true;
}

void FlyWindow::act(Action action) {
  switch (action) {
    case Action::cameraReset:
      rig_.reset();
      break;
    case Action::switchPerson:
      rig_.togglePerson();
      break;
    case Action::nextObject:
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
      break;  // held keys are read every frame
  }
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
  flight_.goOverTo(std::move(land->engine));
}

// What is wrong with plugins and objects, and that the land asked for is there.
void FlyWindow::tellMessages() {
  if (changes_ != flight_.changes()) say("this is the new land");
  changes_ = flight_.changes();
  for (const std::string& message : flight_.engine().takeMessages()) complain(message);
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

void FlyWindow::closeEvent(QCloseEvent* event) {
  leaving_ = true;
  // While it flies, the last frame is still to be drawn; tick() ends the program then.
  event->setAccepted(!timer_.isActive());
}

}  // namespace teren
