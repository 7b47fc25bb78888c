#include "apps/static/StaticWindow.h"

#include <algorithm>

#include <Inventor/nodes/SoCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <QApplication>
#include <QCloseEvent>
#include <QKeyEvent>
#include <QVBoxLayout>

#include "apps/window/WindowProgram.h"

namespace teren {
namespace {

constexpr std::chrono::milliseconds kUpdateBudget(8);
constexpr std::chrono::milliseconds kBetweenTicks(16);
constexpr double kSecondsApart = 0.8;  // from together to apart
constexpr int kFramesAtLeast = 3;      // before the first ones the window may still have another size
const SbColor kBackground(0.80F, 0.86F, 0.92F);

/// Begins and ends gently.
double eased(double way) {
  return way * way * (3.0 - 2.0 * way);
}

}  // namespace

StaticWindow::StaticWindow(Engine& engine, QSize size, const StaticLook& look)
    : engine_(engine), look_(look), view_(new ExaminerView(this)) {
  setWindowTitle(QStringLiteral("Teren - E: apart, W: wire, Q: quit"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(view_->getWidget());
  view_->setBackgroundColor(kBackground);
  view_->setHeadlight(FALSE);
  setWireframe(look.wireframe);
  QWidget* canvas = view_->getGLWidget();
  canvas->setFocusPolicy(Qt::StrongFocus);
  canvas->installEventFilter(this);  // after SoQt's own, so it sees the events first
  setFocusProxy(canvas);
  timer_.callOnTimeout(this, [this] { tick(); });
  resize(size);
}

StaticWindow::~StaticWindow() {
  delete view_;
}

bool StaticWindow::settle() {
  show();
  view_->show();
  setFocus();
  do {
    engine_.update(0.0, kUpdateBudget);
    engineTimes_.add(std::chrono::duration<double, std::micro>(engine_.figures().lastUpdate).count());
    QApplication::processEvents();
    if (leaving_ || endAsked()) return false;
  } while (engine_.figures().pending > 0);
  return true;
}

void StaticWindow::begin(std::optional<Clock::duration> duration) {
  const World& world = engine_.world();
  const double nodeSide =
      world.pitch() * static_cast<double>(std::int64_t{1} << engine_.options().view.level);
  scene_ = std::make_unique<StaticScene>(*engine_.scene(), world.intervals(), nodeSide);
  view_->setSceneGraph(scene_->node());
  placeCamera();
  way_ = look_.apart ? 1.0 : 0.0;
  scene_->setApart(way_);
  begun_ = true;
  lastTick_ = Clock::now();
  if (duration) end_ = lastTick_ + *duration;
  timer_.start(kBetweenTicks);
}

/// So that the pieces stay in the picture when they move apart.
void StaticWindow::placeCamera() {
  SoCamera* camera = view_->getCamera();
  const SbRotation tilted(SbVec3f(1.0F, 0.0F, 0.0F), 0.85F), turned(SbVec3f(0.0F, 0.0F, 1.0F), 0.5F);
  camera->orientation = tilted * turned;
  scene_->setApart(1.0);
  camera->viewAll(scene_->node(), view_->getViewportRegion());
  // viewAll goes by the sphere around, but the land is flat, and what is near looks larger.
  constexpr float kNearer = 0.92F, kDown = 0.06F;
  const auto direction = [camera](float x, float y, float z) {
    SbVec3f turnedDirection;
    camera->orientation.getValue().multVec(SbVec3f(x, y, z), turnedDirection);
    return turnedDirection;
  };
  const float distance = camera->focalDistance.getValue();
  camera->position = camera->position.getValue() +
                     direction(0.0F, 0.0F, -1.0F) * (distance * (1.0F - kNearer)) +
                     direction(0.0F, -1.0F, 0.0F) * (distance * kDown);
  camera->focalDistance = distance * kNearer;
  view_->saveHomePosition();
}

void StaticWindow::setWireframe(bool wireframe) {
  look_.wireframe = wireframe;
  view_->setDrawStyle(SoQtViewer::STILL, wireframe ? SoQtViewer::VIEW_LINE : SoQtViewer::VIEW_AS_IS);
}

void StaticWindow::tick() {
  const Clock::time_point now = Clock::now();
  const double step = std::chrono::duration<double>(now - lastTick_).count() / kSecondsApart;
  lastTick_ = now;
  if (leaving_ || endAsked() || now >= end_) return finish();
  if (!moving()) return;
  way_ = look_.apart ? std::min(1.0, way_ + step) : std::max(0.0, way_ - step);
  scene_->setApart(eased(way_));
}

void StaticWindow::finish() {
  timer_.stop();
  for (int frame = 1; frame < kFramesAtLeast; ++frame) {
    view_->render();
    QApplication::processEvents();
  }
  lastPicture_ = view_->renderAndRead();
  QApplication::exit(0);
}

bool StaticWindow::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::KeyPress) {
    const auto* key = static_cast<const QKeyEvent*>(event);
    if (key->isAutoRepeat() || keyPressed(key->key())) return true;
  }
  return QWidget::eventFilter(watched, event);
}

bool StaticWindow::keyPressed(int key) {
  switch (key) {
    case Qt::Key_E:
      look_.apart = !look_.apart;
      return true;
    case Qt::Key_W:
      setWireframe(!look_.wireframe);
      return true;
    case Qt::Key_Q:
    case Qt::Key_Escape:
      close();
      return true;
    default:
      return false;
  }
}

void StaticWindow::closeEvent(QCloseEvent* event) {
  leaving_ = true;
  event->setAccepted(
      !begun_);  // once begun, the last frame is still to be drawn; tick() ends the program then
}

}  // namespace teren
