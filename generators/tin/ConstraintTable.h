// Which stamp made a constrained edge: a compact table from edges to ids.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "generators/tin/CompactArray.h"

namespace teren {

/// A hash table from pairs of vertices, in either order, to 32-bit ids: open addressing, linear probing, at
/// most three quarters full, 12 bytes a place. Expected cost of each function: O(1).
class ConstraintTable {
 public:
  /// Sets the id of an edge, new or known.
  void set(std::uint32_t a, std::uint32_t b, std::uint32_t id);
  /// The id of an edge that is in the table.
  std::uint32_t id(std::uint32_t a, std::uint32_t b) const noexcept;
  bool contains(std::uint32_t a, std::uint32_t b) const noexcept;
  /// Removes an edge that is in the table.
  void erase(std::uint32_t a, std::uint32_t b) noexcept;

  std::size_t size() const noexcept { return used_; }
  std::size_t bytes() const noexcept { return places_.bytes(); }

  /// visit(a, b, id) for every edge, a < b, in an order that depends on how the table was filled.
  template <class Visitor>
  void forEach(Visitor&& visit) const {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (places_[i].a != kEmpty) visit(places_[i].a, places_[i].b, places_[i].id);
    }
  }

 private:
  friend class SandState;  // archives

  static constexpr std::uint32_t kEmpty = 0xffffffffU;
  struct Place {
    std::uint32_t a = kEmpty;  // the smaller one
    std::uint32_t b = kEmpty;
    std::uint32_t id = 0;
  };

  std::size_t home(std::uint32_t a, std::uint32_t b) const noexcept;
  /// Where the edge is, or the empty place where it would go. The table must not be empty.
  std::size_t find(std::uint32_t a, std::uint32_t b) const noexcept;
  void grow();

  CompactArray<Place> places_;  // a power of two
  std::size_t used_ = 0;
};

}  // namespace teren
