// Which of many ids are marked: one bit each, in the parts of the range where any are.
#pragma once

#include <cstddef>
#include <cstdint>

#include "generators/tin/CompactArray.h"

namespace teren {

/// A set of ids that grows as larger ones come, in pages of 1024: a set of what a tool has touched stays
/// small in a mesh of millions. All functions O(1), but for growing.
class MarkSet {
 public:
  /// True where the id was not in the set.
  bool insert(std::uint32_t id) {
    const std::size_t page = id >> kPageBits;
    while (page >= pages_.size()) pages_.push_back(kNone);
    if (pages_[page] == kNone) {
      pages_[page] = static_cast<std::uint32_t>(words_.size() / kWords);
      for (std::size_t n = 0; n < kWords; ++n) words_.push_back(0);
    }
    std::uint64_t& word = words_[place(id)];
    const std::uint64_t bit = std::uint64_t{1} << (id & 63U);
    const bool isNew = (word & bit) == 0;
    word |= bit;
    return isNew;
  }
  void erase(std::uint32_t id) noexcept {
    if (has(id)) words_[place(id)] &= ~(std::uint64_t{1} << (id & 63U));
  }
  bool contains(std::uint32_t id) const noexcept {
    return has(id) && ((words_[place(id)] >> (id & 63U)) & 1U) != 0;
  }
  std::size_t bytes() const noexcept { return pages_.bytes() + words_.bytes(); }

 private:
  static constexpr int kPageBits = 10;
  static constexpr std::size_t kWords = (std::size_t{1} << kPageBits) / 64;
  static constexpr std::uint32_t kNone = 0xffffffffU;
  bool has(std::uint32_t id) const noexcept {
    return (id >> kPageBits) < pages_.size() && pages_[id >> kPageBits] != kNone;
  }
  std::size_t place(std::uint32_t id) const noexcept {
    return pages_[id >> kPageBits] * kWords + ((id >> 6) & (kWords - 1));
  }

  CompactArray<std::uint32_t> pages_;
  CompactArray<std::uint64_t> words_;
};

}  // namespace teren
