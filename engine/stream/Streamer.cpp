#include "stream/Streamer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "patch/BorderTask.h"
#include "patch/ErrorCalibration.h"
#include "patch/NodeTask.h"
#include "stream/Refinement.h"
#include "stream/View.h"
#include "world/NodeErrors.h"

namespace teren {

namespace {

constexpr std::size_t kMostMapBytes = std::size_t{32} << 20;
constexpr std::size_t kLeastMapBytes = std::size_t{1} << 20;
constexpr std::size_t kSlack = std::size_t{256} << 10;  // what bytes() estimates, and what it leaves out
constexpr std::size_t kMostGroundBuilds = 8;
constexpr std::size_t kJoinBatch = 16;   // with workers; without, nodes are joined one by one
constexpr std::size_t kRefinements = 4;  // of four nodes each, likewise

// Detail by error:
constexpr double kChoiceStep = 1.0 / 16.0;  // [pitches] an eye moves before the next choice ...
constexpr double kFewNodes = 500.0;         // ... among so many nodes or fewer; farther where it costs more
constexpr double kToleranceStep = 1.25, kMostTolerance = 1e4;
// The rest of the cap is for what stays drawn until it is replaced. Refined again only where it will fit for
// a while.
constexpr double kShareOfCap = 0.7, kShareToRefine = 0.6;

// Ground under objects goes before everything else, joining nodes before making more of them.
constexpr std::int64_t kGroundUrgency = -(std::int64_t{1} << 40);
constexpr std::int64_t kJoinUrgency = -1;
constexpr std::int64_t kCalibrationUrgency = std::int64_t{1} << 40;  // after all that is wanted

/// The coarsest level of a view's roots: that any of them may lie beside level 0 (BorderTask.h).
int coarsestRoot(const World& world) {
  return std::min(world.topLevel(), mostLevelDifference(world.intervals()));
}

/// How many roots lie within a view's distance, at most.
double mostRoots(const World& world, const DetailSettings& detail) {
  const int level = Selection::rootLevelFor(detail.distance, world.pitch(), coarsestRoot(world));
  const double across = 2.0 * std::ceil(detail.distance / (world.pitch() * std::exp2(level))) + 1.0;
  return across * across;
}

std::size_t buildBytes(const World& world, const ViewSettings& view) {
  const std::size_t ground = NodeTask::mostBytes(world, 0);
  if (!view.detail) return std::max(ground, NodeTask::mostBytes(world, view.level));
  std::size_t most = NodeTask::mostBytes(world, 0, true);
  for (int level = 1;
       level <= Selection::rootLevelFor(view.detail->distance, world.pitch(), coarsestRoot(world)); ++level) {
    most = std::max(most, NodeTask::mostBytes(world, level, true));
  }
  return most;
}

/// [m] By level, as far as they are known by now.
std::vector<double> nodeErrors(const World& world) {
  std::vector<double> errors;
  for (int level = 0; level <= world.topLevel(); ++level)
    errors.push_back(world.nodeErrors().estimate(level));
  return errors;
}

bool errorsAreKnown(const World& world) {
  return world.nodeErrors().nextToCalibrate() > world.topLevel();
}

/// A few steps of a calibration. It is done when nothing else is wanted, and no worker is kept by it when
/// something is again.
class CalibrationSteps final : public SlicedTask {
 public:
  explicit CalibrationSteps(std::shared_ptr<ErrorCalibration> calibration)
      : calibration_(std::move(calibration)) {}
  bool step(const Slice& slice) override { return calibration_->step(slice) || --left_ == 0; }

