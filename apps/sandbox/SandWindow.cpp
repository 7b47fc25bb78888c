#include "apps/sandbox/SandWindow.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <utility>

#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <QApplication>
#include <QCloseEvent>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QScrollArea>
#include <QStyle>
#include <QVBoxLayout>

#include "apps/sandbox/SandFile.h"
#include "apps/window/SavedFiles.h"
#include "apps/window/WindowProgram.h"

namespace teren {
namespace {

constexpr std::chrono::milliseconds kWorkBudget(8);  // of a frame at least,
constexpr std::chrono::milliseconds kMostWorkBudget(
    50);  // or as long as drawing takes, but no longer than this
constexpr std::chrono::milliseconds kBetweenIdleTicks(16);
constexpr std::chrono::milliseconds kBetweenFigures(150);
constexpr std::size_t kFramesAtLeast = 4;  // before the first ones the window may still have another size
constexpr std::size_t kFramesShown = 30;   // that the time in the panel looks back
constexpr const char* kOnItsWay = "the sand is still on its way, try again when it is there";
const SbColor kBackground(0.80F, 0.86F, 0.92F);

double seconds(SandWindow::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

SoSeparator* uncached() {
  auto* separator = new SoSeparator;
  separator->renderCaching = SoSeparator::OFF;
  return separator;
}

}  // namespace

SandWindow::SandWindow(SandSession& session, QSize size, bool wireframe)
    : session_(session),
      root_(uncached()),
      eye_(new SoPerspectiveCamera),
      camera_(*eye_),
      area_(new RenderArea(new QWidget(this))),  // it takes its parent's whole size
      wireframe_(wireframe) {
  root_->ref();
  root_->addChild(eye_);
  root_->addChild(scene_.node());
  scene_.setWireframe(wireframe);
  area_->setBackgroundColor(kBackground);
  area_->setSceneGraph(root_);
  layOut(size);
  QWidget* canvas = area_->getGLWidget();
  canvas->setFocusPolicy(Qt::StrongFocus);
  canvas->setMouseTracking(true);
  canvas->installEventFilter(this);  // after SoQt's own, so it sees the events first
  setFocusProxy(canvas);
  timer_.callOnTimeout(this, [this] { tick(); });
}

SandWindow::~SandWindow() {
  delete area_;
  root_->unref();
}

void SandWindow::layOut(QSize size) {
  setWindowTitle(QStringLiteral("Teren - sand"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  auto* both = new QHBoxLayout;
  both->addWidget(area_->getParentWidget(), 1);
  panel_ = new SandPanel(panelActions(), this);
  auto* scrolled = new QScrollArea(this);  // so that the window may be lower than the panel
  scrolled->setWidget(panel_);
  scrolled->setWidgetResizable(true);
  scrolled->setFrameShape(QFrame::NoFrame);
  scrolled->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scrolled->setFixedWidth(panel_->width() + style()->pixelMetric(QStyle::PM_ScrollBarExtent));
  both->addWidget(scrolled);
  layout->addLayout(both, 1);
  auto* help = new QLabel(QString::fromStdString(sandHelp()), this);
  help->setMargin(3);
  help->setWordWrap(true);
  QSizePolicy lines(QSizePolicy::Ignored, QSizePolicy::Fixed);  // as many as the width takes
  lines.setHeightForWidth(true);
  help->setSizePolicy(lines);
  layout->addWidget(help);
  resize(size);
}

SandPanelActions SandWindow::panelActions() {
  SandPanelActions actions;
  actions.takeTool = [this](const Values& values) { takeTool(values); };
  actions.setSand = [this](const Values& values) { setSand(values); };
  actions.makeNewSand = [this](const Values& values) {
    bring([ground = SandGround::from(values)]() -> Result<Sandbox> { return makeSand(ground); });
  };
  actions.undo = [this] { act(SandAction::undo); };
  actions.redo = [this] { act(SandAction::redo); };
  actions.save = [this] { act(SandAction::save); };
  actions.load = [this] { act(SandAction::load); };
  actions.exportObj = [this] { act(SandAction::exportObj); };
  return actions;
}

void SandWindow::begin(const SandScript* script, std::optional<Clock::duration> duration) {
  duration_ = duration;
  beginning_ = session_.arriving();
  if (script != nullptr) player_ = std::make_unique<SandPlayer>(*script, session_, this, std::cout);
  noticeNewSand();
  showState();
  show();
  area_->show();
  setFocus();
  timer_.start(0);
}

// ---- Frames ----

void SandWindow::tick() {
  const Clock::time_point begin = Clock::now();
  if (leaving_ || endAsked() || begin >= end_) return finish();
  compute(begin + std::clamp<Clock::duration>(drawing_, kWorkBudget, kMostWorkBudget));
  publish();
  if (dirty_ || frameTimes_.count() < kFramesAtLeast) draw(begin);
  if (begin - lastFigures_ > kBetweenFigures) {
    lastFigures_ = begin;
    showState();
  }
  const bool resting = settled() && frameTimes_.count() >= kFramesAtLeast;
  timer_.setInterval(resting ? kBetweenIdleTicks : std::chrono::milliseconds(0));
}

/// The script's next slices, or the sand's.
void SandWindow::compute(Clock::time_point until) {
  const auto over = [until] { return Clock::now() >= until; };
  const Clock::time_point begin = Clock::now();
  const bool works = player_ != nullptr || !session_.idle();
  if (beginning_) {
    receiveFirst(over);
  } else if (player_ != nullptr) {
    if (frameTimes_.count() >= kFramesAtLeast) playOn(over);
  } else if (works) {
    session_.work(over);
  }
  if (works) workTimes_.add(1e6 * seconds(Clock::now() - begin));
  for (const std::string& message : session_.takeMessages()) complain(message);
  if (player_ == nullptr && duration_ && end_ == Clock::time_point::max() && !session_.arriving()) {
    end_ = Clock::now() + *duration_;
  }
}

/// The sand that the window begins with; without it there is no sense in going on.
void SandWindow::receiveFirst(const SandSession::Over& over) {
  session_.work([this, &over] { return !session_.arriving() || over(); });
  beginning_ = session_.arriving();
  if (beginning_ || session_.sands() > 0) return;
  for (const std::string& message : session_.takeMessages()) error_ = Error{message};
  failure_ = kWrongInput;
  leaving_ = true;
}

void SandWindow::playOn(const SandPlayer::Over& over) {
  const Result<bool> played = player_->play(over);
  if (played && !*played) return;
  if (!played) {
    error_ = played.error();
    failure_ = player_->failure();
  }
  leaving_ = leaving_ || !played || player_->quits();
  player_.reset();
}

void SandWindow::publish() {
  noticeNewSand();
  if (std::exchange(moisture_, session_.moisture()) != session_.moisture()) {
    scene_.setMoisture(moisture_);
    dirty_ = true;
  }
  std::shared_ptr<const SandSnapshot> now = session_.publish();
  if (now == shown_) return;
  shown_ = std::move(now);
  scene_.show(shown_);
  dirty_ = true;
}

/// Sand that was made or loaded may lie in another box.
void SandWindow::noticeNewSand() {
  if (std::exchange(sands_, session_.sands()) == session_.sands() && shown_ != nullptr) return;
  shown_ = session_.publish();
  const double width = session_.width(), depth = session_.depth();
  const double low = shown_->bounds().low, high = shown_->bounds().high;
  camera_.setBox(0.5 * width, 0.5 * depth, 0.5 * (low + high), std::max({width, depth, high - low}));
  drag_ = Drag::none;
  scene_.show(shown_);
  hideTool();
}

void SandWindow::draw(Clock::time_point begin) {
  dirty_ = false;
  const Clock::time_point drawn = Clock::now();
  area_->render();
  drawing_ = Clock::now() - drawn;
  frameTimes_.add(1e3 * seconds(Clock::now() - begin));
}

void SandWindow::finish() {
  timer_.stop();
  publish();
  for (std::size_t frame = 1; frame < kFramesAtLeast; ++frame) {
    draw(Clock::now());
    QApplication::processEvents();
  }
  lastPicture_ = area_->renderAndRead();
  QApplication::exit(0);
}

/// What the panel shows, and nothing that has not changed: a person may be typing.
void SandWindow::showState() {
  SandFigures figures = session_.figures();
  figures.bytes = bytes();
  panel_->showFigures(figures, frameTimes_.latest(kFramesShown).p50);
  panel_->setEnabled(player_ == nullptr);
  panel_->showTool(session_.toolValues());
  panel_->showSand(sandValues());
  panel_->showProgress(session_.arriving()   ? "making or loading sand ..."
                       : player_ != nullptr  ? "playing the script ..."
                       : figures.waiting > 0 ? std::to_string(figures.waiting) + " stamps wait ..."
                       : !session_.idle()    ? "the sand slides ..."
                                             : "");
}

Values SandWindow::sandValues() const {
  const Values::Entry entries[] = {{"repose", std::clamp(session_.repose(), 1.0, 60.0)},
                                   {"moisture", std::clamp(session_.moisture(), 0.0, 1.0)},
                                   {"slides", session_.slides()},
                                   {"wireframe", wireframe_}};
  return Values::check(sandParameters(), entries, "sand").value();
}

std::size_t SandWindow::bytes() const {
  return session_.figures().bytes + scene_.bufferBytes();
}

// ---- What a script and the panel do ----

void SandWindow::setWireframe(bool on) {
  wireframe_ = on;
  scene_.setWireframe(on);
  dirty_ = true;
}

void SandWindow::setCamera(const Values& values) {
  noticeNewSand();
  camera_.set(values);
  dirty_ = true;
}

Result<void> SandWindow::screenshot(const std::string& file) {
  publish();
  return savePicture(area_->renderAndRead(), file);
}

void SandWindow::takeTool(const Values& values) {
  if (const Result<void> taken = session_.setTool(values); !taken) complain(taken.error().message);
  showState();
  hideTool();
}

void SandWindow::setSand(const Values& values) {
  session_.setRepose(values.real("repose"), values.real("moisture"));
  session_.setSlides(values.boolean("slides"));
  if (values.boolean("wireframe") != wireframe_) setWireframe(!wireframe_);
}

void SandWindow::save(const std::string& file) {
  if (session_.arriving()) return complain(kOnItsWay);
  session_.finishBeat();
  tell(saveSand(file, session_.sandbox()), "saved " + file);
}

void SandWindow::load(const std::string& file) {
  bring([file] { return loadSand(file); });
}

/// In place of what is here, but not of the sand to begin with while that is on its way.
void SandWindow::bring(std::function<Result<Sandbox>()> maker) {
  if (beginning_) return complain(kOnItsWay);
  session_.bring(std::move(maker));
}

void SandWindow::exportTo(const std::string& file) {
  if (session_.arriving()) return complain(kOnItsWay);
  session_.finishBeat();
  tell(exportObj(file, session_.sandbox()), "exported " + file);
}

void SandWindow::tell(const Result<void>& done, const std::string& success) {
  if (done) {
    panel_->say(success);
  } else {
    complain(done.error().message);
  }
}

void SandWindow::complain(const std::string& sentence) {
  std::fprintf(stderr, "teren-sandbox: %s\n", sentence.c_str());
  panel_->say(sentence);
}

void SandWindow::chooseAndSave() {
  const QString file = QFileDialog::getSaveFileName(this, QStringLiteral("Save the sand"));
  if (!file.isEmpty()) save(file.toStdString());
}

void SandWindow::chooseAndLoad() {
  const QString file = QFileDialog::getOpenFileName(this, QStringLiteral("Load sand"));
  if (!file.isEmpty()) load(file.toStdString());
}

void SandWindow::chooseAndExport() {
  const QString file = QFileDialog::getSaveFileName(this, QStringLiteral("Export the surface"), QString(),
                                                    QStringLiteral("Wavefront OBJ (*.obj)"));
  if (!file.isEmpty()) exportTo(file.toStdString());
}

}  // namespace teren
