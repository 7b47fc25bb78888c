#include "qt/TerrainWidget.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <Inventor/Qt/SoQt.h>
#include <Inventor/SbVec2f.h>
#include <Inventor/SbVec2s.h>
#include <Inventor/SoDB.h>
#include <Inventor/nodes/SoSeparator.h>
#include <QCoreApplication>
#include <QElapsedTimer>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QPointer>
#include <QTimer>
#include <QVBoxLayout>
#include <QWheelEvent>

#include "coin/SoTerrain.h"
#include "qt/EyeAboveGround.h"
#include "qt/TerrainArea.h"
#include "qt/TerrainStage.h"

namespace teren {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::milliseconds kBetweenUpdates = 16ms;
constexpr std::chrono::nanoseconds kLeastBudget = 100us, kMostBudget = 1s;
constexpr qint64 kBetweenFigures = 100;  // [ms]
// After a widget is shown or resized its native window needs some frames to follow.
constexpr int kFramesAfterShow = 6;
constexpr double kRadiansPerPixel = 0.005;
constexpr double kMostPitch = 1.5;     // [rad] that the mouse can look up or down
constexpr double kWheelNotch = 120.0;  // in Qt's eighths of a degree
constexpr double kForwardShare = 0.4;  // of the height above ground, for a notch
constexpr double kClimbFactor = 1.15;  // for a notch

/// Inventor, SoQt and the node's class, set up once in a process.
void startInventor() {
  if (SoQt::getTopLevelWidget() == nullptr) {
    SoQt::init(new QWidget);  // SoQt asks for a window; it is never shown, and stays as long as Inventor does
    SoDB::enableRealTimeSensor(FALSE);  // or Inventor's clock would wake the program twelve times a second
  }
  SoTerrain::initClass();
  qRegisterMetaType<Viewer>("teren::Viewer");
  qRegisterMetaType<EngineFigures>("teren::EngineFigures");
}

}  // namespace

/// What the widget does between events, and what it remembers.
class TerrainWidget::Private {
 public:
  explicit Private(TerrainWidget& owner);

  Result<void> setWorld(const Result<WorldDescription>& next);
  Result<void> setPlugins(std::shared_ptr<const PluginRegistry> next);
  Result<void> makeEngine(std::shared_ptr<const World> newWorld, const EngineOptions& newOptions);
  Result<void> setViewer(const Viewer& next);
  /// Says so, once, where nothing can be drawn.
  void complainWithoutOpenGL();
  /// Says an error through the signal too.
  Result<void> report(Result<void> result) const;

  void makeArea();
  /// What Inventor draws into; nullptr without an area.
  QWidget* canvas() const { return area ? area->getGLWidget() : nullptr; }

  void wake(int frames);
  void work();
  /// True where there is something new to draw.
  bool showEngine();
  void look();
  /// Tells the engine the size of the picture, which detail by error depends on.
  void fitDetail();
  void drawn();
  /// Emits what has changed; the receivers may do anything to the widget, deleting it included.
  void tell(bool resting);

  TerrainWidget& widget;
  std::shared_ptr<const PluginRegistry> plugins = PluginRegistry::standard();
  std::optional<WorldDescription> description;  // the world's
  std::shared_ptr<const World> world;
  EngineOptions options;
  std::chrono::nanoseconds budget = 4ms;
  Viewer viewer;
  std::unique_ptr<Engine> engine;
  EyeAboveGround* eye = nullptr;  // the engine's
  bool showsThisEngine = false;   // whether the scene is one of `engine`
  std::size_t rendererBytes = 0;  // told to the engine
  double toldHeight = 0.0;        // of the eye, in the last positionChanged
  QElapsedTimer sinceFigures;
  int framesToDraw = 0;
  bool complained = false;  // of a missing OpenGL
  QPoint dragFrom;
  TerrainStage stage;
  std::unique_ptr<TerrainArea> area;  // goes before the stage; null where there is no OpenGL
  QTimer timer;
};

TerrainWidget::Private::Private(TerrainWidget& owner) : widget(owner), timer(&owner) {
  timer.setInterval(kBetweenUpdates);
  timer.callOnTimeout(&owner, [this] { work(); });
}

void TerrainWidget::Private::makeArea() {
  // Without OpenGL, SoQt would open a dialog and wait for its end.
  if (QOpenGLContext context; !context.create()) return;
  area = std::make_unique<TerrainArea>(&widget, [this] { drawn(); });
  area->setBackgroundColor(stage.terrain().hazeColor.getValue());
  area->setSceneGraph(stage.root());
  area->show();
}

