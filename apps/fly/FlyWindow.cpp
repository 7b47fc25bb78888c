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

constexpr std::chrono::milliseconds kBetweenFigures(150);
constexpr std::chrono::milliseconds kBetweenHiddenFrames(50);
constexpr std::chrono::milliseconds kBetweenSettlingPictures(250);
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
  layout->setSpacing(0);
  layout->addWidget(area_->getWidget(), 1);
  panel_ =
      new DetailPanel({.setDistance =
                           [this](double distance) {
                             chooseDetail([distance](DetailSettings& detail) { detail.distance = distance; });
                           },
                       .setPixelError =
                           [this](double error) {
                             chooseDetail([error](DetailSettings& detail) { detail.pixelError = error; });
                           }},
                      this);
  panel_->hide();
  panel_->showDetail(flight.engine().options().view.detail);
  layout->addWidget(panel_);
  area_->setBackgroundColor(light.haze);
  area_->setSceneGraph(scene_.node());
  area_->setOverlay([this](QSize pixels) { display_.draw(pixels); });
  QWidget* canvas = area_->getGLWidget();
  canvas->setFocusPolicy(Qt::StrongFocus);
  canvas->setMouseTracking(true);
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
  const double step = paused_ || frozen_ ? 0.0 : dt;
  flight_.advance(step);
  if (frozen_) {
    frozen_->camera.update(dt, keys_.cameraMoves(), flight_.engine().ground(),
                           static_cast<double>(daylight_.waterLevel));
  } else {
    rig_.update(dt, keys_.cameraMoves(), poseOf(flight_.activeObject()));
  }
  dig();
  updateScene(step);
  if (last || now - lastFigures_ > kBetweenFigures) {
    showFigures();
    tellMessages();
    lastFigures_ = now;
  }
  present(last);
  timer_.setInterval(isMinimized() ? kBetweenHiddenFrames : std::chrono::milliseconds(0));
  if (last) {
    timer_.stop();
    QApplication::exit(0);
  }
}

void FlyWindow::present(bool last) {
  if (last || pictureWanted_) {
    const QImage picture = area_->renderAndRead();
    if (pictureWanted_) keepPicture(picture);
    if (last) lastPicture_ = picture;
  } else {
    area_->render();
  }
  flight_.frameDone();
  const Clock::time_point presented = Clock::now();
  const double milliseconds = 1e3 * seconds(presented - lastPresented_);
  frameTimes_.add(milliseconds);
  graph_.add(milliseconds, 1e-3 * flight_.engineTimes().last());
  lastPresented_ = presented;
}

Viewpoint FlyWindow::viewpoint() const {
  if (frozen_) return frozen_->camera.viewpoint();
  return rig_.viewpoint(poseOf(flight_.activeObject()), flight_.engine().ground(),
                        static_cast<double>(daylight_.waterLevel));
}

void FlyWindow::updateScene(double dt) {
  const Viewpoint view = viewpoint();
  if (!frozen_) fitDetail(view.fieldOfView);
  if (colours_ == LandColours::errors) lookForColours();
  scene_.show(flight_, view, rig_.person(), dt);
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

Eye FlyWindow::eye() const {
  const Viewpoint view = frozen_ ? frozen_->eye : viewpoint();
  return {view.pose.position, view.pose.height, lensPixels(area_->pixels().height(), view.fieldOfView)};
}

void FlyWindow::lookForColours() {
  tintEye_ = eye();
  tintMovedWith_ = flight_.detailEye();
}

PixelError FlyWindow::pixelError() const {
  return teren::pixelError(flight_.engine().world(), *flight_.engine().scene(), eye(), flight_.detailEye());
}

double FlyWindow::wantedPixelError() const {
  return flight_.engine().options().view.detail.value_or(kFlyingDetail).pixelError;
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
  addToolLines(lines);
  if (frozen_) lines.push_back({"view", "frozen; F4 goes on"});
  display_.setLines(std::move(lines));
  showLegend(engine);
  display_.setGraph(graphShown_ ? &graph_ : nullptr);
  panel_->showDetail(flight_.engine().options().view.detail);
}

void FlyWindow::showLegend(const EngineFigures& figures) {
  switch (colours_) {
    case LandColours::levels:
      return display_.setLegend(levelLegend(figures.nodesAtLevel));
    case LandColours::errors:
      return display_.setLegend(errorLegend(wantedPixelError()));
    default:
      return display_.setLegend({});
  }
}

// The active object's keys, then the program's.
void FlyWindow::showHelp() {
  std::vector<KeyHelp> help = flight_.activeObject().keys();
  help.insert(help.end(), KeyMap::help().begin(), KeyMap::help().end());
  display_.setHelp(help);
}

void FlyWindow::closeEvent(QCloseEvent* event) {
  leaving_ = true;
  // While it flies, the last frame is still to be drawn; tick() ends the program then.
  event->setAccepted(!timer_.isActive());
}

}  // namespace teren
