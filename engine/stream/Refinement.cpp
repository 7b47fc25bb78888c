#include "stream/Refinement.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace teren {

namespace {

// Marks of a cut's nodes.
constexpr std::uint8_t kHeld = 1, kDrawn = 2;
constexpr std::uint8_t kUnder = 4;    // something coarser is drawn
constexpr std::uint8_t kOver = 8;     // something finer is drawn in it
constexpr std::uint8_t kQueued = 16;  // among the ready

constexpr std::size_t kUnits = 64;  // nodes between two looks at the clock
constexpr std::size_t kLeaveAtOnce = 16;
constexpr std::uint32_t kAfterMerges = 1U << 31;

bool isThere(const Cut::Node& node) noexcept {
  return (node.marks & (node.isLeaf() ? kDrawn : kHeld)) != 0;
}

bool isInAny(const NodeKey& key, const std::vector<NodeKey>& nodes) {
  return std::any_of(nodes.begin(), nodes.end(), [&](const NodeKey& node) { return isIn(key, node); });
}

}  // namespace

void Refinement::Followed::clear(Cut* newCut) {
  cut = newCut;
  counted = missing = nextAbsent = 0;
  absent.clear();
  ready.clear();
}

// ---- Another cut

void Refinement::turnTo(Cut& cut) {
  assert(!next_.cut);
  next_.clear(&cut);
  turn_ = Turn::marking;
  turned_ = 0;
}

bool Refinement::turnStep(const Slice& slice) {
  assert(next_.cut);
  while (next_.cut) {
    turnSome();
    if (slice.over()) break;
  }
  return !next_.cut;
}

void Refinement::turnSome() {
  const bool ofOld = turn_ == Turn::leaving;
  const std::size_t count = ofOld ? wanted() : next_.cut->size();
  for (std::size_t unit = 0; unit < kUnits && turned_ < count; ++unit) {
    const auto index = static_cast<Cut::Index>(turned_++);
    switch (turn_) {
      case Turn::marking:
        mark(index);
        break;
      case Turn::gathering:
        gather(static_cast<Cut::Index>(count) - 1 - index);
        break;
      case Turn::listing:
        list(next_.cut->byUrgency()[static_cast<std::size_t>(index)]);
        next_.counted = turned_;
        break;
      case Turn::leaving:
        leave((*now_.cut)[index]);
        break;
    }
  }
  if (turned_ < count) return;
  turned_ = 0;
  if (!ofOld) {
    turn_ = static_cast<Turn>(static_cast<int>(turn_) + 1);
    return;
  }
  std::swap(now_, next_);
  next_.cut = nullptr;
}

/// What is known of a node already needs no looking up.
void Refinement::mark(Cut::Index index) {
  Cut::Node& node = (*next_.cut)[index];
  if (node.before != Cut::kNone) {
    assert((*now_.cut)[node.before].key == node.key);
    node.marks = (*now_.cut)[node.before].marks & (kHeld | kDrawn);
  } else {
    node.marks = nodes_.heights(node.key) ? kHeld : 0;
    if (nodes_.isDrawn(node.key)) node.marks |= kDrawn;
  }
  if (node.parent != Cut::kNone && ((*next_.cut)[node.parent].marks & (kDrawn | kUnder)) != 0) {
    node.marks |= kUnder;
  }
}

/// From the leaves to the roots.
void Refinement::gather(Cut::Index index) {
  Cut::Node& node = (*next_.cut)[index];
  if (node.isLeaf() && (node.marks & (kDrawn | kUnder)) == 0 && nodes_.isDrawnIn(node.key))
    node.marks |= kOver;
  if (node.parent != Cut::kNone && (node.marks & (kDrawn | kOver)) != 0)
    (*next_.cut)[node.parent].marks |= kOver;
}

void Refinement::list(Cut::Index index) {
  const Cut::Node& node = (*next_.cut)[index];
  const auto is = [&](std::uint8_t mark) { return (node.marks & mark) != 0; };
  if (!isThere(node)) ++next_.missing;
  if (!is(kHeld)) {
    next_.absent.push_back(index);
  } else if (node.isLeaf() ? !is(kDrawn | kUnder) : is(kDrawn) || !is(kUnder | kOver)) {
    queue(next_, index);
  }
}

