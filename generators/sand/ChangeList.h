// What has changed since somebody last looked: each slot once.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "generators/sand/MarkSet.h"

namespace teren {

/// Ids of vertices or triangles in the order of their first change. An id names a slot: whoever goes through
/// the list looks what is there now, which may be nothing, or something younger. So no removal makes a list
/// wrong.
class ChangeList {
 public:
  void add(std::uint32_t id) {
    if (marks_.insert(id)) ids_.push_back(id);
  }
  std::span<const std::uint32_t> ids() const noexcept { return ids_; }
  bool contains(std::uint32_t id) const noexcept { return marks_.contains(id); }
  /// O(length of the list).
  void clear() noexcept {
    for (const std::uint32_t id : ids_) marks_.erase(id);
    ids_.clear();
  }
  std::size_t bytes() const noexcept { return marks_.bytes() + ids_.capacity() * sizeof(std::uint32_t); }

 private:
  friend class SandState;  // archives

  MarkSet marks_;
  std::vector<std::uint32_t> ids_;
};

}  // namespace teren