// --- The world and its engine
// -------------------------------------------------------------------------------------

Result<void> TerrainWidget::Private::setWorld(const Result<WorldDescription>& next) {
  if (!next) return next.error();
  const Result<std::shared_ptr<const World>> made = World::create(*next, *plugins);
  if (!made) return made.error();
  if (const Result<void> shown = makeEngine(*made, options); !shown) return shown;
  description = *next;
  return {};
}

Result<void> TerrainWidget::Private::setPlugins(std::shared_ptr<const PluginRegistry> next) {
  if (!next) return Error{"the plugins are a null pointer, expected a registry"};
  std::swap(plugins, next);
  if (!description) return {};
  Result<void> made = setWorld(*description);
  if (!made) std::swap(plugins, next);
  return made;
}

Result<void> TerrainWidget::Private::makeEngine(std::shared_ptr<const World> newWorld,
                                                const EngineOptions& newOptions) {
  Result<std::unique_ptr<Engine>> made = Engine::create(newWorld, newOptions);
  if (!made) return made.error();
  auto newEye = std::make_unique<EyeAboveGround>(eye == nullptr ? newWorld->mean() : eye->ground());
  eye = newEye.get();
  engine = std::move(*made);
  engine->add(std::move(newEye));
  world = std::move(newWorld);
  options = newOptions;
  showsThisEngine = false;
  rendererBytes = 0;
  look();
  wake(0);
  return {};
}

Result<void> TerrainWidget::Private::setViewer(const Viewer& next) {
  if (const Result<void> checked = check(next); !checked) return checked.error();
  if (next == viewer) return {};
  viewer = next;
  look();
  wake(0);
  toldHeight = widget.eyeHeight();
  Q_EMIT widget.positionChanged(Viewer(next), toldHeight);
  return {};
}

Result<void> TerrainWidget::Private::report(Result<void> result) const {
  if (!result) Q_EMIT widget.errorOccurred(QString::fromStdString(result.error().message));
  return result;
}

void TerrainWidget::Private::complainWithoutOpenGL() {
  if (complained || area) return;
  complained = true;
  Q_EMIT widget.errorOccurred(
      QStringLiteral("OpenGL is not to be had on this display, so no land can be drawn"));
}

// --- Working and resting
// ------------------------------------------------------------------------------------------

void TerrainWidget::Private::wake(int frames) {
  framesToDraw = std::max(framesToDraw, frames);
  if (timer.isActive()) return;  // starting it anew with every move would keep it from ever ending
  if (widget.isVisible() && !widget.window()->isMinimized()) timer.start();
}

void TerrainWidget::Private::work() {
  bool changed = false;
  if (engine) {
    engine->setRendererBytes(rendererBytes);
    fitDetail();
    engine->update(0.0, budget);
    changed = showEngine();
    look();
  }
  if (framesToDraw > 0) {
    --framesToDraw;
    if (area) area->scheduleRedraw();
  }
  const EngineFigures figures = widget.figures();
  const bool resting = framesToDraw == 0 && !changed && figures.pending == 0 && !figures.measuring;
  if (resting) timer.stop();
  tell(resting);
}

bool TerrainWidget::Private::showEngine() {
  const std::shared_ptr<const Scene> next = engine->scene();
  if (next == stage.terrain().scene()) return false;
  // A new engine has nothing to show at first: until then the landscape before it stays.
  if (!showsThisEngine && next->meshes().empty()) return false;
  stage.show(next, showsThisEngine);
  showsThisEngine = true;
  return true;
}

void TerrainWidget::Private::look() {
  if (!engine) return;
  eye->setWater(stage.water());
  eye->put(viewer);
  stage.look(viewer, eye->motion().height, world->pitch());
  ViewSettings view = options.view;
  if (const int drawnRadius = engine->figures().radius; drawnRadius > 0) view.radius = drawnRadius;
  stage.setViewDistance(view.reach(*world));
}

void TerrainWidget::Private::fitDetail() {
  const QWidget* seen = canvas();
  if (!engine->options().view.detail || seen == nullptr || seen->height() < 1) return;
  DetailSettings detail = *engine->options().view.detail;
  detail.lines = std::min(seen->height() * seen->devicePixelRatioF(), DetailSettings::kMostLines);
  detail.fieldOfView = stage.fieldOfView();
  static_cast<void>(engine->setDetail(detail));  // nothing that it could refuse has changed
}

