#include "stream/GroundRenewal.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "world/NodeErrors.h"

namespace teren {

namespace {

constexpr double kMovedInVain = 0.125;  // of a level's error: less by edits is not seen in how vertices move
constexpr std::int64_t kTile = 8;       // [patches] across, of the changed boxes, looked at once

std::shared_ptr<const HeightMap> shared(HeightMap map) {
  return map.samples().empty() ? nullptr : std::make_shared<const HeightMap>(std::move(map));
}

std::int64_t extent(const SampleBox& box) noexcept {
  return (box.east - box.west) + (box.north - box.south);
}

}  // namespace

void GroundRenewal::setEdits(std::shared_ptr<const GroundEdits> edits, std::span<const SampleBox> changed) {
  assert(edits);
  if (next_) old_.push_back(std::move(next_));
  next_ = std::move(edits);
  nextBytes_ = next_->bytes();  // asked for once: it looks through all of them
  for (const SampleBox& box : changed) noteChanged(box);
}

void GroundRenewal::lookAgain() {
  if (!next_) {
    next_ = coming_ ? coming_ : shown_;
    nextBytes_ = coming_ ? comingBytes_ : shownBytes_;
  }
  looksAgain_ = next_ != nullptr;
}

/// Edits that come faster than they can be shown change mostly the same places, or ones near by: looking for
/// what sees them must not take longer the longer it takes.
void GroundRenewal::noteChanged(const SampleBox& box) {
  constexpr std::size_t kMostBoxes = 64;
  const auto isKnown = [&](const SampleBox& known) { return known.joinedWith(box) == known; };
  if (std::any_of(nextChanged_.begin(), nextChanged_.end(), isKnown)) return;
  if (nextChanged_.size() < kMostBoxes) {
    nextChanged_.push_back(box);
  } else {
    const auto growth = [&](const SampleBox& known) { return extent(known.joinedWith(box)) - extent(known); };
    SampleBox& nearest = *std::ranges::min_element(nextChanged_, {}, growth);
    nearest = nearest.joinedWith(box);
  }
}

EditedNode GroundRenewal::edited(const NodeKey& key, HeightMap own, HeightMap coarser) const {
  return edited(key, std::move(own), std::move(coarser), shown_.get());
}

/// Where the level above misses what edits have made of the ground by more than this level misses the ground
/// anyhow, vertices stay where they are.
EditedNode GroundRenewal::edited(const NodeKey& key, HeightMap own, HeightMap coarser,
                                 const GroundEdits* edits) const {
  if (edits == nullptr) return {{shared(std::move(own)), shared(std::move(coarser))}};
  const std::int64_t n = world_.intervals();
  edits->overlay(key.level, key.i * n, key.j * n, own.view());
  if (!coarser.samples().empty()) {  // from one coarser sample beyond the node's corner on
    edits->overlay(key.level + 1, key.i * n / 2 - 1, key.j * n / 2 - 1, coarser.view());
  }
  const bool stays = this->stays(key, *edits);
  const double moved = key.level > 0 ? edits->moved(key.level, key.i, key.j) : 0.0;
  return {{shared(std::move(own)), shared(std::move(coarser)), stays}, static_cast<float>(moved)};
}

bool GroundRenewal::stays(const NodeKey& key, const GroundEdits& edits) const {
  const NodeKey above = key.parent();
  return edits.moved(above.level, above.i, above.j) > kMovedInVain * world_.nodeErrors().estimate(key.level);
}

/// Edits beside a node, but in the one above it, may change how its vertices move.
bool GroundRenewal::staysOtherwise(const NodeKey& key) const {
  const NodeHeights held = nodes_.heights(key);
  const bool stays = held.coarser() == nullptr;
  return held.keptCoarser() != nullptr && stays != this->stays(key, *coming_);
}

/// It has the heights of the edits before.
void GroundRenewal::noteInserted(const NodeKey& key) {
  assert(stage_ < Stage::exchanging);
  if (isUnderWay()) stale_.push_back(key);
}

void GroundRenewal::begin() {
  assert(!isUnderWay() && isWaiting());
  coming_ = std::exchange(next_, nullptr);
  comingBytes_ = std::exchange(nextBytes_, 0);
  changed_.swap(nextChanged_);
  if (std::exchange(looksAgain_, false)) toLookAt_ = nodes_.nodes();
  stage_ = Stage::finding;
}

bool GroundRenewal::step() {
  // What was inserted while pieces are planned or built is not drawn.
  if (!stale_.empty() && stage_ < Stage::exchanging) {
    overlayOne();
    return true;
  }
  switch (stage_) {
    case Stage::finding:
      findSome();
      return true;
    case Stage::planning:
      planOne();
      return true;
    case Stage::making:
      makeOne();
      return true;
    case Stage::exchanging:
      exchangeOne();
      return true;
    case Stage::settling:
      settleOne();
      return true;
    case Stage::clearing:
      clearSome();
      return true;
    case Stage::idle:
    case Stage::overlaying:
    case Stage::planned:
    case Stage::made:
    case Stage::building:
      return false;
  }
  return false;
}

/// A tile of a box at a time; of a very large one, which mostly nothing is held of, a larger tile.
void GroundRenewal::findSome() {
  constexpr std::size_t kNodes = 16;
  for (std::size_t k = 0; k < kNodes && !toLookAt_.empty(); ++k, toLookAt_.pop_back()) {
    const NodeKey& key = toLookAt_.back();
    if (nodes_.heights(key) && staysOtherwise(key) && found_.insert(key).second) stale_.push_back(key);
  }
  if (!toLookAt_.empty()) return;
  if (changed_.empty()) {
    stage_ = Stage::overlaying;
    return;
  }
  SampleBox& left = changed_.front();
  constexpr std::int64_t kMostTiles = 64;  // along a side, about
  const std::int64_t across = std::max(kTile * world_.intervals(), extent(left) / kMostTiles);
  SampleBox tile = left;
  if (tile.east - tile.west > across) {
    tile.east = tile.west + across;
    changed_.push_back({tile.east, left.south, left.east, left.north});
    left.east = tile.east;
    return;
  }
  tile.north = std::min(tile.north, tile.south + across);
  left.south = tile.north;
  const bool isLast = tile.north == left.north;
  nodes_.forEachSeeing(tile, world_.topLevel(), [&](const NodeKey& key, bool sees) {
    if ((sees || staysOtherwise(key)) && found_.insert(key).second) stale_.push_back(key);
  });
  if (isLast) changed_.pop_front();
}

void GroundRenewal::overlayOne() {
  const NodeKey key = stale_.back();
  stale_.pop_back();
  const NodeHeights held = nodes_.heights(key);
  if (!held) return;  // it has gone meanwhile
  nodes_.come(key, edited(key, *held, held.keptCoarser() ? *held.keptCoarser() : HeightMap(), coming_.get()));
  renewed_.push_back(key);
}

void GroundRenewal::plan() {
  assert(isReadyToPlan());
  stage_ = Stage::planning;
  nextRenewed_ = 0;
  pieceBytes_ = 0;
}

void GroundRenewal::planOne() {
  if (isPutOff_) {
    forgetSome();
    return;
  }
  if (!affected_.empty()) {
    pieceBytes_ += nodes_.planComing(affected_.back(), plans_);
    affected_.pop_back();
    return;
  }
  if (nextRenewed_ == renewed_.size()) {
    pieces_ = left_ = plans_.size();
    stage_ = Stage::planned;
    return;
  }
  const NodeKey& key = renewed_[nextRenewed_++];
  if (!nodes_.isDrawn(key)) return;
  for (const NodeKey& other : nodes_.drawnAround(key)) {
    if (seen_.insert(other).second) affected_.push_back(other);
  }
}

void GroundRenewal::putOff() {
  assert(isPlanned());
  stage_ = Stage::overlaying;
  isPutOff_ = true;
}

/// What was planned before it was put off.
void GroundRenewal::forgetSome() {
  constexpr int kPlans = 64;
  for (int k = 0; k < kPlans && !plans_.empty(); ++k) plans_.pop_back();
  if (!plans_.empty()) return;
  eraseSome(seen_);
  isPutOff_ = !seen_.empty();
}

void GroundRenewal::eraseSome(NodeSet& keys) {
  constexpr int kKeys = 64;
  for (int k = 0; k < kKeys && !keys.empty(); ++k) keys.erase(keys.begin());
}

void GroundRenewal::make() {
  assert(isPlanned());
  task_ = std::make_unique<JoinTask>();
  stage_ = plans_.empty() ? Stage::exchanging : Stage::making;
}

void GroundRenewal::makeOne() {
  auto task = nodes_.makeComing(plans_.back());
  task_->add(std::move(plans_.back()), std::move(task));
  plans_.pop_back();
  if (plans_.empty()) stage_ = Stage::made;
}

std::unique_ptr<JoinTask> GroundRenewal::takeTask() {
  if (stage_ != Stage::made) return nullptr;
  stage_ = Stage::building;
  return std::move(task_);
}

void GroundRenewal::takeBuilt(std::unique_ptr<JoinTask> built) {
  assert(isBuilding());
  task_ = std::move(built);
  stage_ = Stage::exchanging;
}

void GroundRenewal::exchangeOne() {
  if (!stale_.empty()) {
    overlayOne();
  } else if (std::optional<BuiltPiece> piece = task_->takePiece()) {
    nodes_.exchange(*std::move(piece));
    --left_;
  } else {
    nodes_.showComing();
    if (shown_) old_.push_back(std::move(shown_));
    shown_ = std::move(coming_);
    coming_ = nullptr;
    shownBytes_ = std::exchange(comingBytes_, 0);
    stage_ = Stage::settling;
  }
}

void GroundRenewal::settleOne() {
  if (nodes_.settleOne()) return;
  task_.reset();
  stage_ = Stage::clearing;
}

void GroundRenewal::clearSome() {
  for (NodeSet* keys : {&found_, &seen_}) {
    eraseSome(*keys);
    if (!keys->empty()) return;
  }
  renewed_.clear();
  pieces_ = left_ = pieceBytes_ = 0;
  stage_ = Stage::idle;
}

std::size_t GroundRenewal::bytes() const noexcept {
  const std::size_t built =
      stage_ >= Stage::making && pieces_ > 0 ? pieceBytes_ / pieces_ * left_ : std::size_t{0};
  return editsBytes() + built;
}

}  // namespace teren
