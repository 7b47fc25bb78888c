// A hash map for what is filled in the middle of a frame: no insertion takes long.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace teren {

/// Many small tables instead of a large one, each of which grows on its own. A table that grows moves all its
/// entries at once, a tenth of a microsecond each where they lie scattered: 2 ms at 20,000 of them, and a
/// 256th of it here. What find returns lasts until that entry is erased. Not thread-safe.
template <class Key, class Value, class Hash>
class SteadyMap {
 public:
  SteadyMap() : tables_(std::size_t{1} << kBits) {}

  /// nullptr where there is none.
  Value* find(const Key& key) {
    Table& table = tables_[place(key)];
    const auto found = table.find(key);
    return found == table.end() ? nullptr : &found->second;
  }
  const Value* find(const Key& key) const { return const_cast<SteadyMap*>(this)->find(key); }
  bool contains(const Key& key) const { return find(key) != nullptr; }
  /// Nothing happens where there is one already.
  void insert(const Key& key, Value value) {
    if (tables_[place(key)].emplace(key, std::move(value)).second) ++size_;
  }
  void erase(const Key& key) { size_ -= tables_[place(key)].erase(key); }
  std::size_t size() const noexcept { return size_; }

 private:
  using Table = std::unordered_map<Key, Value, Hash>;
  static constexpr unsigned kBits = 8;

  /// Of bits that the tables themselves, which divide by primes, do not look at in the same way.
  static std::size_t place(const Key& key) noexcept {
    return static_cast<std::size_t>((static_cast<std::uint64_t>(Hash{}(key)) * 0x9E3779B97F4A7C15U) >>
                                    (64U - kBits));
  }

  std::vector<Table> tables_;
  std::size_t size_ = 0;
};

}  // namespace teren
