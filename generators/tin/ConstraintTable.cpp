#include "generators/tin/ConstraintTable.h"

#include "teren/Hash.h"

namespace teren {

std::size_t ConstraintTable::home(std::uint32_t a, std::uint32_t b) const noexcept {
  return mixBits((static_cast<std::uint64_t>(a) << 32) | b) & (places_.size() - 1);
}

std::size_t ConstraintTable::find(std::uint32_t a, std::uint32_t b) const noexcept {
  if (a > b) std::swap(a, b);
  std::size_t i = home(a, b);
  while (places_[i].a != kEmpty && (places_[i].a != a || places_[i].b != b))
    i = (i + 1) & (places_.size() - 1);
  return i;
}

void ConstraintTable::grow() {
  CompactArray<Place> old = std::move(places_);
  places_ = {};
  places_.resize(old.size() == 0 ? 16 : 2 * old.size(), Place{});
  for (std::size_t i = 0; i < old.size(); ++i) {
    if (old[i].a != kEmpty) places_[find(old[i].a, old[i].b)] = old[i];
  }
}

void ConstraintTable::set(std::uint32_t a, std::uint32_t b, std::uint32_t id) {
  if (4 * (used_ + 1) > 3 * places_.size()) grow();
  Place& place = places_[find(a, b)];
  if (place.a == kEmpty) ++used_;
  place = {a < b ? a : b, a < b ? b : a, id};
}

bool ConstraintTable::contains(std::uint32_t a, std::uint32_t b) const noexcept {
  return used_ > 0 && places_[find(a, b)].a != kEmpty;
}

std::uint32_t ConstraintTable::id(std::uint32_t a, std::uint32_t b) const noexcept {
  assert(contains(a, b));
  return places_[find(a, b)].id;
}

void ConstraintTable::erase(std::uint32_t a, std::uint32_t b) noexcept {
  assert(contains(a, b));
  const std::size_t mask = places_.size() - 1;
  std::size_t gap = find(a, b);
  // Edges behind the gap move up, unless they would pass their home.
  for (std::size_t i = (gap + 1) & mask; places_[i].a != kEmpty; i = (i + 1) & mask) {
    const std::size_t from = home(places_[i].a, places_[i].b);
    if (((i - from) & mask) < ((i - gap) & mask)) continue;
    places_[gap] = places_[i];
    gap = i;
  }
  places_[gap] = {};
  --used_;
}

}  // namespace teren
