#include "teren/Engine.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "patch/NodeTask.h"
#include "schedule/SliceMeter.h"
#include "stream/NodeStore.h"
#include "stream/View.h"
#include "world/BaseMap.h"

namespace teren {

double ViewSettings::reach(const World& world) const noexcept {
  return radius * world.pitch() * static_cast<double>(std::int64_t{1} << level);
}

int ViewSettings::radiusFor(double distance, int level, const World& world) noexcept {
  const double side = world.pitch() * static_cast<double>(std::int64_t{1} << level);
  return static_cast<int>(std::clamp(std::ceil(distance / side), 1.0, 64.0));
}

namespace {

constexpr int kMostWorkers = 64;
constexpr std::size_t kBaseMapBytes = std::size_t{64} << 20;

/// A node on its way: its heights first, then, if it is to be drawn, the pieces that join it to the drawn
/// set.
class NodeJob {
 public:
  NodeJob(const World& world, const NodeKey& key, BaseMapStore& maps) : key_(key) {
    heights_ = std::make_unique<NodeTask>(world, key, maps);
  }
  /// For a node whose heights are held already.
  explicit NodeJob(const NodeKey& key) : key_(key) {}

  const NodeKey& key() const noexcept { return key_; }

  /// The next task to step, or nullptr when the job is done. `drawable`: its pieces are wanted too.
  SlicedTask* task(NodeStore& nodes, bool drawable) {
    if (heights_) return heights_.get();
    if (!drawable) return nullptr;
    if (!begun_) {
      wanted_ = nodes.piecesToDraw(key_);
      begun_ = true;
    }
    if (built_.size() == wanted_.size()) return nullptr;
    if (!piece_) piece_ = nodes.makePiece(wanted_[built_.size()]);
    return piece_.get();
  }

  /// The task just given out is done.
  void finishTask(NodeStore& nodes) {
    if (heights_) {
      nodes.insert(key_, std::make_shared<const HeightMap>(heights_->takeHeights()));
      heights_.reset();
      return;
    }
    built_.emplace_back(wanted_[built_.size()], piece_->result());
    piece_.reset();
  }

  /// The drawn set has changed: pieces are chosen anew.
  void restartPieces() {
    begun_ = false;
    wanted_.clear();
    built_.clear();
    piece_.reset();
  }

  /// Once task() has returned nullptr for a drawable node.
  void draw(NodeStore& nodes) const { nodes.draw(key_, built_); }

 private:
  NodeKey key_;
  std::unique_ptr<NodeTask> heights_;
  bool begun_ = false;
  std::vector<PieceName> wanted_;
  std::vector<std::pair<PieceName, std::shared_ptr<const Mesh>>> built_;
  std::unique_ptr<MeshTask> piece_;
};

}  // namespace

struct Engine::State final : Ground {
  State(std::shared_ptr<const World> theWorld, const EngineOptions& theOptions)
      : world(std::move(theWorld)),
        options(theOptions),
        view(theOptions.view),
        maps(kBaseMapBytes),
        nodes(world->spacing(0), world->intervals()),
        scene(std::make_shared<const Scene>(0, world->spacing(0),
                                            std::vector<std::shared_ptr<const Mesh>>{})) {}

  std::shared_ptr<const World> world;
  EngineOptions options;
  ViewSettings view;
  BaseMapStore maps;
  NodeStore nodes;
  SliceMeter meter;
  std::size_t rendererBytes = 0, peakBytes = 0;
  std::vector<std::unique_ptr<Object>> objects;
  std::size_t active = 0;
  std::shared_ptr<const Scene> scene;
  std::size_t sceneTriangles = 0;
  std::chrono::nanoseconds lastUpdate{0};

  std::optional<NodeKey> viewCentre;  // the view's node under the active object
  std::vector<NodeKey> groundWanted;  // level-0 nodes under all objects
  std::vector<NodeKey> wanted;        // most urgent first; those not there yet are worked at in this order
  std::size_t nextWanted = 0;
  std::unique_ptr<NodeJob> job;

