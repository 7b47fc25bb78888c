#include "teren/Engine.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "teren/Parameter.h"
#include "teren/PixelError.h"
#include "teren/ProcessorTime.h"

#include "stream/ObjectSet.h"
#include "stream/SeenVertices.h"
#include "stream/Streamer.h"
#include "world/NodeErrors.h"

namespace teren {

double ViewSettings::reach(const World& world) const noexcept {
  if (detail) return detail->distance;
  return radius * world.pitch() * static_cast<double>(std::int64_t{1} << level);
}

int ViewSettings::radiusFor(double distance, int level, const World& world) noexcept {
  const double side = world.pitch() * static_cast<double>(std::int64_t{1} << level);
  return static_cast<int>(std::clamp(std::ceil(distance / side), 1.0, double{kMostRadius}));
}

namespace {

Error outside(const std::string& what, const std::string& value, const std::string& expected) {
  return Error{what + " is " + value + ", expected " + expected};
}

Error outside(const std::string& what, auto value, const std::string& expected) {
  return outside(what, std::to_string(value), expected);
}

/// NaN is in no range.
Result<void> check(const DetailSettings& detail) {
  const auto isIn = [](double value, double least, double most) { return value >= least && value <= most; };
  if (!isIn(detail.pixelError, DetailSettings::kLeastError, DetailSettings::kMostError)) {
    return outside("the view's pixel error", numberText(detail.pixelError),
                   numberText(DetailSettings::kLeastError) + " to " + numberText(DetailSettings::kMostError) +
                       " pixels");
  }
  if (!(detail.distance > 0.0 && detail.distance <= DetailSettings::kMostDistance)) {
    return outside("the view's distance", numberText(detail.distance),
                   "more than 0 and at most " + numberText(DetailSettings::kMostDistance) + " m");
  }
  if (!isIn(detail.lines, 1.0, DetailSettings::kMostLines)) {
    return outside("the picture's height", numberText(detail.lines),
                   "1 to " + numberText(DetailSettings::kMostLines) + " pixels");
  }
  if (!isIn(detail.fieldOfView, 0.01, 3.0)) {
    return outside("the field of view", numberText(detail.fieldOfView), "0.01 to 3 radians");
  }
  return {};
}

using Views = std::vector<std::optional<DetailSettings>>;

Result<void> check(const EngineOptions& options, const World& world, const Views& others = {}) {
  if (options.view.detail) {
    if (Result<void> checked = check(*options.view.detail); !checked) return checked;
  } else if (options.view.level < 0 || options.view.level > world.topLevel()) {
    return outside("the view's level", options.view.level,
                   "0 to " + std::to_string(world.topLevel()) + ", the world's top level");
  } else if (options.view.radius < 1 || options.view.radius > ViewSettings::kMostRadius) {
    return outside("the view's radius", options.view.radius,
                   "1 to " + std::to_string(ViewSettings::kMostRadius) + " nodes");
  }
  if (options.workers < 0 || options.workers > EngineOptions::kMostWorkers) {
    return outside("the engine's number of workers", options.workers,
                   "0 to " + std::to_string(EngineOptions::kMostWorkers));
  }
  const std::size_t least = std::max(EngineOptions::kLeastCap, Streamer::leastCap(world, options, others));
  if (options.capBytes < least) {
    return outside("the engine's cap", options.capBytes,
                   "at least " + std::to_string(least) + " bytes for this world and view");
  }
  return {};
}

/// Budgets may be as long as a duration can be; less than nothing is nothing.
Slice::Clock::time_point deadlineAfter(Slice::Clock::time_point start, std::chrono::nanoseconds budget) {
  constexpr Slice::Clock::time_point kNever = Slice::Clock::time_point::max();
  if (budget <= std::chrono::nanoseconds{0}) return start;
  return budget < kNever - start ? start + budget : kNever;
}

}  // namespace

struct Engine::State final : Ground {
  State(std::shared_ptr<const World> theWorld, const EngineOptions& theOptions)
      : world(std::move(theWorld)),
        options(theOptions),
        streamer(*world, options),
        objects(world->pitch()),
        scene(
            std::make_shared<const Scene>(0, world->spacing(0), std::vector<std::shared_ptr<const Mesh>>{})),
        query(std::make_shared<const SceneQuery>(scene, world->intervals())) {}

