// Numbers by node: a flat hash table that keeps its room, for what is filled anew in every frame.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "patch/NodeKey.h"

namespace teren {

/// Open addressing, at most half full. Not thread-safe. Allocates only where there are more entries than ever
/// before; clear() costs as much as there is room.
class NodeTable {
 public:
  using Value = std::int32_t;
  static constexpr Value kNone = -1;  ///< no value

  void clear() noexcept {
    std::fill(slots_.begin(), slots_.end(), Slot{});
    count_ = 0;
  }
  /// `value` >= 0. False, and nothing happens, where there is one already.
  bool insert(const NodeKey& key, Value value) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    Slot& slot = slots_[placeOf(key)];
    if (slot.value != kNone) return false;
    slot = {key, value};
    ++count_;
    return true;
  }
  /// kNone where there is none.
  Value find(const NodeKey& key) const noexcept {
    return slots_.empty() ? kNone : slots_[placeOf(key)].value;
  }
  bool contains(const NodeKey& key) const noexcept { return find(key) != kNone; }
  std::size_t bytes() const noexcept { return slots_.capacity() * sizeof(Slot); }

 private:
  struct Slot {
    NodeKey key;
    Value value = kNone;
  };
  /// Of the key, or where it would go.
  std::size_t placeOf(const NodeKey& key) const noexcept {
    const std::size_t mask = slots_.size() - 1;
    std::size_t place = NodeKeyHash{}(key)&mask;
    while (slots_[place].value != kNone && slots_[place].key != key) place = (place + 1) & mask;
    return place;
  }
  void grow() {
    std::vector<Slot> old(std::max<std::size_t>(64, 2 * slots_.size()));
    slots_.swap(old);
    for (const Slot& slot : old) {
      if (slot.value != kNone) slots_[placeOf(slot.key)] = slot;
    }
  }

  std::vector<Slot> slots_;  // a power of two of them
  std::size_t count_ = 0;
};

}  // namespace teren