  // Ground
  std::optional<double> height(const Position& position) const override;
  double pitch() const noexcept override { return world->pitch(); }
  std::optional<double> drawnHeight(const Position& position) const;

  bool isThere(const NodeKey& key, bool drawable) const {
    return drawable ? nodes.isDrawn(key) : nodes.heights(key) != nullptr;
  }
  /// Nodes of the view's level are drawn; ground under objects is only kept (unless the view is of level 0).
  bool isDrawable(const NodeKey& key) const { return viewCentre && mayStay(key, *viewCentre, view); }
  /// Whether what is wanted has changed.
  bool chooseNodes();
  void dropNodes();
  bool startJob();
  void work();
  void finishJob();
  void publish();
  std::size_t pending() const;
  std::size_t bytes() const { return maps.bytes() + nodes.bytes() + rendererBytes; }
};

std::optional<double> Engine::State::drawnHeight(const Position& position) const {
  return nodes.isDrawn(nodeAt(position, view.level)) ? nodes.height(position, view.level) : std::nullopt;
}

std::optional<double> Engine::State::height(const Position& position) const {
  const std::optional<double> drawn = drawnHeight(position);
  const std::optional<double> finest = nodes.height(position, 0);
  if (drawn && finest) return std::max(*drawn, *finest);
  return drawn ? drawn : finest;
}

bool Engine::State::chooseNodes() {
  if (objects.empty()) return false;
  std::vector<NodeKey> ground;
  for (const auto& object : objects) {
    const std::vector<NodeKey> under = groundNodes(object->motion(), *world);
    ground.insert(ground.end(), under.begin(), under.end());
  }
  const Position eye = objects[active]->motion().position;
  const NodeKey centre = nodeAt(eye, view.level);
  if (viewCentre == centre && groundWanted == ground) return false;
  viewCentre = centre;
  groundWanted = ground;
  wanted.clear();
  nextWanted = 0;
  std::unordered_set<NodeKey, NodeKeyHash> seen;
  const auto want = [&](const std::vector<NodeKey>& keys) {
    for (const NodeKey& key : keys) {
      if (seen.insert(key).second) wanted.push_back(key);
    }
  };
  want(ground);
  want(viewNodes(eye, view, *world));
  return true;
}

void Engine::State::dropNodes() {
  const std::uint64_t before = nodes.serial();
  const std::unordered_set<NodeKey, NodeKeyHash> keep(wanted.begin(), wanted.end());
  for (const NodeKey& key : nodes.nodes()) {
    if (isDrawable(key)) continue;
    if (keep.contains(key)) {
      nodes.undraw(key);  // ground under an object beyond the view
    } else {
      nodes.erase(key);
    }
  }
  if (!job) return;
  if (!keep.contains(job->key())) {
    job.reset();
  } else if (nodes.serial() != before) {
    job->restartPieces();
  }
}

bool Engine::State::startJob() {
  if (job) return true;
  for (; nextWanted < wanted.size(); ++nextWanted) {
    const NodeKey& key = wanted[nextWanted];
    if (isThere(key, isDrawable(key))) continue;
    job = nodes.heights(key) ? std::make_unique<NodeJob>(key) : std::make_unique<NodeJob>(*world, key, maps);
    return true;
  }
  return false;
}

void Engine::State::finishJob() {
  if (isDrawable(job->key())) job->draw(nodes);
  job.reset();
}

void Engine::State::work() {
  while (meter.mayStart() && startJob()) {
    SlicedTask* task = job->task(nodes, isDrawable(job->key()));
    if (!task) {
      finishJob();
    } else if (meter.step(*task)) {
      job->finishTask(nodes);
    }
  }
}

void Engine::State::publish() {
  peakBytes = std::max(peakBytes, bytes());
  if (nodes.serial() == scene->serial()) return;
  scene = nodes.snapshot();
  sceneTriangles = scene->triangles();
}

std::size_t Engine::State::pending() const {
  return static_cast<std::size_t>(std::count_if(
      wanted.begin(), wanted.end(), [&](const NodeKey& key) { return !isThere(key, isDrawable(key)); }));
}

Engine::Engine(std::unique_ptr<State> state) : state_(std::move(state)) {}
Engine::~Engine() = default;

Result<std::unique_ptr<Engine>> Engine::create(std::shared_ptr<const World> world,
                                               const EngineOptions& options) {
  assert(world);
  const ViewSettings& view = options.view;
  if (view.level < 0 || view.level > world->topLevel()) {
    return Error{"the view's level is " + std::to_string(view.level) + ", expected 0 to " +
                 std::to_string(world->topLevel()) + ", the world's top level"};
  }
  if (view.radius < 1 || view.radius > 64) {
    return Error{"the view's radius is " + std::to_string(view.radius) + " nodes, expected 1 to 64"};
  }
  if (options.workers < 0 || options.workers > kMostWorkers) {
    return Error{"the engine's workers are " + std::to_string(options.workers) + ", expected 0 to 64"};
  }
  if (options.capBytes < EngineOptions::kLeastCap) {
    return Error{"the engine's cap is " + std::to_string(options.capBytes) + " bytes, expected at least " +
                 std::to_string(EngineOptions::kLeastCap)};
  }
  return std::unique_ptr<Engine>(new Engine(std::make_unique<State>(std::move(world), options)));
}

const World& Engine::world() const noexcept {
  return *state_->world;
}
const EngineOptions& Engine::options() const noexcept {
  return state_->options;
}
void Engine::setRendererBytes(std::size_t bytes) noexcept {
  state_->rendererBytes = bytes;
}

Object& Engine::add(std::unique_ptr<Object> object) {
  assert(object);
  state_->objects.push_back(std::move(object));
  return *state_->objects.back();
}
std::size_t Engine::objectCount() const noexcept {
  return state_->objects.size();
}
Object& Engine::object(std::size_t index) noexcept {
  assert(index < state_->objects.size());
  return *state_->objects[index];
}
std::size_t Engine::active() const noexcept {
  return state_->active;
}
void Engine::setActive(std::size_t index) noexcept {
  assert(index < state_->objects.size());
  state_->active = index;
}

void Engine::update(double dt, std::chrono::nanoseconds budget) {
  const Slice::Clock::time_point start = Slice::Clock::now();
  State& state = *state_;
  for (const auto& object : state.objects) object->update(dt, state);
  state.meter.beginFrame(start + budget);
  if (state.chooseNodes()) state.dropNodes();
  state.work();
  state.publish();
  state.lastUpdate = Slice::Clock::now() - start;
}

void Engine::settle(const std::function<bool(std::size_t, std::size_t)>& progress) {
  constexpr std::chrono::milliseconds kBetweenReports(50);
  State& state = *state_;
  for (;;) {
    state.meter.beginFrame(Slice::Clock::now() + kBetweenReports);
    if (state.chooseNodes()) state.dropNodes();
    state.work();
    state.publish();
    const std::size_t left = state.pending();
    if (progress && !progress(state.wanted.size() - left, state.wanted.size())) return;
    if (left == 0) return;
  }
}

std::shared_ptr<const Scene> Engine::scene() const noexcept {
  return state_->scene;
}
std::optional<double> Engine::drawnHeight(const Position& position) const {
  return state_->drawnHeight(position);
}
const Ground& Engine::ground() const noexcept {
  return *state_;
}

EngineFigures Engine::figures() const noexcept {
  const State& state = *state_;
  EngineFigures figures;
  figures.nodes = state.nodes.drawnCount();
  figures.triangles = state.sceneTriangles;
  figures.bytes = state.bytes();
  figures.peakBytes = state.peakBytes;
  figures.radius = state.view.radius;
  figures.pending = state.pending();
  figures.slices = state.meter.slices();
  figures.lateSlices = state.meter.lateSlices();
  figures.lastUpdate = state.lastUpdate;
  return figures;
}

}  // namespace teren