void TerrainWidget::Private::drawn() {
  const std::size_t bytes = stage.terrain().bufferBytes();
  if (bytes == rendererBytes) return;
  rendererBytes = bytes;
  wake(1);  // more may be uploaded with the next frame, and the engine must hear of it
}

void TerrainWidget::Private::tell(bool resting) {
  const QPointer<TerrainWidget> alive(&widget);
  if (!engine) return;
  for (const std::string& sentence : world->takeMessages()) {
    Q_EMIT widget.errorOccurred(QString::fromStdString(sentence));
    if (!alive) return;
  }
  if (widget.eyeHeight() != toldHeight) {
    toldHeight = widget.eyeHeight();
    Q_EMIT widget.positionChanged(Viewer(viewer), toldHeight);
    if (!alive) return;
  }
  if (!resting && sinceFigures.isValid() && sinceFigures.elapsed() < kBetweenFigures) return;
  sinceFigures.start();
  Q_EMIT widget.figuresChanged(widget.figures());
}

// --- The widget
// ---------------------------------------------------------------------------------------------------

TerrainWidget::TerrainWidget(QWidget* parent) : QWidget(parent) {
  startInventor();
  private_ = std::make_unique<Private>(*this);
  private_->makeArea();
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  QWidget* canvas = private_->canvas();
  if (canvas == nullptr) return;
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(private_->area->getWidget());
  canvas->installEventFilter(this);  // after SoQt's own, so it sees the events first
  canvas->setMouseTracking(true);
  canvas->setFocusPolicy(Qt::NoFocus);
}

TerrainWidget::~TerrainWidget() {
  const auto last = std::move(private_);  // null already for the events that come of its end
}

Result<void> TerrainWidget::setWorld(const WorldDescription& description) {
  return private_->report(private_->setWorld(description));
}

Result<void> TerrainWidget::setWorldText(const QString& json) {
  return private_->report(private_->setWorld(WorldDescription::fromJson(json.toStdString(), "the world")));
}

Result<void> TerrainWidget::setWorldFile(const QString& file) {
  return private_->report(private_->setWorld(WorldDescription::fromFile(file.toStdString())));
}

Result<void> TerrainWidget::setPlugins(std::shared_ptr<const PluginRegistry> plugins) {
  return private_->report(private_->setPlugins(std::move(plugins)));
}

std::shared_ptr<const World> TerrainWidget::world() const {
  return private_->world;
}

Result<void> TerrainWidget::setOptions(const EngineOptions& options) {
  if (private_->world) return private_->report(private_->makeEngine(private_->world, options));
  private_->options = options;
  return {};
}

const EngineOptions& TerrainWidget::options() const noexcept {
  return private_->options;
}

void TerrainWidget::setFrameBudget(std::chrono::nanoseconds budget) {
  private_->budget = std::clamp(budget, kLeastBudget, kMostBudget);
}

std::chrono::nanoseconds TerrainWidget::frameBudget() const noexcept {
  return private_->budget;
}

Result<void> TerrainWidget::setViewer(const Viewer& viewer) {
  return private_->report(private_->setViewer(viewer));
}

const Viewer& TerrainWidget::viewer() const noexcept {
  return private_->viewer;
}

double TerrainWidget::eyeHeight() const noexcept {
  return private_->eye == nullptr ? private_->viewer.heightAboveGround : private_->eye->motion().height;
}

std::optional<GroundPoint> TerrainWidget::pick(const QPoint& point) const {
  const QWidget* canvas = private_->canvas();
  if (canvas == nullptr) return std::nullopt;
  const QPoint inside = canvas->mapFrom(this, point);
  if (!canvas->rect().contains(inside)) return std::nullopt;
  const auto width = static_cast<float>(canvas->width()), height = static_cast<float>(canvas->height());
  const SbVec2f place((static_cast<float>(inside.x()) + 0.5F) / width,
                      1.0F - (static_cast<float>(inside.y()) + 0.5F) / height);
  const SbVec2s size(static_cast<short>(canvas->width()), static_cast<short>(canvas->height()));
  if (!private_->engine) return std::nullopt;
  const Ray sight = private_->stage.sight(place, size);
  RayHit hit;
  private_->stage.asDrawn(*private_->engine->sceneQuery()).firstHits({&sight, 1}, {&hit, 1});
  if (hit.end != RayEnd::ground) return std::nullopt;
  const Result<Position> position = sight.from.movedBy(
      hit.way * sight.direction[0], hit.way * sight.direction[1], private_->engine->world().pitch());
  if (!position) return std::nullopt;
  return GroundPoint{*position, sight.height + hit.way * sight.direction[2]};
}

