#include "apps/sandbox/SandSession.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "teren/Hash.h"
#include "teren/ProcessorTime.h"

#include "apps/sandbox/SandTool.h"

namespace teren {
namespace {

constexpr std::uint64_t kStepsPerSlice = 1'000;  // 0.1 to 0.4 ms (Slides.h)
constexpr std::size_t kHistoryBytes = std::size_t{256} << 20;

/// [s] of the thread's processor time.
double now() {
  return std::chrono::duration<double>(threadProcessorTime()).count();
}

void addWord(Fnv1a& hash, std::uint64_t word) {
  for (int byte = 0; byte < 8; ++byte) hash.addByte(static_cast<std::uint8_t>(word >> (8 * byte)));
}

}  // namespace

SandSession::SandSession(const SandGround& ground)
    : sandbox_(std::make_unique<Sandbox>(makeSand(ground))),
      history_(kHistoryBytes),
      toolValues_(Values::defaults(SandTool::parameters())),
      tool_(std::make_shared<const ToolShape>(SandTool::shape(toolValues_).value())) {}

double SandSession::width() const noexcept {
  const LatticeFrame& frame = sandbox_->surface().mesh().frame();
  return frame.width * frame.step;
}

double SandSession::depth() const noexcept {
  const LatticeFrame& frame = sandbox_->surface().mesh().frame();
  return frame.height * frame.step;
}

double SandSession::groundHeight(double x, double y) const noexcept {
  const Triangulation& mesh = sandbox_->surface().mesh();
  const LatticeFrame& frame = mesh.frame();
  return mesh.heightAt(frame.x + std::clamp(x, 0.0, width()), frame.y + std::clamp(y, 0.0, depth()))
      .value_or(0.0);
}

Result<void> SandSession::setTool(const Values& values) {
  Result<ToolShape> shape = SandTool::shape(values);
  if (!shape) return shape.error();
  tool_ = std::make_shared<const ToolShape>(*std::move(shape));
  toolValues_ = values;
  return {};
}

void SandSession::setRepose(double angle, double moisture) {
  finishBeat();
  if (angle == repose() && moisture == this->moisture()) return;
  const bool joins = waiting_.empty() ? held_.has_value() : !waiting_.front().begins;
  if (!joins && !settingNoted_) note();
  settingNoted_ = !joins;
  sandbox_->setRepose(angle, moisture);
}

void SandSession::setSlides(bool on) {
  finishBeat();
  slides_ = on;
}

ToolPlace SandSession::inside(const ToolPlace& place) const noexcept {
  return {std::clamp(place.x, 0.0, width()), std::clamp(place.y, 0.0, depth()), place.height};
}

Result<void> SandSession::check(const ToolPlace& place) const {
  const ToolPlace near = inside(place);
  if (near.x != place.x || near.y != place.y) {
    return Error{"the tool at (" + numberText(place.x) + ", " + numberText(place.y) +
                 ") lies beyond the sand, which is " + numberText(width()) + " x " + numberText(depth()) +
                 " m"};
  }
  if (2.0 * tool_->reach() >= std::min(width(), depth())) {
    return Error{"the tool reaches " + numberText(tool_->reach()) + " m around, too far for sand of " +
                 numberText(width()) + " x " + numberText(depth()) + " m"};
  }
  if (place.height && !(std::fabs(*place.height) <= kHighestTool)) {
    return Error{"a tool's height is " + numberText(*place.height) +
                 ", expected a number from -16000 to 16000 m"};
  }
  return {};
}

Result<void> SandSession::checkRoom(double stamps) const {
  if (stamps > static_cast<double>(kMostStampsOfADrag)) {
    return Error{"a drag from place to place takes " + numberText(std::ceil(stamps)) +
                 " stamps, expected at most " + std::to_string(kMostStampsOfADrag) +
                 "; take a larger tool or go a shorter way"};
  }
  if (static_cast<double>(waiting_.size()) + std::ceil(stamps) > static_cast<double>(kMostWaiting)) {
    return Error{"there are " + std::to_string(waiting_.size()) + " stamps waiting, and more than " +
                 std::to_string(kMostWaiting) + " cannot; take a larger tool or drag less at once"};
  }
  return {};
}

StampPlace SandSession::stampAt(const ToolPlace& place) const noexcept {
  const LatticeFrame& frame = sandbox_->surface().mesh().frame();
  return {frame.x + place.x, frame.y + place.y, place.height.value_or(0.0)};
}

Result<void> SandSession::press(const ToolPlace& place) {
  if (const Result<void> fine = check(place); !fine) return fine;
  if (const Result<void> fine = checkRoom(1.0); !fine) return fine;
  waiting_.push_back({tool_, stampAt(place), place.height.has_value(), true});
  held_ = place;
  return {};
}

Result<void> SandSession::dragTo(const ToolPlace& place, double speed) {
  if (!held_) return {};
  if (const Result<void> fine = check(place); !fine) return fine;
  const double spacing = stampSpacing(speed, *tool_);
  const double x = place.x - held_->x, y = place.y - held_->y;
  const double stamps = std::sqrt(x * x + y * y) / spacing;
  if (stamps < 1.0) return {};
  if (const Result<void> fine = checkRoom(stamps); !fine) return fine;
  for (const StampPlace& stamp : stampsAlong(stampAt(*held_), stampAt(place), spacing)) {
    waiting_.push_back({tool_, stamp, place.height.has_value(), false});
  }
  held_ = place;
  return {};
}

bool SandSession::undo() {
  finishBeat();
  settingNoted_ = false;
  release();
  const auto begun =
      std::find_if(waiting_.rbegin(), waiting_.rend(), [](const Waiting& one) { return one.begins; });
  if (begun != waiting_.rend()) {  // the last action has not begun
    waiting_.erase(begun.base() - 1, waiting_.end());
    return true;
  }
  waiting_.clear();
  return history_.undo(*sandbox_);
}

bool SandSession::redo() {
  finishBeat();
  settingNoted_ = false;
  return waiting_.empty() && history_.redo(*sandbox_);
}

void SandSession::bring(std::function<Result<Sandbox>()> maker) {
  if (arriving()) {
    next_ = std::move(maker);
  } else {
    arriving_ = std::async(std::launch::async, std::move(maker));
  }
}

Result<void> SandSession::await() {
  Result<void> came;
  while (arriving()) came = takeArrived();
  return came;
}

/// Waits for the sand that is made now; what was asked for since is begun then.
Result<void> SandSession::takeArrived() {
  Result<Sandbox> sand = arriving_.get();
  if (next_) bring(std::exchange(next_, nullptr));
  if (!sand) return sand.error();
  adopt(std::move(sand));
  return {};
}

void SandSession::adopt(Result<Sandbox> sand) {
  sandbox_ = std::make_unique<Sandbox>(*std::move(sand));
  replaced_ = true;
  ++sands_;
  history_ = SandHistory(kHistoryBytes);
  waiting_.clear();
  release();
  settingNoted_ = false;
  phase_ = Phase::begin;
  beat_ = 0;
  costs_ = {};
}

bool SandSession::resting() const noexcept {
  return waiting_.empty() && phase_ == Phase::begin && (!slides_ || sandbox_->slides().atRest());
}

void SandSession::work(const Over& over) {
  do {
    arriving() ? receive() : step();
  } while (!idle() && !over());
}

/// Takes the sand that has come, or waits for it a moment.
void SandSession::receive() {
  if (arriving_.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) return;
  if (const Result<void> came = takeArrived(); !came) messages_.push_back(came.error().message);
}

void SandSession::finishBeat() {
  while (withinBeat()) step();
}

void SandSession::step() {
  const double begin = now();
  switch (phase_) {
    case Phase::begin:
      return beginBeat();
    case Phase::sliding: {
      const std::uint64_t steps = std::min(kStepsPerSlice, stepsLeft_);
      const bool atRest = sandbox_->slide(steps);
      stepsLeft_ -= steps;
      slideTime_ += now() - begin;
      if (atRest || stepsLeft_ == 0) phase_ = Phase::cleaning;
      return;
    }
    case Phase::cleaning:
      sandbox_->clean();
      costs_.cleanUp = now() - begin;
      costs_.slide = slideTime_;
      phase_ = Phase::begin;
      ++beat_;
  }
}

void SandSession::beginBeat() {
  if (resting()) return;
  if (!waiting_.empty()) stampNext();
  slideTime_ = 0.0;
  stepsLeft_ = kStepsPerBeat;
  phase_ = slides_ ? Phase::sliding : Phase::cleaning;
}

void SandSession::stampNext() {
  Waiting next = std::move(waiting_.front());
  waiting_.pop_front();
  if (next.begins) {
    note();
    settingNoted_ = false;
    const auto ground = sandbox_->surface().mesh().heightAt(next.place.x, next.place.y);
    heldHeight_ = next.hasHeight ? next.place.height : ground.value_or(0.0);
  }
  if (!next.hasHeight) next.place.height = heldHeight_;
  const Result<StampReport> report = sandbox_->stamp(*next.tool, next.place);
  if (report) {
    costs_.stamp = report->times;
  } else {
    messages_.push_back(report.error().message);
  }
}

void SandSession::note() {
  history_.note(*sandbox_);
}

std::shared_ptr<const SandSnapshot> SandSession::publish() {
  return std::exchange(replaced_, false) ? publisher_.publishAll(*sandbox_) : publisher_.publish(*sandbox_);
}

SandFigures SandSession::figures() const {
  SandFigures figures = costs_;
  const Triangulation& mesh = sandbox_->surface().mesh();
  figures.vertices = mesh.vertexCount();
  figures.triangles = mesh.triangleCount();
  figures.constraints = mesh.constraintCount();
  figures.bytes = sandbox_->bytes() + publisher_.bytes();
  figures.beat = beat_;
  figures.waiting = waiting_.size();
  figures.atRest = sandbox_->slides().atRest();
  return figures;
}

std::vector<std::string> SandSession::takeMessages() {
  return std::exchange(messages_, {});
}

std::uint64_t hashOf(const SandSurface& surface) {
  const Triangulation& mesh = surface.mesh();
  Fnv1a hash;
  for (VertexId v = 0; v < mesh.vertexSlots(); ++v) {
    if (!mesh.isVertex(v)) continue;
    addWord(hash, v);
    addWord(hash,
            static_cast<std::uint64_t>(mesh.point(v).x) << 32 | static_cast<std::uint32_t>(mesh.point(v).y));
    addWord(hash, static_cast<std::uint64_t>(surface.height(v)));
    addWord(hash, static_cast<std::uint64_t>(surface.loose(v)));
  }
  for (TriangleId t = 0; t < mesh.triangleSlots(); ++t) {
    if (!mesh.isTriangle(t)) continue;
    const auto& [a, b, c] = mesh.corners(t);
    addWord(hash, static_cast<std::uint64_t>(a) << 32 | b);
    addWord(hash, c);
  }
  std::uint64_t constraints = 0;  // a sum, because their order says nothing
  mesh.forEachConstraint(
      [&](VertexId a, VertexId b, std::uint32_t id) { constraints += hashWith(hashWith(a, b), id); });
  addWord(hash, constraints);
  return hash.value();
}

}  // namespace teren
