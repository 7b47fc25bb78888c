// The simplest task a plugin can have: it fills a map row by row and asks after each whether its slice is
// over.
#pragma once

#include <memory>
#include <utility>

#include "teren/HeightMap.h"
#include "teren/Slice.h"

namespace teren {

/// Fills a map from its southern row to its northern one: `fill(row)` writes row number `row` and must not
/// take longer than about 10 us.
template <class Fill>
class RowTask final : public SlicedTask {
 public:
  RowTask(HeightView map, Fill fill) : rows_(map.rows()), fill_(std::move(fill)) {}

  bool step(const Slice& slice) override {
    while (row_ < rows_) {
      fill_(row_++);
      if (slice.over()) break;
    }
    return row_ == rows_;
  }

 private:
  int rows_;
  Fill fill_;
  int row_ = 0;
};

template <class Fill>
std::unique_ptr<SlicedTask> makeRowTask(HeightView map, Fill fill) {
  return std::make_unique<RowTask<Fill>>(map, std::move(fill));
}

}  // namespace teren
