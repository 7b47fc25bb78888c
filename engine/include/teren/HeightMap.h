// Heights on a regular grid, and views of them: what generators fill, filters change and nodes are made of.
#pragma once

#include <cassert>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

namespace teren {

/// A rectangle of heights [m] that somebody else owns: `columns` samples from west to east in each of `rows`
/// rows from south to north; consecutive rows start `stride` samples apart (stride >= columns). Copying a
/// view copies no heights. Reading or writing outside the rectangle is a broken contract (assert).
template <class Sample>
class BasicHeightView {
 public:
  BasicHeightView() = default;
  BasicHeightView(Sample* first, int columns, int rows, int stride) noexcept
      : first_(first), columns_(columns), rows_(rows), stride_(stride) {
    assert(columns >= 0 && rows >= 0 && stride >= columns);
  }
  BasicHeightView(Sample* first, int columns, int rows) noexcept
      : BasicHeightView(first, columns, rows, columns) {}
  /// A view that may write is also a view that may read.
  template <class Other, class = std::enable_if_t<std::is_same_v<Sample, const Other>>>
  BasicHeightView(const BasicHeightView<Other>& other) noexcept
      : first_(other.data()), columns_(other.columns()), rows_(other.rows()), stride_(other.stride()) {}

  int columns() const noexcept { return columns_; }
  int rows() const noexcept { return rows_; }
  int stride() const noexcept { return stride_; }
  bool empty() const noexcept { return columns_ == 0 || rows_ == 0; }
  Sample* data() const noexcept { return first_; }

  Sample* row(int y) const noexcept {
    assert(0 <= y && y < rows_);
    return first_ + static_cast<std::ptrdiff_t>(y) * stride_;
  }
  Sample& operator()(int x, int y) const noexcept {
    assert(0 <= x && x < columns_);
    return row(y)[x];
  }
  /// The part with its south-west sample at (x, y).
  BasicHeightView part(int x, int y, int columns, int rows) const noexcept {
    assert(0 <= x && 0 <= columns && x + columns <= columns_);
    assert(0 <= y && 0 <= rows && y + rows <= rows_);
    return {first_ + static_cast<std::ptrdiff_t>(y) * stride_ + x, columns, rows, stride_};
  }

 private:
  Sample* first_ = nullptr;
  int columns_ = 0;
  int rows_ = 0;
  int stride_ = 0;
};

using HeightView = BasicHeightView<float>;
using ConstHeightView = BasicHeightView<const float>;

/// A grid of heights [m] that owns its samples, contiguous, rows from south to north. Base maps are square
/// with an odd side 2^k + 1; baked pieces of landscape may have any sides. New samples are 0.
class HeightMap {
 public:
  HeightMap() = default;
  HeightMap(int columns, int rows)
      : columns_(columns),
        rows_(rows),
        samples_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {
    assert(columns >= 0 && rows >= 0);
  }

  int columns() const noexcept { return columns_; }
  int rows() const noexcept { return rows_; }
  std::size_t bytes() const noexcept { return samples_.capacity() * sizeof(float); }

  float operator()(int x, int y) const noexcept { return view()(x, y); }
  float& operator()(int x, int y) noexcept { return view()(x, y); }

  HeightView view() noexcept { return {samples_.data(), columns_, rows_}; }
  ConstHeightView view() const noexcept { return {samples_.data(), columns_, rows_}; }
  std::span<const float> samples() const noexcept { return samples_; }

 private:
  int columns_ = 0;
  int rows_ = 0;
  std::vector<float> samples_;
};

}  // namespace teren