 private:
  std::shared_ptr<ErrorCalibration> calibration_;
  int left_ = 4;
};

std::size_t joinBatch(int workers) {
  return workers > 0 ? kJoinBatch : 1;
}

}  // namespace

Streamer::Streamer(const World& world, const EngineOptions& options)
    : world_(world),
      options_(options),
      calibrationBytes_(ErrorCalibration::mostBytes(world)),
      maps_(kMostMapBytes),
      nodes_(world.spacing(0), world.intervals(), options.view.detail.has_value()),
      runner_(options.workers) {
  sizeBuilds();
  if (!options.view.detail) return;
  constexpr double kDeviations = 3.0;
  const double range = kDeviations * world.deviation();
  selection_.emplace(Selection::Ground{world.pitch(), world.mean() - range, world.mean() + range,
                                       nodeErrors(world), coarsestRoot(world)});
}

void Streamer::sizeBuilds() {
  buildBytes_ = buildBytes(world_, options_.view);
  // Tasks in flight may take an eighth of the cap, but there are two at least.
  const std::size_t most = std::max<std::size_t>(2, options_.capBytes / 8 / buildBytes_);
  mostGroundBuilds_ = std::min(kMostGroundBuilds, most / 2);
  mostViewBuilds_ = std::clamp<std::size_t>(2 * static_cast<std::size_t>(options_.workers), 1, most / 2);
}

void Streamer::setDetail(const DetailSettings& detail) {
  assert(options_.view.detail);
  options_.view.detail = detail;
  sizeBuilds();
}

std::size_t Streamer::leastCap(const World& world, const EngineOptions& options) {
  const NodeStore nodes(world.spacing(0), world.intervals(), options.view.detail.has_value());
  const std::size_t build = buildBytes(world, options.view);
  const std::size_t drawn = nodes.drawnBytes() + nodes.piecesBytes();
  constexpr std::size_t kGroundNodes = 9, kUniformNodes = 9;
  const std::size_t view = options.view.detail
                               ? static_cast<std::size_t>(mostRoots(world, *options.view.detail))
                               : kUniformNodes + joinBatch(options.workers);
  return kSlack + std::max(kLeastMapBytes, build) + 2 * build + kGroundNodes * nodes.heldBytes() +
         view * drawn;
}

// ---- Choosing

void Streamer::choose(std::span<const Motion> motions, std::size_t active) {
  if (motions.empty()) return;
  const std::vector<NodeKey> ground = chooseGround(motions);
  if (options_.view.detail) {
    chooseDetail(ground, motions[active]);
  } else {
    chooseUniform(ground, motions[active].position);
  }
}

bool Streamer::isGroundAsBefore(const std::vector<NodeKey>& ground) const {
  return std::equal(ground.begin(), ground.end(), wanted_.begin(),
                    wanted_.begin() + static_cast<std::ptrdiff_t>(groundCount_));
}

void Streamer::chooseUniform(const std::vector<NodeKey>& ground, const Position& eye) {
  const NodeKey centre = nodeAt(eye, options_.view.level);
  const MemoryPlan next = planMemory(needs(ground.size()));
  if (centre_ == centre && plan_ == next && isGroundAsBefore(ground)) return;
  centre_ = centre;
  plan_ = next;
  maps_.setCapacity(plan_.mapBytes);
  rank(ground, viewNodes(eye, {options_.view.level, plan_.radius}, world_));
  planDrops();
  cancelUnwanted();
}

bool Streamer::isViewedAsBefore(const Viewer& viewer) const {
  if (!viewer_ || !(viewer_->detail == viewer.detail)) return false;
  const Offset way = offset(viewer_->position, viewer.position, world_.pitch());
  const double up = viewer.height - viewer_->height;
  const double step =
      kChoiceStep * world_.pitch() * std::max(1.0, static_cast<double>(wanted_.size()) / kFewNodes);
  return way.east * way.east + way.north * way.north + up * up < step * step;
}

void Streamer::chooseDetail(const std::vector<NodeKey>& ground, const Motion& eye) {
  const Viewer viewer{eye.position, eye.height, *options_.view.detail};
  const MemoryNeeds now = needs(ground.size());
  std::vector<double> errors = nodeErrors(world_);
  if (isViewedAsBefore(viewer) && needs_ == now && selection_->errors() == errors) {
    if (!isGroundAsBefore(ground)) wantSelected(ground);
    return;
  }
  viewer_ = viewer;
  needs_ = now;
  selection_->setErrors(std::move(errors));
  const auto choose = [&](double tolerance, double share) {
    tolerance_ = tolerance;
    return selection_->choose({&viewer, 1}, tolerance, mostLeaves(now)) && fits(now, share);
  };
  const double before = tolerance_;
  bool chosen = choose(std::max(before / kToleranceStep, 1.0), before > 1.0 ? kShareToRefine : kShareOfCap) ||
                choose(before, kShareOfCap);
  while (!chosen && tolerance_ < kMostTolerance) chosen = choose(tolerance_ * kToleranceStep, kShareOfCap);
  if (!chosen) static_cast<void>(selection_->choose({&viewer, 1}, tolerance_));  // little more than the roots
  selection_->keep();
  const std::size_t used = now.fixed + detailBytes();
  plan_.mapBytes = std::clamp(now.cap - std::min(now.cap, used), now.leastMaps, now.mostMaps);
  maps_.setCapacity(plan_.mapBytes);
  wantSelected(ground);
}

void Streamer::wantSelected(const std::vector<NodeKey>& ground) {
  std::vector<NodeKey> view;
  view.reserve(selection_->nodes().size());
  for (const SelectedNode& node : selection_->nodes()) view.push_back(node.key);
  rank(ground, view);
  planDrops();
  cancelUnwanted();
  mayRefine_ = true;
}

std::size_t Streamer::detailBytes() const noexcept {
  // About half of what a border on all sides towards finer nodes takes, and as much again in the renderer.
  const std::size_t border = nodes_.borderBytes();
  const std::size_t leaves = selection_->leaves(), above = selection_->nodes().size() - leaves;
  return leaves * (nodes_.drawnBytes() + nodes_.piecesBytes() + border) + above * nodes_.heldBytes();
}

std::size_t Streamer::mostLeaves(const MemoryNeeds& needs) const noexcept {
  const std::size_t taken = std::min(needs.cap, needs.fixed + needs.leastMaps);
  return (needs.cap - taken) / nodes_.drawnBytes();
}

bool Streamer::fits(const MemoryNeeds& needs, double share) const noexcept {
  const std::size_t taken = needs.fixed + needs.leastMaps;
  if (taken >= needs.cap) return false;
  return static_cast<double>(detailBytes()) <= share * static_cast<double>(needs.cap - taken);
}

std::vector<NodeKey> Streamer::chooseGround(std::span<const Motion> motions) const {
  std::vector<std::vector<NodeKey>> lists;
  lists.reserve(motions.size());
  for (const Motion& motion : motions) {
    GroundNodes nodes = groundNodes(motion, world_);
    lists.push_back(std::move(nodes.wanted));
    for (const NodeKey& key : nodes.passing) {
      if (nodes_.heights(key)) lists.back().push_back(key);
    }
  }
  // Every object's own node first, then what each will reach next. A quarter of the cap is for ground.
  const std::size_t most = std::max(motions.size(), options_.capBytes / 4 / nodes_.heldBytes());
  std::vector<NodeKey> ground;
  NodeSet seen;
  for (std::size_t k = 0, left = lists.size(); left > 0; ++k) {
    left = 0;
    for (const std::vector<NodeKey>& list : lists) {
      if (k >= list.size()) continue;
      ++left;
      if (ground.size() < most && seen.insert(list[k]).second) ground.push_back(list[k]);
    }
  }
  return ground;
}

MemoryNeeds Streamer::needs(std::size_t groundNodes) const {
  MemoryNeeds needs;
  needs.cap = options_.capBytes;
  needs.radius = options_.view.radius;
  needs.perNode = nodes_.drawnBytes() + nodes_.piecesBytes();
  needs.fixed = kSlack + rendererExtra_ + groundNodes * nodes_.heldBytes() +
                (mostViewBuilds_ + mostGroundBuilds_) * buildBytes_ +
                joinBatch(options_.workers) * 2 * nodes_.piecesBytes();
  needs.leastMaps = std::max(kLeastMapBytes, buildBytes_);
  needs.mostMaps = std::max(kMostMapBytes, needs.leastMaps);
  return needs;
}

void Streamer::rank(const std::vector<NodeKey>& ground, std::span<const NodeKey> view) {
  wanted_ = ground;
  groundCount_ = ground.size();
  ranks_.clear();
  for (std::size_t k = 0; k < wanted_.size(); ++k) ranks_.emplace(wanted_[k], k);
  for (const NodeKey& key : view) {
    if (ranks_.emplace(key, wanted_.size()).second) wanted_.push_back(key);
  }
  nextWanted_ = 0;
  toJoin_.clear();
  countMissing();
  if (selection_) return;
  for (std::size_t k = 0; k < wanted_.size(); ++k) {
    if (!isThere(wanted_[k]) && nodes_.heights(wanted_[k]) && !joining_.contains(wanted_[k]))
      toJoin_.insert(k);
  }
}

void Streamer::countMissing() {
  missing_ = static_cast<std::size_t>(
      std::count_if(wanted_.begin(), wanted_.end(), [&](const NodeKey& key) { return !isThere(key); }));
}

void Streamer::planDrops() {
  drops_.clear();
  for (const NodeKey& key : nodes_.nodes()) {
    if (selection_ ? nodes_.isDrawn(key) : isDrawable(key)) continue;  // with detail, until it is replaced
    if (!ranks_.contains(key) || nodes_.isDrawn(key)) drops_.push_back(key);
  }
}

void Streamer::cancelUnwanted() {
  for (auto build = builds_.begin(); build != builds_.end();) {
    if (ranks_.contains(build->first)) {
      ++build;
      continue;
    }
    runner_.cancel(build->second.ticket);
    if (build->second.isGround) --groundBuilds_;
    build = builds_.erase(build);
  }
}

bool Streamer::isDrawable(const NodeKey& key) const {
  if (selection_) return selection_->isLeaf(key);
  return centre_ && mayStay(key, *centre_, {options_.view.level, plan_.radius}, plan_.margin);
}

bool Streamer::isThere(const NodeKey& key) const {
  return isDrawable(key) ? nodes_.isDrawn(key) : static_cast<bool>(nodes_.heights(key));
}

// ---- Working

void Streamer::work(Slice::Clock::time_point deadline) {
  meter_.beginFrame(deadline);
  mayRefine_ = mayRefine_ || std::exchange(lacksRoom_, false);
  while (meter_.mayStart()) {
    collect();
    if (!meter_.step(housekeeping_)) continue;
    if (runner_.workers() > 0 || !meter_.mayStart() || !runner_.stepHere(meter_)) return;
  }
}

bool Streamer::Housekeeping::step(const Slice& slice) {
  while (streamer_.tidyOne()) {
    if (slice.over()) return false;
  }
  return true;
}

bool Streamer::tidyOne() {
  if (!drops_.empty()) {
    drop(drops_.back());
    drops_.pop_back();
  } else if (!arrived_.empty()) {
    integrate(std::move(arrived_.front()));
    arrived_.pop_front();
  } else if (!maps_.dropOldest() && !startJoin() && !startBuild() && !startCalibration()) {
    return false;
  }
  peakBytes_ = std::max(peakBytes_, bytes());
  return true;
}

void Streamer::drop(const NodeKey& key) {
  if (nodes_.isDrawn(key)) {
    if (selection_) return;  // drawn meanwhile
    [[maybe_unused]] const bool gone = nodes_.apply({{key}, {}}, {});
    assert(gone);  // of one level, so that no other node has a border towards it
  }
  if (!ranks_.contains(key)) nodes_.erase(key);  // else it is ground under an object beyond the view
}

void Streamer::collect() {
  for (TaskRunner::Finished& finished : runner_.takeFinished()) arrived_.push_back(std::move(finished));
}

void Streamer::integrate(TaskRunner::Finished finished) {
  if (finished.ticket == join_) {
    join_ = 0;
    joinBytes_ = 0;
    joining_.clear();
    integrateJoin(static_cast<const JoinTask&>(*finished.task));
    return;
  }
  if (finished.ticket == calibration_) {
    calibration_ = 0;
    if (errorsAreKnown(world_)) calibrator_.reset();
    return;
  }
  auto& task = static_cast<NodeTask&>(*finished.task);
  const NodeKey key = task.key();
  const auto build = builds_.find(key);
  if (build == builds_.end() || build->second.ticket != finished.ticket) return;  // cancelled meanwhile
  if (build->second.isGround) --groundBuilds_;
  builds_.erase(build);
  auto heights = std::make_shared<const HeightMap>(task.takeHeights());
  auto coarser =
      task.coarser().samples().empty() ? nullptr : std::make_shared<const HeightMap>(task.takeCoarser());
  nodes_.insert(key, {std::move(heights), std::move(coarser)});
  mayRefine_ = selection_.has_value();
  if (!isDrawable(key)) {
    --missing_;
  } else if (!selection_) {
    toJoin_.insert(ranks_.at(key));
  }
}

void Streamer::integrateJoin(const JoinTask& task) {
  if (selection_) {
    change(task.change(), task.pieces());
    return;
  }
  const std::vector<NodeKey>& nodes = task.change().add;
  const auto isWanted = [&](const NodeKey& key) { return ranks_.contains(key) && isDrawable(key); };
  if (std::all_of(nodes.begin(), nodes.end(), isWanted) && nodes_.apply(task.change(), task.pieces())) {
    missing_ -= nodes.size();
  } else {  // what they were to be joined with has changed: once more
    for (const NodeKey& key : nodes) {
      if (isWanted(key) && nodes_.heights(key)) toJoin_.insert(ranks_.at(key));
    }
  }
  peakMeshBytes_ = std::max(peakMeshBytes_, nodes_.meshBytes());
}

void Streamer::change(const DrawnChange& change, std::span<const BuiltPiece> pieces) {
  mayRefine_ = true;  // further, or once more
  if (!nodes_.apply(change, pieces)) return;
  for (const NodeKey& key : change.remove) {
    if (!ranks_.contains(key)) drops_.push_back(key);
  }
  countMissing();
  peakMeshBytes_ = std::max(peakMeshBytes_, nodes_.meshBytes());
}

bool Streamer::startRefining() {
  if (!mayRefine_) return false;
  mayRefine_ = false;
  DrawnChange next = nextChange(nodes_, *selection_, runner_.workers() > 0 ? kRefinements : 1);
  if (next.remove.empty() && next.add.empty()) return false;
  auto task = std::make_unique<JoinTask>(nodes_, std::move(next));
  if (task->pieces().empty()) {
    change(task->change(), {});
    return true;
  }
  if (calibration_ == 0 && !hasRoomFor(2 * task->bytes())) calibrator_.reset();  // later
  lacksRoom_ = !hasRoomFor(2 * task->bytes());
  if (lacksRoom_) return false;
  joinBytes_ = task->bytes();
  join_ = runner_.submit(std::move(task), kJoinUrgency);
  return true;
}

bool Streamer::startJoin() {
  if (join_ != 0) return false;
  if (selection_) return startRefining();
  if (toJoin_.empty()) return false;
  const std::size_t count = std::min(joinBatch(options_.workers), toJoin_.size());
  const std::size_t bytes = count * nodes_.piecesBytes();
  if (calibration_ == 0 && !hasRoomFor(2 * bytes)) calibrator_.reset();  // later
  if (!hasRoomFor(2 * bytes)) return false;
  std::vector<NodeKey> batch;
  for (std::size_t k = 0; k < count; ++k) {
    batch.push_back(wanted_[*toJoin_.begin()]);
    toJoin_.erase(toJoin_.begin());
  }
  joining_.insert(batch.begin(), batch.end());
  joinBytes_ = bytes;
  join_ = runner_.submit(std::make_unique<JoinTask>(nodes_, DrawnChange{{}, std::move(batch)}), kJoinUrgency);
  return true;
}

bool Streamer::startBuild() {
  while (nextWanted_ < wanted_.size() &&
         (nodes_.heights(wanted_[nextWanted_]) || builds_.contains(wanted_[nextWanted_]))) {
    ++nextWanted_;
  }
  if (nextWanted_ == wanted_.size()) return false;
  if (calibration_ == 0 && !hasRoomFor(buildBytes_)) calibrator_.reset();  // later
  if (!hasRoomFor(buildBytes_)) return false;
  const bool ground = isGround(nextWanted_);
  if (ground ? groundBuilds_ >= mostGroundBuilds_ : builds_.size() - groundBuilds_ >= mostViewBuilds_) {
    return false;
  }
  const NodeKey& key = wanted_[nextWanted_];
  const auto rank = static_cast<std::int64_t>(nextWanted_);
  const auto ticket = runner_.submit(std::make_unique<NodeTask>(world_, key, maps_, selection_.has_value()),
                                     ground ? kGroundUrgency + rank : rank);
  builds_.emplace(key, Build{ticket, ground});
  if (ground) ++groundBuilds_;
  ++nextWanted_;
  return true;
}

bool Streamer::startCalibration() {
  if (calibration_ != 0) return false;
  if (errorsAreKnown(world_)) calibrator_.reset();  // by now, be it through another engine
  if (missing_ > 0 || errorsAreKnown(world_)) return false;
  if (!calibrator_) {
    if (!hasRoomFor(calibrationBytes_)) return false;
    calibrator_ = std::make_shared<ErrorCalibration>(world_);
  }
  calibration_ = runner_.submit(std::make_unique<CalibrationSteps>(calibrator_), kCalibrationUrgency);
  return true;
}

bool Streamer::isMeasuring() const {
  if (!selection_ || missing_ > 0 || wanted_.empty() || errorsAreKnown(world_)) return false;
  return calibration_ != 0 || calibrator_ || hasRoomFor(calibrationBytes_);
}

bool Streamer::isSettled() const {
  if (!drops_.empty() || !arrived_.empty() || join_ != 0 || !builds_.empty() || mayRefine_) return false;
  if (missing_ == 0 && !lacksRoom_) return true;
  // A calibration under way gives its room back.
  return calibration_ == 0 && (lacksRoom_ || !hasRoomFor(std::max(buildBytes_, 2 * nodes_.piecesBytes())));
}

std::size_t Streamer::bytes() const {
  return maps_.bytes() + nodes_.bytes() + rendererBytes_ + builds_.size() * buildBytes_ + joinBytes_ +
         (calibrator_ ? calibrationBytes_ : 0);
}

bool Streamer::hasRoomFor(std::size_t more) const {
  const std::size_t renderer = std::max(rendererBytes_, nodes_.meshBytes() + rendererExtra_);
  return bytes() - rendererBytes_ + renderer + more <= options_.capBytes;
}

void Streamer::setRendererBytes(std::size_t bytes) noexcept {
  rendererBytes_ = bytes;
  if (bytes > peakMeshBytes_) rendererExtra_ = std::max(rendererExtra_, bytes - peakMeshBytes_);
}

}  // namespace teren
