#include "stream/Selection.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "teren/DetailThreshold.h"
#include "teren/PixelError.h"

#include "stream/View.h"

namespace teren {

namespace {

constexpr std::size_t kUnits = 32;       // nodes between two looks at the clock ...
constexpr std::size_t kSorts = 256;      // ... while they are sorted
constexpr double kBeforeAllElse = 1e18;  // urgency of roots: no error is seen as large

/// How far a coordinate lies from an interval.
double away(double low, double high) noexcept {
  return std::max({low, -high, 0.0});
}

}  // namespace

Selection::Selection(Ground ground) : ground_(std::move(ground)), split_(ground_.errors.size()) {
  for (std::size_t level = 0; level < ground_.errors.size(); ++level) {
    sides_.push_back(ground_.pitch * std::exp2(static_cast<double>(level)));
  }
}

int Selection::rootLevelFor(double distance, double pitch, int topLevel) noexcept {
  int level = 0;
  while (level < topLevel && pitch * std::exp2(level + 1) <= 0.5 * distance) ++level;
  return level;
}

// ---- What is seen

double Selection::squaredAcross(const Eye& eye, const NodeKey& key, double share) const noexcept {
  const Viewer& viewer = eye.viewer;
  const double size = side(key.level), pitch = ground_.pitch;
  const auto from = [&](std::int64_t index, std::int64_t patch, double part, double way) {
    return static_cast<double>((index << key.level) - patch) * pitch - part * pitch - share * way;
  };
  const double west = from(key.i, viewer.position.i, viewer.position.u, viewer.east);
  const double south = from(key.j, viewer.position.j, viewer.position.v, viewer.north);
  const double east = away(west, west + size), north = away(south, south + size);
  return east * east + north * north;
}

/// Where on its way the viewer comes nearest to the node's middle, about.
double Selection::shareOfWay(const Eye& eye, const NodeKey& key) const noexcept {
  const Viewer& viewer = eye.viewer;
  const double half = 0.5 * side(key.level), pitch = ground_.pitch;
  const double east =
      (static_cast<double>((key.i << key.level) - viewer.position.i) - viewer.position.u) * pitch + half;
  const double north =
      (static_cast<double>((key.j << key.level) - viewer.position.j) - viewer.position.v) * pitch + half;
  const double way = viewer.east * viewer.east + viewer.north * viewer.north;
  return way > 0.0 ? std::clamp((east * viewer.east + north * viewer.north) / way, 0.0, 1.0) : 1.0;
}

// Within the distance across the ground: what is far below is in sight too.
double Selection::seenBy(const Eye& eye, const NodeKey& key, double share, double rim) const noexcept {
  const double across = squaredAcross(eye, key, share);
  if (across > eye.squaredDistance) return 0.0;
  const double height = eye.viewer.height + share * eye.viewer.up;
  const double up = away(height - ground_.high, height - ground_.low);
  return eye.pixels / std::max(std::sqrt(across + up * up) - rim, kNearestGround);
}

double Selection::seen(const NodeKey& key) const {
  const RoughNode node = roughness(key);
  double most = 0.0;
  for (const Eye& eye : eyes_) {
    most = std::max(most, seenBy(eye, key, 0.0, node.rim));
    if (eye.moves) most = std::max(most, seenBy(eye, key, shareOfWay(eye, key), node.rim));
  }
  return most > 0.0 ? node.error * most : 0.0;
}

float Selection::rootUrgency(const NodeKey& root) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eye& eye : eyes_) nearest = std::min(nearest, squaredAcross(eye, root, 0.0));
  return static_cast<float>(kBeforeAllElse / (1.0 + std::sqrt(nearest)));
}

// ---- Choosing

void Selection::begin(std::span<const Viewer> viewers, double tolerance, std::size_t most) {
  assert(tolerance >= 1.0);
  const int top = static_cast<int>(ground_.errors.size()) - 1;
  double farthest = 0.0;
  eyes_.clear();
  for (const Viewer& viewer : viewers) {
    const DetailSettings& detail = viewer.detail;
    const bool moves = viewer.east != 0.0 || viewer.north != 0.0 || viewer.up != 0.0;
    eyes_.push_back({viewer, lensPixels(detail.lines, detail.fieldOfView) / detail.pixelError,
                     detail.distance * detail.distance, moves});
    farthest = std::max(farthest, detail.distance);
  }
  tolerance_ = tolerance;
  rootLevel_ = std::max(rootLevel_, rootLevelFor(farthest, ground_.pitch, std::min(top, ground_.coarsest)));
  chosen_ = 1 - kept_;
  chosen().clear(rootLevel_);
  for (std::vector<Cut::Index>& level : split_) level.clear();
  left_ = most / 3;  // a node that is split makes three leaves more
  next_ = 0;
  row_ = 0;
  stage_ = Stage::rooting;
}

bool Selection::choose(std::span<const Viewer> viewers, double tolerance, std::size_t most) {
  begin(viewers, tolerance, most);
  step(Slice::unlimited());
  return hasChosen();
}

bool Selection::step(const Slice& slice) {
  while (stage_ > Stage::refused) {
    stepUnits();
    if (slice.over()) break;
  }
  return stage_ <= Stage::refused;
}

void Selection::stepUnits() {
  switch (stage_) {
    case Stage::chosen:
    case Stage::refused:
      break;
    case Stage::rooting:
      return findSomeRoots();
    case Stage::splitting:
      return splitSome();
    case Stage::balancing:
      return balanceSome();
    case Stage::weighing:
      return weighSome();
    case Stage::sorting:
      if (chosen().sortSome(kSorts)) stage_ = Stage::chosen;
  }
}

