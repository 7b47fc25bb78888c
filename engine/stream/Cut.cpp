#include "stream/Cut.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

namespace teren {

void Cut::clear(int rootLevel) {
  rootLevel_ = rootLevel;
  nodes_.clear();
  order_.clear();
  sorting_ = Sorting::counting;
  next_ = 0;
  leaves_ = 0;
  roots_.clear();
}

Cut::Index Cut::addRoot(const NodeKey& key) {
  assert(key.level == rootLevel_);
  const auto index = static_cast<Index>(nodes_.size());
  [[maybe_unused]] const bool isNew = roots_.insert(key, index);
  assert(isNew);
  nodes_.emplace_back().key = key;
  ++leaves_;
  return index;
}

void Cut::divide(Index leaf) {
  const auto first = static_cast<Index>(nodes_.size());
  const NodeKey key = (*this)[leaf].key;
  assert((*this)[leaf].isLeaf() && key.level > 0);
  (*this)[leaf].children = first;
  for (int which = 0; which < 4; ++which) {
    Node& child = nodes_.emplace_back();
    child.key = key.child(which);
    child.parent = leaf;
  }
  leaves_ += 3;
}

// By the bits of the urgency, which are ordered like positive floats themselves, eleven at a time. Keeps what
// is equal in its order, so parents before children.
bool Cut::sortSome(std::size_t most) {
  if (next_ == 0 && sorting_ == Sorting::counting) {
    entries_.resize(nodes_.size());
    sorted_.resize(nodes_.size());
    order_.resize(nodes_.size());
    for (auto& starts : starts_) starts.fill(0);
  }
  const std::size_t from = std::exchange(next_, std::min(next_ + most, nodes_.size()));
  switch (sorting_) {
    case Sorting::counting:
      count(from, next_);
      break;
    case Sorting::placing:
      place(from, next_);
      break;
    default:
      scatter(from, next_);
  }
  if (next_ < nodes_.size()) return false;
  next_ = 0;
  if (sorting_ == Sorting::placing) {
    sorting_ = Sorting::counting;
    return true;
  }
  if (sorting_ == Sorting::counting) {
    endCounting();
  } else {
    entries_.swap(sorted_);
  }
  sorting_ = static_cast<Sorting>(static_cast<int>(sorting_) + 1);
  return false;
}

void Cut::count(std::size_t from, std::size_t to) {
  for (std::size_t k = from; k < to; ++k) {
    assert(nodes_[k].urgency >= 0.0F);
    const std::uint32_t key = ~std::bit_cast<std::uint32_t>(nodes_[k].urgency);
    entries_[k] = {key, static_cast<Index>(k)};
    for (std::size_t pass = 0; pass < kPasses; ++pass) ++starts_[pass][digit(key, pass)];
  }
}

void Cut::endCounting() {
  for (auto& starts : starts_) {
    std::uint32_t sum = 0;
    for (std::uint32_t& start : starts) sum += std::exchange(start, sum);
  }
}

void Cut::scatter(std::size_t from, std::size_t to) {
  const auto pass = static_cast<std::size_t>(sorting_) - static_cast<std::size_t>(Sorting::low);
  for (std::size_t k = from; k < to; ++k) {
    sorted_[starts_[pass][digit(entries_[k].key, pass)]++] = entries_[k];
  }
}

void Cut::place(std::size_t from, std::size_t to) {
  for (std::size_t k = from; k < to; ++k) {
    order_[k] = entries_[k].index;
    (*this)[order_[k]].place = static_cast<Index>(k);
  }
}

Cut::Index Cut::nearest(const NodeKey& key) const {
  if (key.level > rootLevel_) return kNone;
  Index index = roots_.find(key.ancestor(rootLevel_));
  if (index == kNone) return kNone;
  for (int level = rootLevel_ - 1; level >= key.level && !(*this)[index].isLeaf(); --level) {
    const NodeKey step = key.ancestor(level);
    index = (*this)[index].children + static_cast<Index>((step.i & 1) | ((step.j & 1) << 1));
  }
  return index;
}

Cut::Index Cut::find(const NodeKey& key) const {
  const Index index = nearest(key);
  return index != kNone && (*this)[index].key.level == key.level ? index : kNone;
}

std::size_t Cut::bytes() const noexcept {
  return nodes_.capacity() * sizeof(Node) + roots_.bytes() + order_.capacity() * sizeof(Index) +
         (entries_.capacity() + sorted_.capacity()) * sizeof(Entry) + sizeof(starts_);
}

}  // namespace teren
