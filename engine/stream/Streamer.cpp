#include "stream/Streamer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "patch/BorderTask.h"
#include "patch/ErrorCalibration.h"
#include "patch/NodeGap.h"
#include "patch/NodeTask.h"
#include "world/NodeErrors.h"

namespace teren {

namespace {

constexpr std::size_t kMostMapBytes = std::size_t{32} << 20;
constexpr std::size_t kLeastMapBytes = std::size_t{1} << 20;
constexpr std::size_t kSlack = std::size_t{256} << 10;    // what bytes() estimates, and what it leaves out
constexpr std::size_t kEditsStep = std::size_t{1} << 20;  // of edits: not every stamp asks for another plan
constexpr std::size_t kMostGroundBuilds = 8;
constexpr std::size_t kMostBuildsOfAWorker = 16;
constexpr std::size_t kJoinBatch = 16;   // with workers; without, nodes are joined one by one
constexpr std::size_t kRefinements = 4;  // of four nodes each, likewise
constexpr std::size_t kUnits = 64;       // nodes looked at between two looks at the clock
constexpr int kIdleWorks = 3;            // until what was let go of has been freed

// Detail by error:
constexpr double kChoiceStep = 1.0 / 16.0;  // [pitches] an eye moves before the next choice ...
constexpr double kFewNodes = 500.0;         // ... among so many nodes or fewer; farther where it costs more
constexpr double kChoiceSeconds = 0.1;      // ... or goes in this time, if that is farther
constexpr double kSecondsAhead = 1.0;       // of an eye's way, for which there is to be land too
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

/// Of all views together.
int rootLevel(const World& world, std::span<const DetailSettings> views) {
  int level = 0;
  for (const DetailSettings& detail : views) {
    level = std::max(level, Selection::rootLevelFor(detail.distance, world.pitch(), coarsestRoot(world)));
  }
  return level;
}

/// How many roots lie within the views' distances, at most.
double mostRoots(const World& world, std::span<const DetailSettings> views) {
  const double side = world.pitch() * std::exp2(rootLevel(world, views));
  double roots = 0.0;
  for (const DetailSettings& detail : views) {
    const double across = 2.0 * std::ceil(Selection::kRootsStay * detail.distance / side) + 1.0;
    roots += across * across;
  }
  return roots;
}

/// Without views, of a uniform one of `level`.
std::size_t buildBytes(const World& world, int level, std::span<const DetailSettings> views) {
  const std::size_t ground = NodeTask::mostBytes(world, 0);
  if (views.empty()) return std::max(ground, NodeTask::mostBytes(world, level));
  constexpr bool kWithCoarser = true;  // what vertices move to with distance
  std::size_t most = ground;
  for (int of = rootLevel(world, views); of >= 0; --of) {
    most = std::max(most, NodeTask::mostBytes(world, of, kWithCoarser));
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

/// [bytes] About what a node takes in two cuts and in the lists of who follows them.
constexpr std::size_t kCutBytes = 4 * sizeof(Cut::Node);

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

/// Freed where it is run.
class OldEdits final : public SlicedTask {
 public:
  explicit OldEdits(std::vector<std::shared_ptr<const GroundEdits>> edits) : edits_(std::move(edits)) {}
  bool step(const Slice&) override {
    if (!edits_.empty()) edits_.pop_back();
    return edits_.empty();
  }

 private:
  std::vector<std::shared_ptr<const GroundEdits>> edits_;
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
  range_ = groundRange();
  selection_.emplace(
      Selection::Ground{world.pitch(), range_.low, range_.high, nodeErrors(world), coarsestRoot(world)});
  borderBytes_ = nodes_.borderBytes();
  selectionBytes_ = options.capBytes / nodes_.drawnBytes() * 4 / 3 * kCutBytes;
}

void Streamer::sizeBuilds() {
  std::vector<DetailSettings> views;
  if (options_.view.detail) views.push_back(*options_.view.detail);
  for (const std::optional<DetailSettings>& view : views_) {
    if (view) views.push_back(*view);
  }
  // Roots never become finer again, and what is in flight goes on being counted as it was begun.
  buildBytes_ = std::max(buildBytes_, buildBytes(world_, options_.view.level, views));
  // Tasks in flight may take an eighth of the cap, but there are two at least.
  const std::size_t most = std::max<std::size_t>(2, options_.capBytes / 8 / buildBytes_);
  mostGroundBuilds_ = std::min(kMostGroundBuilds, most / 2);
  const auto workers = static_cast<std::size_t>(options_.workers);
  mostViewBuilds_ = std::clamp<std::size_t>(kMostBuildsOfAWorker * workers, 1, most / 2);
  viewBuilds_ = std::min(leastViewBuilds(), mostViewBuilds_);
}

void Streamer::setDetail(const DetailSettings& detail) {
  assert(options_.view.detail);
  options_.view.detail = detail;
  sizeBuilds();
}

void Streamer::setViews(std::span<const std::optional<DetailSettings>> views) {
  views_.assign(views.begin(), views.end());
  sizeBuilds();
}

std::size_t Streamer::leastCap(const World& world, const EngineOptions& options,
                               std::span<const std::optional<DetailSettings>> others) {
  std::vector<DetailSettings> views;
  if (options.view.detail) views.push_back(*options.view.detail);
  for (const std::optional<DetailSettings>& view : others) {
    if (view) views.push_back(*view);
  }
  const NodeStore nodes(world.spacing(0), world.intervals(), options.view.detail.has_value());
  const std::size_t build = buildBytes(world, options.view.level, views);
  const std::size_t drawn = nodes.drawnBytes() + nodes.piecesBytes();
  constexpr std::size_t kGroundNodes = 9, kUniformNodes = 9;
  const std::size_t view = views.empty() ? kUniformNodes + joinBatch(options.workers)
                                         : static_cast<std::size_t>(mostRoots(world, views));
  return kSlack + std::max(kLeastMapBytes, build) + 2 * build + kGroundNodes * nodes.heldBytes() +
         view * drawn;
}

// ---- Choosing

void Streamer::choose(std::span<const Motion> motions, std::size_t active) {
  if (motions.empty()) return;
  chooseGround(motions);
  if (selection_) {
    chooseDetail(motions, active);
  } else {
    chooseUniform(motions[active].position);
  }
}

bool Streamer::isGroundAsBefore() const {
  return std::equal(ground_.begin(), ground_.end(), wanted_.begin(),
                    wanted_.begin() + static_cast<std::ptrdiff_t>(groundCount_));
}

void Streamer::chooseUniform(const Position& eye) {
  const NodeKey centre = nodeAt(eye, options_.view.level);
  const MemoryPlan next = planMemory(needs(ground_.size()));
  if (centre_ == centre && plan_ == next && isGroundAsBefore()) return;
  centre_ = centre;
  plan_ = next;
  maps_.setCapacity(plan_.mapBytes);
  rank(viewNodes(eye, {options_.view.level, plan_.radius}, world_));
  drops_.clear();
  held_.clear();
  listsHeld_ = true;
  cancelUnwanted();
}

void Streamer::chooseGround(std::span<const Motion> motions) {
  groundLists_.resize(motions.size());
  for (std::size_t index = 0; index < motions.size(); ++index) {
    groundNodes(motions[index], world_, groundOfOne_);
    std::swap(groundLists_[index], groundOfOne_.wanted);
    for (const NodeKey& key : groundOfOne_.passing) {
      if (nodes_.heights(key)) groundLists_[index].push_back(key);
    }
  }
  // Every object's own node first, then what each will reach next. A quarter of the cap is for ground.
  const std::size_t most = std::max(motions.size(), options_.capBytes / 4 / nodes_.heldBytes());
  ground_.clear();
  groundSeen_.clear();
  for (std::size_t k = 0, left = groundLists_.size(); left > 0; ++k) {
    left = 0;
    for (const std::vector<NodeKey>& list : groundLists_) {
      if (k >= list.size()) continue;
      ++left;
      if (ground_.size() < most && groundSeen_.insert(list[k], 0)) ground_.push_back(list[k]);
    }
  }
}

MemoryNeeds Streamer::needs(std::size_t groundNodes) const {
  MemoryNeeds needs;
  needs.cap = options_.capBytes;
  needs.radius = options_.view.radius;
  needs.perNode = nodes_.drawnBytes() + nodes_.piecesBytes();
  const std::size_t edits = (renewal_.editsBytes() + kEditsStep - 1) / kEditsStep * kEditsStep;
  needs.fixed = kSlack + rendererExtra_ + selectionBytes_ + edits + groundNodes * nodes_.heldBytes() +
                (mostViewBuilds_ + mostGroundBuilds_) * buildBytes_ + renewalBytes_ +
                joinBatch(options_.workers) * 2 * nodes_.piecesBytes();
  needs.leastMaps = std::max(kLeastMapBytes, buildBytes_);
  needs.mostMaps = std::max(kMostMapBytes, needs.leastMaps);
  return needs;
}

void Streamer::rank(std::span<const NodeKey> view) {
  wanted_ = ground_;
  groundCount_ = ground_.size();
  ranks_.clear();
  for (std::size_t k = 0; k < wanted_.size(); ++k)
    ranks_.insert(wanted_[k], static_cast<NodeTable::Value>(k));
  for (const NodeKey& key : view) {
    if (ranks_.insert(key, static_cast<NodeTable::Value>(wanted_.size()))) wanted_.push_back(key);
  }
  nextWanted_ = 0;
  toJoin_.clear();
  missing_ = surveyed_ = 0;
  while (surveyed_ < groundCount_) surveyRank(surveyed_++);
}

void Streamer::surveyRank(std::size_t rank) {
  const NodeKey& key = wanted_[rank];
  if (isThere(key)) return;
  ++missing_;
  if (nodes_.heights(key) && !joining_.contains(key)) toJoin_.insert(rank);
}

/// What of a uniform view is missing and what may go: thousands of nodes to be looked at whenever the object
/// comes to another one, which is work like any other. The longest of it, listing them, comes first: then it
/// is far from the deadline.
bool Streamer::surveySome() {
  if (std::exchange(listsHeld_, false)) {
    held_ = nodes_.nodes();
    return true;
  }
  std::size_t unit = 0;
  for (; unit < kUnits && surveyed_ < wanted_.size(); ++unit) surveyRank(surveyed_++);
  if (unit > 0) return true;
  for (; unit < kUnits && !held_.empty(); ++unit, held_.pop_back()) {
    const NodeKey& key = held_.back();
    if (isDrawable(key)) continue;
    if (!ranks_.contains(key) || nodes_.isDrawn(key)) drops_.push_back(key);
  }
  return unit > 0;
}

void Streamer::countMissing() {
  missing_ = static_cast<std::size_t>(
      std::count_if(wanted_.begin(), wanted_.end(), [&](const NodeKey& key) { return !isThere(key); }));
}

bool Streamer::isWanted(const NodeKey& key) const {
  return ranks_.contains(key) || refinement_.isWanted(key);
}

void Streamer::cancelUnwanted() {
  for (auto build = builds_.begin(); build != builds_.end();) {
    if (isWanted(build->first)) {
      ++build;
      continue;
    }
    runner_.cancel(build->second.ticket);
    if (build->second.isGround) --groundBuilds_;
    build = builds_.erase(build);
  }
}

bool Streamer::isDrawable(const NodeKey& key) const {
  return centre_ && mayStay(key, *centre_, {options_.view.level, plan_.radius}, plan_.margin);
}

bool Streamer::isThere(const NodeKey& key) const {
  return isDrawable(key) ? nodes_.isDrawn(key) : static_cast<bool>(nodes_.heights(key));
}

// ---- Detail by error

void Streamer::chooseDetail(std::span<const Motion> motions, std::size_t active) {
  viewers_.clear();
  const auto look = [&](const Motion& eye, const DetailSettings& detail) {
    viewers_.push_back({eye.position, eye.height, detail, kSecondsAhead * eye.east, kSecondsAhead * eye.north,
                        kSecondsAhead * eye.up});
  };
  look(motions[active], *options_.view.detail);
  for (std::size_t index = 0; index < std::min(motions.size(), views_.size()); ++index) {
    if (index != active && views_[index]) look(motions[index], *views_[index]);
  }
  if (isGroundAsBefore()) return;
  drops_.insert(drops_.end(), wanted_.begin(), wanted_.end());
  rank({});
  cancelUnwanted();
}

bool Streamer::isViewedAsBefore() const {
  return std::equal(
      viewers_.begin(), viewers_.end(), chosenFor_.begin(), chosenFor_.end(),
      [&](const Viewer& now, const Viewer& then) {
        if (now.detail != then.detail) return false;
        const Offset way = offset(then.position, now.position, world_.pitch());
        const double up = now.height - then.height;
        const double ahead = std::sqrt(then.east * then.east + then.north * then.north + then.up * then.up);
        const double nodes = std::max(1.0, static_cast<double>(refinement_.wanted()) / kFewNodes);
        const double step =
            std::max(kChoiceStep * world_.pitch() * nodes, kChoiceSeconds / kSecondsAhead * ahead);
        const auto isNear = [&](double east, double north, double above) {
          return east * east + north * north + above * above < step * step;
        };
        return isNear(way.east, way.north, up) &&
               isNear(way.east + now.east - then.east, way.north + now.north - then.north,
                      up + now.up - then.up);
      });
}

bool Streamer::isChosen() const {
  return choosing_ == Choosing::idle && isViewedAsBefore() && needs_ == detailNeeds() &&
         range_ == groundRange() && !learned_ && chosenEdits_ == renewal_.shown() &&
         errorLevels_ == world_.nodeErrors().nextToCalibrate();
}

bool Streamer::chooseSome(const Slice& slice) {
  switch (choosing_) {
    case Choosing::idle:
      if (isChosen()) return false;
      beginChoice();
      break;
    case Choosing::learning:
      learnSome();
      break;
    case Choosing::selecting:
      if (selection_->step(slice)) judgeChoice();
      break;
    case Choosing::turning:
      if (!refinement_.turnStep(slice)) break;
      selection_->keep();
      tolerance_ = tried_;
      choosing_ = Choosing::idle;
      countMissing();
      cancelUnwanted();
  }
  return true;
}

/// Three deviations, and farther where there were heights beyond: summits are what people fly to. In steps,
/// so that not every node asks for another choice.
Streamer::GroundRange Streamer::groundRange() const {
  constexpr double kDeviations = 3.0, kStepsInADeviation = 8.0;
  const double deviation = world_.deviation(), mean = world_.mean();
  const auto away = [&](double measured) {
    if (!(measured > kDeviations * deviation)) return kDeviations * deviation;
    const double step = deviation / kStepsInADeviation;
    return step > 0.0 ? std::ceil(measured / step) * step : measured;
  };
  return {mean - away(mean - static_cast<double>(nodes_.lowest())),
          mean + away(static_cast<double>(nodes_.highest()) - mean)};
}

/// With room for a little more ground than there is, so that not every step of an object asks for another
/// choice.
MemoryNeeds Streamer::detailNeeds() const {
  constexpr std::size_t kGroundSteps = 16;
  return needs((ground_.size() / kGroundSteps + 1) * kGroundSteps);
}

void Streamer::beginChoice() {
  chosenFor_ = viewers_;
  needs_ = detailNeeds();
  range_ = groundRange();
  selection_->setHeights(range_.low, range_.high);
  if (chosenEdits_ && chosenEdits_ != renewal_.shown()) oldEdits_.push_back(chosenEdits_);
  chosenEdits_ = renewal_.shown();
  selection_->setEdits(chosenEdits_);
  if (errorLevels_ != world_.nodeErrors().nextToCalibrate()) beginLearning();
  choosing_ = Choosing::learning;
}

/// Once a level of the world: all nodes are to be looked at.
void Streamer::beginLearning() {
  errorLevels_ = world_.nodeErrors().nextToCalibrate();
  const std::vector<double> errors = nodeErrors(world_);
  selection_->setErrors(errors);
  morph_ = Morph(1.0, errors);
  toLearn_ = nodes_.nodes();
  renewal_.lookAgain();
}

void Streamer::learnSome() {
  for (std::size_t unit = 0; unit < kUnits && !toLearn_.empty(); ++unit, toLearn_.pop_back()) {
    if (nodes_.heights(toLearn_.back())) noteError(toLearn_.back());
  }
  if (!toLearn_.empty()) return;
  learned_ = false;
  tryTolerance(std::max(tolerance_ / kToleranceStep, 1.0), tolerance_ > 1.0 ? kShareToRefine : kShareOfCap);
}

/// Few nodes are rougher than their level's estimate. Such a one is to be split earlier; and where it is off
/// by more than what its vertices begin to move at, as early as the one above it: halfway they would be worse
/// than wanted.
void Streamer::noteError(const NodeKey& key) {
  const auto level = static_cast<std::size_t>(key.level);
  const std::span<const double> usual = selection_->errors();
  const double own = world_.nodeErrors().estimate(key.level, static_cast<double>(nodes_.bend(key)));
  if (key.level == 0 || own <= usual[level]) return;
  const bool moves = level + 1 < std::min(usual.size(), Morph::kLevels);
  const bool isFarOff = moves && own > static_cast<double>(morph_.ranges()[level].error);
  constexpr double kDiagonal = 1.5;  // of a square, at least
  selection_->setError(
      key, {isFarOff ? std::max(own, usual[level + 1]) : own, kDiagonal * world_.spacing(key.level)});
  learned_ = true;
}

void Streamer::tryTolerance(double tolerance, double share) {
  choosing_ = Choosing::selecting;
  tried_ = tolerance;
  share_ = share;
  const std::size_t all = std::numeric_limits<std::size_t>::max();
  selection_->begin(chosenFor_, tolerance, tolerance < kMostTolerance ? mostLeaves(needs_) : all);
}

/// Where even the largest tolerance does not do, there is little more than the roots.
void Streamer::judgeChoice() {
  if (tried_ < kMostTolerance && !(selection_->hasChosen() && fits(needs_, share_))) {
    tryTolerance(std::min(tried_ < tolerance_ ? tolerance_ : tried_ * kToleranceStep, kMostTolerance),
                 kShareOfCap);
    return;
  }
  const std::size_t used = needs_.fixed + detailBytes();
  plan_.mapBytes = std::clamp(needs_.cap - std::min(needs_.cap, used), needs_.leastMaps, needs_.mostMaps);
  maps_.setCapacity(plan_.mapBytes);
  refinement_.turnTo(selection_->chosen());
  choosing_ = Choosing::turning;
}

std::size_t Streamer::detailBytes() const noexcept {
  // About half of what a border on all sides towards finer nodes takes, and as much again in the renderer.
  const std::size_t leaves = selection_->chosen().leaves(), above = selection_->chosen().size() - leaves;
  return leaves * (nodes_.drawnBytes() + nodes_.piecesBytes() + borderBytes_) + above * nodes_.heldBytes();
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

// ---- Edits

/// What is drawn keeps still from when its new pieces are planned until they are shown: then they fit.
bool Streamer::renewSome() {
  if (renewal_.step()) {
    if (!renewal_.isUnderWay()) endRenewal();
    return true;
  }
  if (std::unique_ptr<JoinTask> task = renewal_.takeTask()) {
    renewalTask_ = runner_.submit(std::move(task), kGroundUrgency);
    return true;
  }
  return beginRenewal(false) || planRenewal() || takeRoomForRenewal();
}

/// Somebody who edits all the time is not to keep land from coming: without workers, what else is to be done
/// has as much time after a renewal as that took.
bool Streamer::isTurnOfOthers() const {
  return runner_.workers() == 0 && worked() - renewalEnded_ < renewalEnded_ - renewalBegan_;
}

bool Streamer::beginRenewal(bool isIdle) {
  if (!renewal_.isWaiting() || renewal_.isUnderWay() || (!isIdle && isTurnOfOthers())) return false;
  renewal_.begin();
  renewalBegan_ = worked();
  return true;
}

/// And one join goes first.
bool Streamer::planRenewal() {
  if (!renewal_.isReadyToPlan() || join_ != 0) return false;
  if (joinGoesFirst_) {
    if (startJoin()) {
      joinGoesFirst_ = join_ == 0;
      return true;
    }
    joinGoesFirst_ = false;
  }
  const bool isForced = idleWorks_ >= kIdleWorks;
  if (renewalLacks_ > 0 && !isForced && !hasRoomFor(renewalLacks_)) return giveWay(renewalLacks_);
  renewal_.plan();
  return true;
}

/// Where there is none, room is planned for it from now on, and what is drawn may lessen meanwhile.
bool Streamer::takeRoomForRenewal() {
  if (!renewal_.isPlanned()) return false;
  const std::size_t bytes = 2 * renewal_.plannedBytes();
  if (hasRoomFor(bytes) || idleWorks_ >= kIdleWorks) {
    renewal_.make();
    return true;
  }
  if (giveWay(bytes)) return true;
  renewalBytes_ = std::max(renewalBytes_, bytes);
  renewalLacks_ = bytes;
  renewal_.putOff();
  return true;
}

/// Nothing else is left to be done. If no room is left to be made either, edits go before the cap: they must
/// be shown some time.
bool Streamer::renewIdly() {
  if (!isRenewing() || runner_.unfinished() > 0) return false;
  if (beginRenewal(true)) return true;
  if (renewalLacks_ == 0 || !renewal_.isReadyToPlan() || std::exchange(wasIdle_, true)) return false;
  return ++idleWorks_ >= kIdleWorks;
}

/// By a worker; where there are none, with what was drawn of them (letGoOfOldSnapshots).
bool Streamer::freeOldEdits() {
  for (auto& edits : renewal_.takeOld()) oldEdits_.push_back(std::move(edits));
  if (runner_.workers() == 0 || freeing_ != 0 || oldEdits_.empty()) return false;
  freeing_ = runner_.submit(std::make_unique<OldEdits>(std::exchange(oldEdits_, {})), kJoinUrgency);
  return true;
}

void Streamer::endRenewal() {
  joinGoesFirst_ = true;
  renewalLacks_ = 0;
  if (!renewal_.isWaiting()) renewalBytes_ = 0;  // else the next one lacks as much
  idleWorks_ = 0;
  renewalEnded_ = worked();
  peakMeshBytes_ = std::max(peakMeshBytes_, nodes_.meshBytes());
}

std::chrono::nanoseconds Streamer::worked() const {
  return workedBefore_ + (Slice::Clock::now() - workBegan_);
}

// ---- Working

void Streamer::work(Slice::Clock::time_point deadline) {
  meter_.beginFrame(deadline);
  lacksRoom_ = givesWay_ = wasIdle_ = false;
  changesOneByOne_ = runner_.workers() == 0;
  workBegan_ = Slice::Clock::now();
  feedWorkers();
  workUntilDeadline();
  workedBefore_ = worked();
}

void Streamer::workUntilDeadline() {
  while (meter_.mayStart()) {
    collect();
    if (!meter_.step(housekeeping_)) continue;
    if (runner_.workers() > 0 || !meter_.mayStart() || !runner_.stepHere(meter_)) return;
  }
}

std::size_t Streamer::leastViewBuilds() const noexcept {
  return std::max<std::size_t>(1, 2 * static_cast<std::size_t>(options_.workers));
}

/// As many builds in flight as workers finish from one update to the next, and no more: an object may leap.
void Streamer::feedWorkers() {
  const bool wasFull = std::exchange(isFull_, false);
  if (runner_.workers() == 0 || !wasFull) return;
  const std::size_t left = runner_.unfinished();
  if (left < static_cast<std::size_t>(runner_.workers())) {  // somebody had nothing to do
    viewBuilds_ = std::min(2 * viewBuilds_, mostViewBuilds_);
  } else if (2 * left > viewBuilds_ && viewBuilds_ > leastViewBuilds()) {
    --viewBuilds_;
  }
}

bool Streamer::Housekeeping::step(const Slice& slice) {
  while (streamer_.tidyOne(slice)) {
    if (slice.over()) return false;
  }
  return true;
}

bool Streamer::tidyOne(const Slice& slice) {
  if (freeOldEdits()) return true;
  const bool mayDrop = !drops_.empty() && !(renewal_.isFixing() && nodes_.isDrawn(drops_.back()));
  if (renewal_.isFixing() && renewSome()) {
  } else if (mayDrop) {
    drop(drops_.back());
    drops_.pop_back();
  } else if (const std::optional<NodeKey> unwanted = refinement_.takeUnwanted()) {
    drop(*unwanted);
  } else if (nodes_.freeSome()) {
    if (!nodes_.hasToFree()) lacksRoom_ = false;
  } else if (!arrived_.empty()) {
    integrate(std::move(arrived_.front()));
    arrived_.pop_front();
  } else if (renewSome()) {
  } else if (!(selection_ ? chooseSome(slice) : surveySome()) && !maps_.dropOldest() && !startJoin() &&
             !startBuild() && !startCalibration() && !renewIdly()) {
    return false;
  }
  peakBytes_ = std::max(peakBytes_, bytes());
  return true;
}

void Streamer::drop(const NodeKey& key) {
  if (selection_) {
    if (nodes_.isDrawn(key) || isWanted(key)) return;
    nodes_.erase(key);
    selection_->forgetError(key);
    lacksRoom_ = false;
    return;
  }
  if (nodes_.isDrawn(key)) {
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
  if (finished.ticket == renewalTask_) {
    renewalTask_ = 0;
    renewal_.takeBuilt(std::unique_ptr<JoinTask>(static_cast<JoinTask*>(finished.task.release())));
    return;
  }
  if (finished.ticket == freeing_) {
    freeing_ = 0;
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
  const auto bend = static_cast<float>(largestBend(task.heights().view()));
  nodes_.insert(key, renewal_.edited(key, task.takeHeights(), task.takeCoarser()), bend);
  renewal_.noteInserted(key);
  if (selection_) {
    noteError(key);
    refinement_.noteHeld(key);
    countMissing();
  } else if (!isDrawable(key)) {
    --missing_;
  } else {
    toJoin_.insert(static_cast<std::size_t>(ranks_.find(key)));
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
    const auto isSurveyed = [&](const NodeKey& key) {
      return static_cast<std::size_t>(ranks_.find(key)) < surveyed_;
    };
    missing_ -= static_cast<std::size_t>(std::count_if(nodes.begin(), nodes.end(), isSurveyed));
  } else {  // what they were to be joined with has changed: once more
    for (const NodeKey& key : nodes) {
      if (isWanted(key) && nodes_.heights(key)) toJoin_.insert(static_cast<std::size_t>(ranks_.find(key)));
    }
  }
  peakMeshBytes_ = std::max(peakMeshBytes_, nodes_.meshBytes());
}

void Streamer::change(const DrawnChange& change, std::span<const BuiltPiece> pieces) {
  if (!nodes_.apply(change, pieces)) {
    refinement_.again(change);
    return;
  }
  refinement_.noteChange(change);
  peakMeshBytes_ = std::max(peakMeshBytes_, nodes_.meshBytes());
}

bool Streamer::startRefining() {
  if (lacksRoom_ || !refinement_.mayChange()) return false;
  DrawnChange next = refinement_.next(changesOneByOne_ ? 1 : kRefinements);
  if (next.remove.empty() && next.add.empty()) return true;
  auto task = std::make_unique<JoinTask>(nodes_, std::move(next));
  if (task->pieces().empty()) {
    change(task->change(), {});
    return true;
  }
  if (!hasRoomFor(2 * task->bytes())) {
    refinement_.again(task->change());
    if (giveWay(2 * task->bytes())) return true;
    lacksRoom_ = std::exchange(changesOneByOne_, true);  // one alone may do, and free what others need
    return !lacksRoom_;
  }
  joinBytes_ = task->bytes();
  join_ = runner_.submit(std::move(task), kJoinUrgency);
  return true;
}

bool Streamer::startJoin() {
  if (join_ != 0 || renewal_.isFixing()) return false;
  if (selection_) return startRefining();
  if (toJoin_.empty()) return false;
  const std::size_t count = std::min(joinBatch(options_.workers), toJoin_.size());
  const std::size_t bytes = count * nodes_.piecesBytes();
  if (!hasRoomFor(2 * bytes)) return giveWay(2 * bytes);
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

/// What is wanted but under way; true: there may be more of it.
bool Streamer::passOver() {
  for (std::size_t unit = 0; unit < kUnits; ++unit, ++nextWanted_) {
    if (nextWanted_ == wanted_.size()) return false;
    const NodeKey& key = wanted_[nextWanted_];
    if (!nodes_.heights(key) && !builds_.contains(key)) return false;
  }
  return true;
}

/// Ground first, and all of a uniform view; then what a view by error wants.
std::optional<Streamer::Wish> Streamer::nextWish() {
  if (nextWanted_ < wanted_.size()) {
    const auto rank = static_cast<std::int64_t>(nextWanted_);
    const bool ground = isGround(nextWanted_);
    return Wish{wanted_[nextWanted_], ground ? kGroundUrgency + rank : rank, ground};
  }
  const Cut::Node* node = refinement_.absent();
  for (; node && builds_.contains(node->key); node = refinement_.absent()) refinement_.skipAbsent();
  if (!node) return std::nullopt;
  return Wish{node->key, node->place, false};
}

bool Streamer::startBuild() {
  if (passOver()) return true;
  const std::optional<Wish> wish = nextWish();
  if (!wish) return false;
  if (wish->isGround ? groundBuilds_ >= mostGroundBuilds_ : builds_.size() - groundBuilds_ >= viewBuilds_) {
    isFull_ = true;
    return false;
  }
  if (!hasRoomFor(buildBytes_)) return giveWay(buildBytes_);
  const auto ticket = runner_.submit(
      std::make_unique<NodeTask>(world_, wish->key, maps_, selection_.has_value()), wish->urgency);
  builds_.emplace(wish->key, Build{ticket, wish->isGround});
  if (wish->isGround) ++groundBuilds_;
  return true;
}

bool Streamer::startCalibration() {
  if (calibration_ != 0) return false;
  if (errorsAreKnown(world_)) calibrator_.reset();  // by now, be it through another engine
  if (missing() > 0 || errorsAreKnown(world_)) return false;
  if (!calibrator_) {
    if (!hasRoomFor(calibrationBytes_)) return false;
    calibrator_ = std::make_shared<ErrorCalibration>(world_);
  }
  calibration_ = runner_.submit(std::make_unique<CalibrationSteps>(calibrator_), kCalibrationUrgency);
  return true;
}

bool Streamer::isMeasuring() const {
  if (!selection_ || !isChosen() || missing() > 0 || errorsAreKnown(world_)) return false;
  return calibration_ != 0 || calibrator_ || hasRoomFor(calibrationBytes_);
}

bool Streamer::isSettled() const {
  if (!drops_.empty() || !arrived_.empty() || join_ != 0 || !builds_.empty() || isRenewing()) return false;
  if (nodes_.hasToFree() || freeing_ != 0) return false;
  if (!isSurveyed()) return false;
  if (selection_ && (!isChosen() || refinement_.hasUnwanted() || (refinement_.mayChange() && !lacksRoom_))) {
    return false;
  }
  if (missing() == 0 && !lacksRoom_) return true;
  if (givesWay_) return false;
  // A calibration under way gives its room back.
  return calibration_ == 0 && (lacksRoom_ || !hasRoomFor(std::max(buildBytes_, 2 * nodes_.piecesBytes())));
}

std::size_t Streamer::bytes() const {
  return maps_.bytes() + nodes_.bytes() + rendererBytes_ + builds_.size() * buildBytes_ + joinBytes_ +
         renewal_.bytes() + (selection_ ? selection_->bytes() + refinement_.bytes() : 0) +
         (calibrator_ ? calibrationBytes_ : 0);
}

std::size_t Streamer::lacking(std::size_t more) const {
  const std::size_t renderer = std::max(rendererBytes_, nodes_.meshBytes() + rendererExtra_);
  const std::size_t needed = bytes() - rendererBytes_ + renderer + more;
  return needed - std::min(needed, options_.capBytes);
}

bool Streamer::giveWay(std::size_t to) {
  if (calibrator_ && calibration_ == 0) {  // later
    calibrator_.reset();
    return givesWay_ = true;
  }
  const std::size_t held = maps_.bytes(), least = std::max(kLeastMapBytes, buildBytes_);
  if (held <= least) return false;
  maps_.setCapacity(std::max(least, held - std::min(held, lacking(to))));
  if (!maps_.dropOldest()) return false;
  return givesWay_ = true;
}

void Streamer::letGoOfOldSnapshots() noexcept {
  if (nodes_.letGoOfOldSnapshots()) lacksRoom_ = false;
  if (runner_.workers() == 0) oldEdits_.clear();
}

void Streamer::setRendererBytes(std::size_t bytes) noexcept {
  rendererBytes_ = bytes;
  if (bytes > peakMeshBytes_) rendererExtra_ = std::max(rendererExtra_, bytes - peakMeshBytes_);
}

}  // namespace teren
