#include "stream/Cut.h"

#include <array>
#include <bit>
#include <cassert>
#include <utility>

namespace teren {

void Cut::clear(int rootLevel) {
  rootLevel_ = rootLevel;
  nodes_.clear();
  order_.clear();
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
void Cut::sortPass(int pass) {
  constexpr unsigned kBits = 11;
  constexpr std::uint32_t kDigits = 1U << kBits;
  if (pass == 0) {
    entries_.resize(nodes_.size());
    sorted_.resize(nodes_.size());
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      assert(nodes_[k].urgency >= 0.0F);
      entries_[k] = {~std::bit_cast<std::uint32_t>(nodes_[k].urgency), static_cast<Index>(k)};
    }
  }
  std::array<std::uint32_t, kDigits> starts{};
  const unsigned shift = kBits * static_cast<unsigned>(pass);
  const auto digit = [shift](const Entry& entry) { return (entry.key >> shift) & (kDigits - 1); };
  for (const Entry& entry : entries_) ++starts[digit(entry)];
  std::uint32_t sum = 0;
  for (std::uint32_t& start : starts) sum += std::exchange(start, sum);
  for (const Entry& entry : entries_) sorted_[starts[digit(entry)]++] = entry;
  entries_.swap(sorted_);
  if (pass + 1 < kPasses) return;
  order_.resize(nodes_.size());
  for (std::size_t k = 0; k < order_.size(); ++k) {
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
         (entries_.capacity() + sorted_.capacity()) * sizeof(Entry);
}

}  // namespace teren