EngineFigures TerrainWidget::figures() const {
  return private_->engine ? private_->engine->figures() : EngineFigures{};
}

SoTerrain& TerrainWidget::terrain() const noexcept {
  return private_->stage.terrain();
}

QSize TerrainWidget::sizeHint() const {
  return {640, 400};
}

// --- Events
// -------------------------------------------------------------------------------------------------------

bool TerrainWidget::event(QEvent* event) {
  const bool handled = QWidget::event(event);
  if (!private_) return handled;  // while it is being made or deleted
  switch (event->type()) {
    case QEvent::Show:
      private_->complainWithoutOpenGL();
      [[fallthrough]];
    case QEvent::ParentChange:
      window()->installEventFilter(this);  // it is told when it is minimized
      private_->wake(kFramesAfterShow);
      break;
    case QEvent::Resize:
      private_->wake(kFramesAfterShow);
      break;
    case QEvent::Hide:
      private_->timer.stop();
      break;
    default:
      break;
  }
  return handled;
}

/// The native window of the canvas gets the mouse; the events belong to the widget.
bool TerrainWidget::eventFilter(QObject* watched, QEvent* event) {
  if (!private_) return QWidget::eventFilter(watched, event);
  QWidget* canvas = private_->canvas();
  if (watched == window() && event->type() == QEvent::WindowStateChange) {
    private_->timer.stop();
    private_->wake(kFramesAfterShow);
  }
  if (watched != canvas) return QWidget::eventFilter(watched, event);
  switch (event->type()) {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonRelease:
    case QEvent::MouseButtonDblClick:
    case QEvent::MouseMove: {
      const auto& mouse = static_cast<const QMouseEvent&>(*event);
      QMouseEvent moved(mouse.type(), canvas->mapTo(this, mouse.pos()), mouse.windowPos(), mouse.screenPos(),
                        mouse.button(), mouse.buttons(), mouse.modifiers(), mouse.source());
      QCoreApplication::sendEvent(this, &moved);
      return true;
    }
    case QEvent::Wheel: {
      const auto& wheel = static_cast<const QWheelEvent&>(*event);
      QWheelEvent moved(canvas->mapTo(this, wheel.position().toPoint()), wheel.globalPosition(),
                        wheel.pixelDelta(), wheel.angleDelta(), wheel.buttons(), wheel.modifiers(),
                        wheel.phase(), wheel.inverted());
      QCoreApplication::sendEvent(this, &moved);
      return true;
    }
    default:
      return QWidget::eventFilter(watched, event);
  }
}

void TerrainWidget::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return event->ignore();
  private_->dragFrom = event->pos();
  setFocus(Qt::MouseFocusReason);
}

void TerrainWidget::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) event->ignore();
}

void TerrainWidget::mouseMoveEvent(QMouseEvent* event) {
  const QPoint here = event->pos();
  if (event->buttons().testFlag(Qt::LeftButton)) {
    const QPoint moved = here - std::exchange(private_->dragFrom, here);
    Viewer next = viewer();
    next.heading = std::remainder(next.heading - kRadiansPerPixel * moved.x(), 2.0 * std::numbers::pi);
    next.pitch = std::clamp(next.pitch + kRadiansPerPixel * moved.y(), -kMostPitch, kMostPitch);
    const QPointer<TerrainWidget> alive(this);
    static_cast<void>(setViewer(next));
    if (!alive) return;
  }
  Q_EMIT cursorMoved(here);
}

void TerrainWidget::wheelEvent(QWheelEvent* event) {
  const QPoint turned = event->angleDelta();
  const double notches = (turned.y() != 0 ? turned.y() : turned.x()) / kWheelNotch;
  Viewer next = viewer();
  if ((event->modifiers() & (Qt::ShiftModifier | Qt::ControlModifier)) != 0) {
    next.heightAboveGround = std::clamp(next.heightAboveGround * std::pow(kClimbFactor, notches),
                                        Viewer::kLowest, Viewer::kHighest);
  } else if (private_->world) {
    const double way = notches * kForwardShare * next.heightAboveGround;
    const Result<Position> there = next.position.movedBy(
        way * std::sin(next.heading), way * std::cos(next.heading), private_->world->pitch());
    if (there) next.position = *there;  // else it is at the end of the world
  }
  static_cast<void>(setViewer(next));
}

}  // namespace teren
