#include "edits/GroundOverrides.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "teren/Hash.h"
#include "teren/HeightMapOperations.h"

namespace teren {

namespace {

/// Numbers along one axis, both ends included; none where last < first.
struct Stretch {
  std::int64_t first = 0, last = -1;
};

/// Which samples of a level lie in a patch that begins at level-0 sample `first`, and in the grid.
Stretch samplesIn(std::int64_t first, int intervals, int level, std::int64_t gridFirst, int gridCount) {
  const std::int64_t beforeNext = (std::int64_t{1} << level) - 1;
  return {std::max((first + beforeNext) >> level, gridFirst),
          std::min((first + intervals - 1) >> level, gridFirst + gridCount - 1)};
}

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();  // no height

GroundOverrides::Patch nothingTaken(int side) {
  GroundOverrides::Patch patch{HeightMap(side, side), HeightMap(side, side)};
  for (HeightMap* map : {&patch.now, &patch.own}) {
    fillHeights(map->view(), kNone);
  }
  return patch;
}

/// No height is the same as no height.
bool isSame(float a, float b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

bool isSame(const HeightMap& a, const HeightMap& b) {
  const auto all = a.samples(), others = b.samples();
  return std::equal(all.begin(), all.end(), others.begin(), others.end(),
                    [](float one, float other) { return isSame(one, other); });
}

/// Around all samples of a patch that are not as they were then.
std::optional<SampleBox> difference(const GroundOverrides::Patch& now, const GroundOverrides::Patch& then) {
  std::optional<SampleBox> box;
  for (int y = 0; y < now.now.rows(); ++y) {
    for (int x = 0; x < now.now.columns(); ++x) {
      if (isSame(now.now(x, y), then.now(x, y))) continue;
      const SampleBox here{x, y, x, y};
      box = box ? box->joinedWith(here) : here;
    }
  }
  return box;
}

/// Joins it with one that it touches, where that hardly has more samples than both.
void addBox(std::vector<SampleBox>& boxes, const SampleBox& box) {
  const auto samples = [](const SampleBox& one) {
    return static_cast<double>(one.east - one.west + 1) * static_cast<double>(one.north - one.south + 1);
  };
  const SampleBox around{box.west - 1, box.south - 1, box.east + 1, box.north + 1};
  for (SampleBox& other : boxes) {
    const SampleBox both = other.joinedWith(box);
    if (!around.touches(other) || samples(both) > 2.0 * (samples(other) + samples(box))) continue;
    other = both;
    return;
  }
  boxes.push_back(box);
}

void addWord(Fnv1a& hash, std::uint64_t word, int bytes) {
  for (int byte = 0; byte < bytes; ++byte) hash.addByte(static_cast<std::uint8_t>(word >> (8 * byte)));
}

}  // namespace

GroundOverrides::GroundOverrides(int intervals) : bits_(std::countr_zero(static_cast<unsigned>(intervals))) {
  assert(std::has_single_bit(static_cast<unsigned>(intervals)));
}

GroundOverrides GroundOverrides::share() {
  GroundOverrides other(1 << bits_);
  for (auto& [key, held] : patches_) {
    held.isShared = true;
    other.patches_.emplace_hint(other.patches_.end(), key, held);
  }
  return other;
}

GroundOverrides GroundOverrides::shared() const {
  assert(std::all_of(patches_.begin(), patches_.end(), [](const auto& one) { return one.second.isShared; }));
  GroundOverrides other(1 << bits_);
  other.patches_ = patches_;
  return other;
}

GroundOverrides::Patch& GroundOverrides::add(const Key& key) {
  auto patch = std::make_shared<Patch>(nothingTaken(1 << bits_));
  return *patches_.emplace_hint(patches_.end(), key, Held{std::move(patch)})->second.patch;
}

GroundOverrides::Patch& GroundOverrides::changeable(Held& held) {
  if (std::exchange(held.isShared, false)) held.patch = std::make_shared<Patch>(*held.patch);
  return *held.patch;
}

void GroundOverrides::take(std::int64_t column, std::int64_t row, ConstHeightView heights,
                           ConstHeightView before) {
  assert(heights.columns() == before.columns() && heights.rows() == before.rows());
  const std::int64_t mask = (std::int64_t{1} << bits_) - 1;
  for (int y = 0; y < heights.rows(); ++y) {
    for (int x = 0; x < heights.columns();) {
      const Key key = keyOf(column + x, row + y);
      const auto end =
          static_cast<int>(std::min<std::int64_t>(((key.second + 1) << bits_) - column, heights.columns()));
      auto found = patches_.find(key);
      for (; x < end; ++x) {
        const auto ofPatchX = static_cast<int>((column + x) & mask),
                   ofPatchY = static_cast<int>((row + y) & mask);
        const float height = heights(x, y);
        const bool isKnown =
            found != patches_.end() && !std::isnan(found->second.patch->own(ofPatchX, ofPatchY));
        // What was never taken was the world's own when the surface began.
        if (!isKnown && height == before(x, y)) continue;
        if (found == patches_.end()) {
          found = patches_.emplace(key, Held{std::make_shared<Patch>(nothingTaken(1 << bits_))}).first;
        }
        const float own = isKnown ? found->second.patch->own(ofPatchX, ofPatchY) : before(x, y);
        const float now = height == own ? kNone : height;
        if (isKnown && isSame(now, found->second.patch->now(ofPatchX, ofPatchY))) continue;
        Patch& patch = changeable(found->second);
        patch.now(ofPatchX, ofPatchY) = now;
        patch.own(ofPatchX, ofPatchY) = own;
      }
    }
  }
}

std::vector<SampleBox> GroundOverrides::follow(const GroundOverrides& before) {
  std::vector<SampleBox> boxes;
  const Patch nothing = nothingTaken(1 << bits_);
  const auto compare = [&](const Key& key, const Patch& now, const Patch& then) {
    const auto box = difference(now, then);
    if (!box) return false;
    const std::int64_t west = key.second << bits_, south = key.first << bits_;
    addBox(boxes, {west + box->west, south + box->south, west + box->east, south + box->north});
    return true;
  };
  auto then = before.patches_.begin();
  auto now = patches_.begin();
  while (now != patches_.end() || then != before.patches_.end()) {
    if (now == patches_.end() || (then != before.patches_.end() && then->first < now->first)) {
      now = patches_.emplace_hint(now, then->first, Held{std::make_shared<Patch>(nothing)});
    } else if (then == before.patches_.end() || now->first < then->first) {
      compare(now->first, *now->second.patch, nothing);
      ++now;
      continue;
    }
    Held& held = now->second;
    if (held.patch != then->second.patch) {
      const bool differs = compare(now->first, *held.patch, *then->second.patch);
      remember(held, *then->second.patch);
      if (!differs && isSame(held.patch->own, then->second.patch->own)) held = {then->second.patch, true};
    }
    ++now;
    ++then;
  }
  return boxes;
}

void GroundOverrides::remember(Held& held, const Patch& before) {
  for (int y = 0; y < before.own.rows(); ++y) {
    for (int x = 0; x < before.own.columns(); ++x) {
      if (std::isnan(before.own(x, y)) || !std::isnan(held.patch->own(x, y))) continue;
      changeable(held).own(x, y) = before.own(x, y);
    }
  }
}

std::optional<float> GroundOverrides::sample(std::int64_t column, std::int64_t row) const {
  const auto found = patches_.find(keyOf(column, row));
  if (found == patches_.end()) return std::nullopt;
  const std::int64_t mask = (std::int64_t{1} << bits_) - 1;
  const float kept = found->second.patch->now(static_cast<int>(column & mask), static_cast<int>(row & mask));
  if (std::isnan(kept)) return std::nullopt;
  return kept;
}

/// Above level log2 n most patches have no sample: those are passed over, many at once.
void GroundOverrides::overlay(Over over, int level, std::int64_t column, std::int64_t row,
                              HeightView grid) const {
  if (grid.empty()) return;
  const std::int64_t n = std::int64_t{1} << bits_, beforeNext = (std::int64_t{1} << level) - 1;
  const Key first = keyOf(column << level, row << level);
  const Key last = keyOf((column + grid.columns() - 1) << level, (row + grid.rows() - 1) << level);
  for (auto found = patches_.lower_bound(first);
       found != patches_.end() && found->first.first <= last.first;) {
    const auto [j, i] = found->first;
    if (i < first.second) {
      found = patches_.lower_bound({j, first.second});
    } else if (i > last.second) {
      found = patches_.lower_bound({j + 1, first.second});
    } else if (const std::int64_t next = (j * n + beforeNext) >> level; (next << level) >> bits_ != j) {
      found = patches_.lower_bound({(next << level) >> bits_, first.second});  // no row of samples in it
    } else if (const std::int64_t east = (i * n + beforeNext) >> level; (east << level) >> bits_ != i) {
      found = patches_.lower_bound({j, (east << level) >> bits_});
    } else {
      overlayPatch(found->first, *found->second.patch, over, level, column, row, grid);
      ++found;
    }
  }
}

void GroundOverrides::overlayPatch(const Key& key, const Patch& patch, Over over, int level,
                                   std::int64_t column, std::int64_t row, HeightView grid) const {
  const std::int64_t west = key.second << bits_, south = key.first << bits_;
  const Stretch columns = samplesIn(west, 1 << bits_, level, column, grid.columns());
  const Stretch rows = samplesIn(south, 1 << bits_, level, row, grid.rows());
  for (std::int64_t y = rows.first; y <= rows.last; ++y) {
    for (std::int64_t x = columns.first; x <= columns.last; ++x) {
      const auto ofPatchX = static_cast<int>((x << level) - west),
                 ofPatchY = static_cast<int>((y << level) - south);
      float kept = patch.now(ofPatchX, ofPatchY);
      if (std::isnan(kept) && over == Over::earlier) kept = patch.own(ofPatchX, ofPatchY);
      if (!std::isnan(kept)) grid(static_cast<int>(x - column), static_cast<int>(y - row)) = kept;
    }
  }
}

std::uint64_t GroundOverrides::hash() const {
  Fnv1a hash;
  for (const auto& [key, held] : patches_) {
    const auto heights = held.patch->now.samples();
    if (std::all_of(heights.begin(), heights.end(), [](float height) { return std::isnan(height); }))
      continue;
    addWord(hash, static_cast<std::uint64_t>(key.first), 8);
    addWord(hash, static_cast<std::uint64_t>(key.second), 8);
    std::uint64_t place = 0;
    for (const float height : heights) {
      ++place;
      if (std::isnan(height)) continue;
      addWord(hash, place, 4);
      addWord(hash, std::bit_cast<std::uint32_t>(height == 0.0F ? 0.0F : height), 4);
    }
  }
  return hash.value();
}

std::size_t GroundOverrides::bytes() const noexcept {
  std::size_t sum = 0;
  for (const auto& [key, held] : patches_)
    sum += sizeof(key) + sizeof(Held) + sizeof(Patch) + held.patch->now.bytes() + held.patch->own.bytes();
  return sum;
}

}  // namespace teren
