// Which of many ids are marked: one bit each.
#pragma once

#include <cstddef>
#include <cstdint>

#include "generators/tin/CompactArray.h"

namespace teren {

/// A set of ids that grows as larger ones come. All functions O(1), but for growing.
class MarkSet {
 public:
  /// True where the id was not in the set.
  bool insert(std::uint32_t id) {
    const std::size_t word = id >> 6;
    while (word >= words_.size()) words_.push_back(0);
    const std::uint64_t bit = std::uint64_t{1} << (id & 63U);
    const bool isNew = (words_[word] & bit) == 0;
    words_[word] |= bit;
    return isNew;
  }
  void erase(std::uint32_t id) noexcept {
    const std::size_t word = id >> 6;
    if (word < words_.size()) words_[word] &= ~(std::uint64_t{1} << (id & 63U));
  }
  bool contains(std::uint32_t id) const noexcept {
    const std::size_t word = id >> 6;
    return word < words_.size() && ((words_[word] >> (id & 63U)) & 1U) != 0;
  }
  std::size_t bytes() const noexcept { return words_.bytes(); }

 private:
  CompactArray<std::uint64_t> words_;
};

}  // namespace teren