void Selection::keep() {
  assert(hasChosen());
  kept_ = chosen_;
  forgets_ = false;
}

/// A row of one viewer's.
void Selection::findSomeRoots() {
  if (next_ == eyes_.size()) {
    next_ = 0;
    stage_ = Stage::splitting;
    return;
  }
  const Eye& eye = eyes_[next_];
  const auto most =
      static_cast<std::int64_t>(std::ceil(kRootsStay * eye.viewer.detail.distance / side(rootLevel_)));
  const NodeKey centre = nodeAt(eye.viewer.position, rootLevel_);
  for (std::int64_t di = -most; di <= most; ++di) {
    takeRoot(eye, {rootLevel_, centre.i + di, centre.j - most + row_});
  }
  if (row_++ < 2 * most) return;
  row_ = 0;
  ++next_;
}

void Selection::takeRoot(const Eye& eye, const NodeKey& key) {
  if (!insideWorld(key)) return;
  const double across = squaredAcross(eye, key, 0.0);
  if (across > kRootsStay * kRootsStay * eye.squaredDistance) return;
  const Cut::Index before = kept().rootLevel() == rootLevel_ ? kept().find(key) : Cut::kNone;
  if ((across > eye.squaredDistance && before == Cut::kNone) || chosen().hasRoot(key)) return;
  chosen()[chosen().addRoot(key)].before = before;
}

bool Selection::divide(Cut::Index index, float urgency) {
  if (left_-- == 0) {
    chosen().clear(rootLevel_);
    stage_ = Stage::refused;
    return false;
  }
  Cut& cut = chosen();
  cut.divide(index);
  Cut::Node& node = cut[index];
  node.own = urgency;
  split_[static_cast<std::size_t>(node.key.level)].push_back(index);
  const Cut::Index before = node.before == Cut::kNone ? Cut::kNone : kept()[node.before].children;
  for (int which = 0; which < 4; ++which) {
    Cut::Node& child = cut[node.children + which];
    if (before != Cut::kNone) {
      child.before = before + which;
    } else if (child.key.level == kept().rootLevel()) {  // where roots were finer before
      child.before = kept().find(child.key);
    }
  }
  return true;
}

void Selection::splitSome() {
  Cut& cut = chosen();
  for (std::size_t unit = 0; unit < kUnits && next_ < cut.size(); ++unit) {
    const auto index = static_cast<Cut::Index>(next_++);
    const Cut::Node& node = cut[index];
    if (node.key.level == 0) continue;
    const bool wasSplit = !forgets_ && node.before != Cut::kNone && !kept()[node.before].isLeaf();
    const double error = seen(node.key);
    if (error > tolerance_ * exchangeAt(wasSplit) && !divide(index, static_cast<float>(error))) return;
  }
  if (next_ < cut.size()) return;
  next_ = 0;
  level_ = 1;
  stage_ = Stage::balancing;
}

/// Where a node is split, all that touch it must be there or finer, so what is above them is split too, and
/// no less urgently. From the finest level on.
void Selection::balanceSome() {
  for (std::size_t unit = 0; unit < kUnits && level_ < rootLevel_; ++unit) {
    const std::vector<Cut::Index>& level = split_[static_cast<std::size_t>(level_)];
    if (next_ == level.size()) {
      next_ = 0;
      ++level_;
      continue;
    }
    balanceAround(level[next_++]);
    if (stage_ == Stage::refused) return;
  }
  if (level_ < rootLevel_) return;
  next_ = 0;
  stage_ = Stage::weighing;
}

void Selection::balanceAround(Cut::Index index) {
  Cut& cut = chosen();
  const NodeKey key = cut[index].key, above = key.parent();
  const float urgency = cut[index].own;
  Cut::Node& parent = cut[cut[index].parent];
  parent.own = std::max(parent.own, urgency);
  // Its own parent's other children are there; the nodes beyond are those of three other parents.
  const int east = (key.i & 1) != 0 ? 1 : -1, north = (key.j & 1) != 0 ? 1 : -1;
  makeDivided(above.neighbour(east, 0), urgency);
  makeDivided(above.neighbour(0, north), urgency);
  makeDivided(above.neighbour(east, north), urgency);
}

void Selection::makeDivided(const NodeKey& key, float urgency) {
  Cut& cut = chosen();
  for (Cut::Index index = cut.nearest(key); index != Cut::kNone; index = cut.nearest(key)) {
    if (stage_ == Stage::refused || (cut[index].isLeaf() && !divide(index, urgency))) return;
    if (cut[index].key.level > key.level) continue;
    cut[index].own = std::max(cut[index].own, urgency);
    return;
  }
}

void Selection::weighSome() {
  Cut& cut = chosen();
  for (std::size_t unit = 0; unit < kUnits && next_ < cut.size(); ++unit) {
    Cut::Node& node = cut[static_cast<Cut::Index>(next_++)];
    node.urgency = node.parent == Cut::kNone ? rootUrgency(node.key) : cut[node.parent].own;
  }
  if (next_ < cut.size()) return;
  next_ = 0;
  stage_ = Stage::sorting;
}

std::size_t Selection::bytes() const noexcept {
  std::size_t bytes = cuts_[0].bytes() + cuts_[1].bytes();
  for (const std::vector<Cut::Index>& level : split_) bytes += level.capacity() * sizeof(Cut::Index);
  constexpr std::size_t kInMap = 16;  // the links of an entry (estimated)
  return bytes + roughNodes_.size() * (sizeof(NodeKey) + sizeof(RoughNode) + kInMap) +
         roughNodes_.bucket_count() * sizeof(void*);
}

}  // namespace teren
