#include "edits/LooseLayer.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "teren/Deformer.h"
#include "teren/HeightMapOperations.h"

namespace teren {

namespace {

bool isNothing(const HeightMap& depths) {
  const auto all = depths.samples();
  return std::all_of(all.begin(), all.end(), [](float depth) { return depth == 0.0F; });
}

}  // namespace

LooseLayer::LooseLayer(int intervals) : bits_(std::countr_zero(static_cast<unsigned>(intervals))) {
  assert(std::has_single_bit(static_cast<unsigned>(intervals)));
}

/// Calls visit(key, part of the view, part of the patch) for each patch of a view.
template <class Visitor>
void LooseLayer::forEachPart(std::int64_t column, std::int64_t row, int columns, int rows,
                             Visitor&& visit) const {
  const std::int64_t n = std::int64_t{1} << bits_;
  for (std::int64_t j = row >> bits_; j << bits_ < row + rows; ++j) {
    for (std::int64_t i = column >> bits_; i << bits_ < column + columns; ++i) {
      const std::int64_t west = std::max(i * n, column), east = std::min((i + 1) * n, column + columns);
      const std::int64_t south = std::max(j * n, row), north = std::min((j + 1) * n, row + rows);
      const int width = static_cast<int>(east - west), height = static_cast<int>(north - south);
      visit(Key{j, i},
            SampleRectangle{static_cast<int>(west - column), static_cast<int>(south - row), width, height},
            SampleRectangle{static_cast<int>(west - i * n), static_cast<int>(south - j * n), width, height});
    }
  }
}

void LooseLayer::take(std::int64_t column, std::int64_t row, ConstHeightView depths) {
  const int n = 1 << bits_;
  forEachPart(
      column, row, depths.columns(), depths.rows(),
      [&](const Key& key, const SampleRectangle& from, const SampleRectangle& to) {
        const auto found = patches_.find(key);
        HeightMap patch(n, n);
        if (found != patches_.end()) patch = *found->second;
        copyHeights(depths.part(from.column, from.row, from.columns, from.rows),
                    patch.view().part(to.column, to.row, to.columns, to.rows));
        assert(std::ranges::all_of(patch.samples(), [](float d) { return std::isfinite(d) && d >= 0.0F; }));
        if (!isNothing(patch)) {
          patches_[key] = std::make_shared<const HeightMap>(std::move(patch));
        } else if (found != patches_.end()) {
          patches_.erase(found);
        }
      });
}

bool LooseLayer::overlay(std::int64_t column, std::int64_t row, HeightView grid) const {
  bool isAny = false;
  if (patches_.empty()) return isAny;
  forEachPart(column, row, grid.columns(), grid.rows(),
              [&](const Key& key, const SampleRectangle& to, const SampleRectangle& from) {
                const auto found = patches_.find(key);
                if (found == patches_.end()) return;
                isAny = true;
                copyHeights(
                    std::as_const(*found->second).view().part(from.column, from.row, from.columns, from.rows),
                    grid.part(to.column, to.row, to.columns, to.rows));
              });
  return isAny;
}

void LooseLayer::add(const Key& key, HeightMap depths) {
  assert(!isNothing(depths) && (patches_.empty() || patches_.rbegin()->first < key));
  patches_.emplace_hint(patches_.end(), key, std::make_shared<const HeightMap>(std::move(depths)));
}

std::size_t LooseLayer::bytes() const noexcept {
  std::size_t sum = 0;
  for (const auto& [key, patch] : patches_)
    sum += sizeof(key) + sizeof(patch) + sizeof(*patch) + patch->bytes();
  return sum;
}

}  // namespace teren