  std::shared_ptr<const World> world;
  EngineOptions options;
  Streamer streamer;
  ObjectSet objects;
  Views views;  // of objects by index
  std::shared_ptr<const Scene> scene;
  mutable std::shared_ptr<const SceneQuery> query;  // of `scene` once somebody has asked
  mutable int queryLevels = 0;                      // whose errors it tells were measured
  DetailEye eye;                                    // the active object, as detail was last chosen for it
  std::chrono::nanoseconds lastUpdate{0};
  /// Snapshots that went with the last publishing. Letting go of them frees what only they had, so where no
  /// time is left that is done when the next budget begins.
  std::vector<std::shared_ptr<const void>> retired;
  std::chrono::nanoseconds publishing{0};  // what it has taken lately, at most: kept free of the budget
  std::chrono::nanoseconds lettingGo{0};   // likewise: done where so much is left of it
  bool measuring = false;

  // Ground
  std::optional<double> height(const Position& position) const override;
  double pitch() const noexcept override { return world->pitch(); }
  std::optional<double> drawnHeight(const Position& position) const;
  std::shared_ptr<const SceneQuery> sceneQuery() const;

  void choose();
  Morph morph() const;
  void publish();
  void letGo();
};

void Engine::State::choose() {
  const std::span<const Motion> motions = objects.motions();
  if (!motions.empty()) eye = {motions[objects.active()].position, motions[objects.active()].height};
  streamer.choose(motions, objects.active());
}

std::shared_ptr<const SceneQuery> Engine::State::sceneQuery() const {
  if (query->scene() != scene || queryLevels != world->nodeErrors().nextToCalibrate()) {
    queryLevels = world->nodeErrors().nextToCalibrate();
    std::vector<float> errors;
    errors.reserve(scene->meshes().size());
    for (const auto& mesh : scene->meshes()) {
      errors.push_back(static_cast<float>(drawnError(*world, *mesh)));
    }
    query = std::make_shared<const SceneQuery>(scene, world->intervals(), errors, query.get());
  }
  return query;
}

/// Of the scene, too: whenever somebody may ask, all that is drawn has been published.
std::optional<double> Engine::State::drawnHeight(const Position& position) const {
  if (!position.valid()) return std::nullopt;
  const Morph& morph = scene->morph();
  if (!SeenVertices::moves(eye, morph)) return streamer.nodes().drawnHeight(position);
  const SeenVertices seen(eye, morph, {0, 0}, world->intervals(), world->spacing(0));
  return streamer.nodes().drawnHeight(position, &seen);
}

std::optional<double> Engine::State::height(const Position& position) const {
  if (!position.valid()) return std::nullopt;
  const std::optional<double> drawn = drawnHeight(position);
  const std::optional<double> finest = streamer.nodes().height(position, 0);
  if (drawn && finest) return std::max(*drawn, *finest);
  return drawn ? drawn : finest;
}

Morph Engine::State::morph() const {
  if (!options.view.detail || streamer.nodes().drawnCount() == 0) return {};
  const DetailSettings& detail = *options.view.detail;
  std::array<double, Morph::kLevels> errors{};
  const std::size_t count = std::min(errors.size(), static_cast<std::size_t>(world->topLevel()) + 1);
  for (std::size_t level = 0; level < count; ++level) {
    errors[level] = world->nodeErrors().estimate(static_cast<int>(level));
  }
  const double lens = lensPixels(detail.lines, detail.fieldOfView);
  return {streamer.pixelError() / lens, std::span(errors).first(count)};
}

void Engine::State::publish() {
  if (streamer.nodes().isExchanging()) return;  // half of it
  const Morph next = morph();
  if (streamer.nodes().serial() == scene->serial() && next == scene->morph()) return;
  const std::chrono::nanoseconds start = threadProcessorTime();
  retired.push_back(scene);
  if (!query->scene()->meshes().empty()) {  // it is not to keep what is drawn no more
    retired.push_back(query);
    query = std::make_shared<const SceneQuery>(query->withoutScene());
  }
  scene = streamer.snapshot(next);
  publishing = std::max(threadProcessorTime() - start, publishing - publishing / 64);
}

void Engine::State::letGo() {
  if (retired.empty() && !streamer.hasOldEdits()) return;
  const std::chrono::nanoseconds start = threadProcessorTime();
  retired.clear();
  streamer.letGoOfOldSnapshots();
  lettingGo = std::max(threadProcessorTime() - start, lettingGo - lettingGo / 64);
}

Engine::Engine(std::unique_ptr<State> state) : state_(std::move(state)) {}
Engine::~Engine() = default;

Result<std::unique_ptr<Engine>> Engine::create(std::shared_ptr<const World> world,
                                               const EngineOptions& options) {
  assert(world);
  if (const Result<void> checked = check(options, *world); !checked) return checked.error();
  return std::unique_ptr<Engine>(new Engine(std::make_unique<State>(std::move(world), options)));
}

const World& Engine::world() const noexcept {
  return *state_->world;
}
const EngineOptions& Engine::options() const noexcept {
  return state_->options;
}
Result<void> Engine::setDetail(const DetailSettings& detail) {
  State& state = *state_;
  if (!state.options.view.detail) return Error{"the view is of one level, so it has no pixel error to set"};
  if (state.options.view.detail == detail) return {};
  EngineOptions options = state.options;
  options.view.detail = detail;
  if (Result<void> checked = check(options, *state.world, state.views); !checked) return checked;
  state.options = options;
  state.streamer.setDetail(detail);
  return {};
}
Result<void> Engine::setView(std::size_t object, const std::optional<DetailSettings>& detail) {
  State& state = *state_;
  if (!state.options.view.detail) return Error{"the view is of one level, so there is one view only"};
  if (object >= state.objects.size()) {
    return outside("the object with a view", object,
                   "less than " + std::to_string(state.objects.size()) + ", the number of objects");
  }
  Views views = state.views;
  views.resize(state.objects.size());
  views[object] = detail;
  if (detail) {
    if (Result<void> checked = check(*detail); !checked) return checked;
    if (Result<void> checked = check(state.options, *state.world, views); !checked) return checked;
  }
  std::size_t count = 1;  // the active object's, which waits meanwhile where it has one of its own
  for (std::size_t index = 0; index < views.size(); ++index) {
    if (index != state.objects.active() && views[index]) ++count;
  }
  if (count > kMostViews) {
    return outside("the number of views", count, "at most " + std::to_string(kMostViews));
  }
  state.streamer.setViews(views);
  state.views = std::move(views);
  return {};
}
Morph Engine::morph(std::size_t object) const noexcept {
  const State& state = *state_;
  const Morph& own = state.scene->morph();
  if (object == state.objects.active() || object >= state.views.size() || !state.views[object]) return own;
  const DetailSettings& view = *state.views[object];
  const double relaxed = state.streamer.pixelError() / state.options.view.detail->pixelError;
  return own.withTolerance(relaxed * view.pixelError / lensPixels(view.lines, view.fieldOfView));
}
void Engine::setEdits(std::shared_ptr<const GroundEdits> edits, std::span<const SampleBox> changed) {
  state_->streamer.setEdits(std::move(edits), changed);
}
void Engine::setRendererBytes(std::size_t bytes) noexcept {
  state_->streamer.setRendererBytes(bytes);
}

Object& Engine::add(std::unique_ptr<Object> object) {
  return state_->objects.add(std::move(object));
}
std::vector<std::unique_ptr<Object>> Engine::takeObjects() {
  state_->views.clear();
  state_->streamer.setViews({});
  return state_->objects.release();
}
std::size_t Engine::objectCount() const noexcept {
  return state_->objects.size();
}
Object& Engine::object(std::size_t index) noexcept {
  return state_->objects.at(index);
}
std::size_t Engine::active() const noexcept {
  return state_->objects.active();
}
void Engine::setActive(std::size_t index) noexcept {
  state_->objects.setActive(index);
}
bool Engine::handle(const InputEvent& event) {
  return state_->objects.handle(event);
}
void Engine::letGo() {
  state_->objects.letGo();
}
std::vector<std::string> Engine::takeMessages() {
  std::vector<std::string> messages = state_->objects.takeMessages();
  for (std::string& message : state_->world->takeMessages()) messages.push_back(std::move(message));
  return messages;
}

void Engine::update(double dt, std::chrono::nanoseconds budget) {
  const Slice::Clock::time_point start = Slice::Clock::now();
  State& state = *state_;
  const bool measured = state.streamer.isMeasuring();
  state.letGo();
  state.objects.advance(dt, state, StoredGround(state.streamer.nodes()));
  state.choose();
  const Slice::Clock::time_point end = deadlineAfter(start, budget);
  state.streamer.work(deadlineAfter(start, budget - std::min(state.publishing, budget / 2)));
  state.publish();
  if (Slice::Clock::now() + state.lettingGo < end) state.letGo();
  // What was found last counts in the next choice, and what was replaced last is still to be let go of.
  state.measuring = measured || state.streamer.isMeasuring() || !state.retired.empty() ||
                    state.streamer.nodes().hasToFree();
  state.lastUpdate = Slice::Clock::now() - start;
}

void Engine::settle(const std::function<bool(std::size_t, std::size_t)>& progress) {
  constexpr std::chrono::milliseconds kBetweenReports(50);
  State& state = *state_;
  Streamer& streamer = state.streamer;
  for (bool settled = false; !settled;) {
    const Slice::Clock::time_point report = Slice::Clock::now() + kBetweenReports;
    do {
      state.choose();
      streamer.work(report);
      state.publish();
      state.letGo();  // there may be no room before
      settled = streamer.isSettled();
      if (!settled) streamer.wait(kBetweenReports);
    } while (!settled && Slice::Clock::now() < report);
    if (progress && !progress(streamer.wanted() - streamer.missing(), streamer.wanted())) return;
  }
}

std::shared_ptr<const Scene> Engine::scene() const noexcept {
  return state_->scene;
}
std::shared_ptr<const SceneQuery> Engine::sceneQuery() const {
  return state_->sceneQuery();
}
std::optional<double> Engine::drawnHeight(const Position& position) const {
  return state_->drawnHeight(position);
}
std::optional<double> Engine::finestHeight(const Position& position) const {
  return position.valid() ? state_->streamer.nodes().height(position, 0) : std::nullopt;
}
const Ground& Engine::ground() const noexcept {
  return *state_;
}

EngineFigures Engine::figures() const noexcept {
  const State& state = *state_;
  const Streamer& streamer = state.streamer;
  EngineFigures figures;
  figures.nodes = streamer.nodes().drawnCount();
  figures.triangles = streamer.nodes().triangles();
  figures.bytes = streamer.bytes();
  figures.peakBytes = std::max(streamer.peakBytes(), figures.bytes);
  figures.radius = streamer.plan().radius;
  figures.pixelError = streamer.pixelError();
  figures.nodesAtLevel = streamer.nodes().drawnAtLevel();
  figures.pending = streamer.missing();
  figures.measuring = state.measuring;
  figures.unfinishedTasks = streamer.unfinished();
  figures.slices = streamer.meter().slices();
  figures.lateSlices = streamer.meter().lateSlices();
  figures.lastUpdate = state.lastUpdate;
  return figures;
}

}  // namespace teren