void Refinement::leave(const Cut::Node& node) {
  if (node.parent == Cut::kNone && next_.cut->nearest(node.key) == Cut::kNone) leaving_.push_back(node.key);
  if ((node.marks & (kHeld | kDrawn)) == kHeld && next_.cut->find(node.key) == Cut::kNone) {
    unwanted_.push_back(node.key);
  }
}

// ---- What happens to the nodes

void Refinement::note(const NodeKey& key) {
  note(now_, key);
  note(next_, key);
  noteUnwanted(key);
}

void Refinement::noteUnwanted(const NodeKey& key) {
  const Cut* latest = next_.cut ? next_.cut : now_.cut;
  if (latest && latest->find(key) == Cut::kNone) unwanted_.push_back(key);
}

void Refinement::note(Followed& followed, const NodeKey& key) {
  if (!followed.cut) return;
  const Cut::Index index = followed.cut->find(key);
  if (index == Cut::kNone) return;
  Cut::Node& node = (*followed.cut)[index];
  const bool wasThere = isThere(node);
  node.marks =
      static_cast<std::uint8_t>((node.marks & ~(kHeld | kDrawn)) | (nodes_.heights(key) ? kHeld : 0) |
                                (nodes_.isDrawn(key) ? kDrawn : 0));
  if (static_cast<std::size_t>(node.place) < followed.counted && wasThere != isThere(node)) {
    wasThere ? ++followed.missing : --followed.missing;
  }
  queue(followed, index);
  if (node.parent != Cut::kNone) queue(followed, node.parent);  // it may be split, perhaps
}

void Refinement::noteChange(const DrawnChange& change) {
  for (const NodeKey& key : change.remove) note(key);
  for (const NodeKey& key : change.add) note(key);
  for (Followed* followed : {&now_, &next_}) {
    if (!followed->cut) continue;
    for (const NodeKey& key : change.add) {
      const Cut::Index index = followed->cut->nearest(key);
      if (index != Cut::kNone) {
        queue(*followed, index);
      } else if (followed == &now_) {
        leaving_.push_back(key);  // on its way while its root went
      }
    }
    for (const NodeKey& key : change.remove) noteGone(*followed, key, !change.add.empty());
  }
}

/// What was kept from being split by a coarser node beside it, or from coming by one above or in it.
void Refinement::noteGone(Followed& followed, const NodeKey& key, bool isReplaced) {
  nodes_.forEachDrawnTouching(key, [&](const NodeKey& other) {
    if (other.level >= key.level) return;
    const Cut::Index index = followed.cut->find(other);
    if (index != Cut::kNone) queue(followed, index);
  });
  if (isReplaced) return;
  const Cut::Index nearest = followed.cut->nearest(key);
  if (nearest == Cut::kNone) return;
  queueBelow(followed, nearest);
  for (Cut::Index above = (*followed.cut)[nearest].parent; above != Cut::kNone;
       above = (*followed.cut)[above].parent) {
    queue(followed, above);
  }
}

void Refinement::queueBelow(Followed& followed, Cut::Index index) {
  queue(followed, index);
  const Cut::Node& node = (*followed.cut)[index];
  for (int which = 0; which < 4 && !node.isLeaf(); ++which) queueBelow(followed, node.children + which);
}

void Refinement::queue(Followed& followed, Cut::Index index) {
  Cut::Node& node = (*followed.cut)[index];
  const bool isDone = node.isLeaf() && (node.marks & kDrawn) != 0;
  if ((node.marks & kHeld) == 0 || (node.marks & kQueued) != 0 || isDone) return;
  node.marks |= kQueued;
  const bool merges = node.isLeaf() && nodes_.isDrawnIn(node.key);
  followed.ready.push_back({static_cast<std::uint32_t>(node.place) | (merges ? 0 : kAfterMerges), index});
  std::push_heap(followed.ready.begin(), followed.ready.end(),
                 [](const Ready& a, const Ready& b) { return a.place > b.place; });
}

// ---- Steps

bool Refinement::isWanted(const NodeKey& key) const {
  return (now_.cut && now_.cut->find(key) != Cut::kNone) || (next_.cut && next_.cut->find(key) != Cut::kNone);
}

const Cut::Node* Refinement::absent() {
  while (now_.nextAbsent < now_.absent.size()) {
    const Cut::Node& node = (*now_.cut)[now_.absent[now_.nextAbsent]];
    if ((node.marks & kHeld) == 0) return &node;
    ++now_.nextAbsent;
  }
  return nullptr;
}

std::optional<NodeKey> Refinement::takeUnwanted() {
  if (unwanted_.empty() || next_.cut) return std::nullopt;
  const NodeKey key = unwanted_.back();
  unwanted_.pop_back();
  return key;
}

bool Refinement::leaveSome(DrawnChange& change) {
  while (!leaving_.empty() && change.remove.empty()) {
    nodes_.forEachDrawnIn(leaving_.back(), [&](const NodeKey& key) {
      if (now_.cut->nearest(key) == Cut::kNone) change.remove.push_back(key);
      return change.remove.size() < kLeaveAtOnce;
    });
    if (change.remove.empty()) leaving_.pop_back();
  }
  return !change.remove.empty();
}

bool Refinement::canSplit(const Cut::Node& node) const {
  for (int which = 0; which < 4; ++which) {
    if (((*now_.cut)[node.children + which].marks & kHeld) == 0) return false;
  }
  bool can = true;
  nodes_.forEachDrawnTouching(node.key,
                              [&](const NodeKey& other) { can = can && other.level <= node.key.level; });
  return can;
}

bool Refinement::addStep(const Cut::Node& node, DrawnChange& change) const {
  if ((node.marks & kHeld) == 0) return false;
  const std::optional<NodeKey> drawn = nodes_.drawnOver(node.key);
  if (!drawn) {
    if (isInAny(node.key, change.add)) return false;
    if (nodes_.isDrawnIn(node.key)) {
      if (!node.isLeaf()) return false;
      nodes_.forEachDrawnIn(node.key, [&](const NodeKey& key) {
        change.remove.push_back(key);
        return true;
      });
    }
    change.add.push_back(node.key);
    return true;
  }
  if (node.isLeaf() || drawn != node.key || !canSplit(node)) return false;
  change.remove.push_back(node.key);
  for (int which = 0; which < 4; ++which) change.add.push_back(node.key.child(which));
  return true;
}

DrawnChange Refinement::next(std::size_t most) {
  DrawnChange change;
  if (!now_.cut || (!next_.cut && leaveSome(change))) return change;
  std::vector<Ready>& ready = now_.ready;
  std::size_t steps = 0;
  for (int looks = 0; looks < kLooks && steps < most && !ready.empty(); ++looks) {
    std::pop_heap(ready.begin(), ready.end(),
                  [](const Ready& a, const Ready& b) { return a.place > b.place; });
    Cut::Node& node = (*now_.cut)[ready.back().index];
    ready.pop_back();
    node.marks &= static_cast<std::uint8_t>(~kQueued);
    if (addStep(node, change)) ++steps;
  }
  return change;
}

void Refinement::again(const DrawnChange& change) {
  for (const std::vector<NodeKey>* keys : {&change.add, &change.remove}) {
    for (const NodeKey& key : *keys) {
      const Cut::Index index = now_.cut->find(key);
      if (index != Cut::kNone) queue(now_, index);
    }
  }
}

std::size_t Refinement::bytes() const noexcept {
  std::size_t bytes = (leaving_.capacity() + unwanted_.capacity()) * sizeof(NodeKey);
  for (const Followed* followed : {&now_, &next_}) {
    bytes += followed->absent.capacity() * sizeof(Cut::Index) + followed->ready.capacity() * sizeof(Ready);
  }
  return bytes;
}

}  // namespace teren
