// Ground for deformers that work on the grid itself: heights to be changed, and snapshots that share what has
// not changed. With it, a deformer is a few lines (doc/writing-a-plugin.md).
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "teren/Deformer.h"
#include "teren/HeightMap.h"

namespace teren {

/// Heights of a region [m], in double, so that much work on them in small parts loses little; what is read
/// from outside is rounded to float once. 12 bytes a sample, and 4 more of each row that a snapshot still in
/// use holds as it was. One thread at a time; snapshots are any thread's.
class DeformGrid {
 public:
  /// Copies `ground`, which has as many samples as the region (assert).
  DeformGrid(const DeformRegion& region, ConstHeightView ground)
      : region_(region),
        changeable_(region.changeable()),
        heights_(static_cast<std::size_t>(region.sampleColumns()) *
                 static_cast<std::size_t>(region.sampleRows())),
        rows_(static_cast<std::size_t>(region.sampleRows())) {
    assert(ground.columns() == region.sampleColumns() && ground.rows() == region.sampleRows());
    for (int y = 0; y < ground.rows(); ++y) std::copy_n(ground.row(y), ground.columns(), &heights_[at(0, y)]);
  }

  const DeformRegion& region() const noexcept { return region_; }

  double operator()(int x, int y) const noexcept { return heights_[at(x, y)]; }

  /// Changes a sample inside the collar (DeformRegion::changeable) to a finite height; anything else is a
  /// broken contract (assert).
  void set(int x, int y, double height) noexcept {
    assert(changeable_.contains(x, y) && std::isfinite(height));
    heights_[at(x, y)] = height;
    rows_[static_cast<std::size_t>(y)].reset();
    west_ = std::min(west_, x);
    east_ = std::max(east_, x + 1);
    south_ = std::min(south_, y);
    north_ = std::max(north_, y + 1);
  }

  /// O(rows, and the samples of those that changed since the last one).
  std::shared_ptr<const DeformedGround> snapshot() {
    for (int y = 0; y < region_.sampleRows(); ++y) {
      std::shared_ptr<const Row>& row = rows_[static_cast<std::size_t>(y)];
      if (row != nullptr) continue;
      Row heights(static_cast<std::size_t>(region_.sampleColumns()));
      std::transform(&heights_[at(0, y)], &heights_[at(0, y)] + heights.size(), heights.begin(),
                     [](double height) { return static_cast<float>(height); });
      row = std::make_shared<const Row>(std::move(heights));
    }
    return std::make_shared<const Ground>(region_, rows_, changed());
  }

  /// LiveSurface::grow: heights stay, and around them is `ground`.
  void grow(const DeformRegion& region, ConstHeightView ground) {
    const SampleRectangle place = region.placeOf(region_);
    DeformGrid larger(region, ground);
    for (int y = 0; y < place.rows; ++y) {
      std::copy_n(&heights_[at(0, y)], place.columns,
                  &larger.heights_[larger.at(place.column, place.row + y)]);
    }
    if (east_ > west_) {
      larger.west_ = west_ + place.column;
      larger.east_ = east_ + place.column;
      larger.south_ = south_ + place.row;
      larger.north_ = north_ + place.row;
    }
    *this = std::move(larger);
  }

  /// LiveSurface::merge, of a grid that has grown: takes what another one has changed.
  void take(const DeformGrid& other) {
    const SampleRectangle place = region_.placeOf(other.region_), part = other.changed();
    for (int y = part.row; y < part.row + part.rows; ++y) {
      for (int x = part.column; x < part.column + part.columns; ++x) {
        set(place.column + x, place.row + y, other(x, y));
      }
    }
  }

  /// What `set` was ever called for.
  SampleRectangle changed() const noexcept {
    if (east_ <= west_) return {};
    return {west_, south_, east_ - west_, north_ - south_};
  }

  std::size_t bytes() const noexcept {
    return sizeof(*this) + heights_.capacity() * sizeof(double) + rows_.capacity() * sizeof(rows_[0]) +
           rows_.size() * (sizeof(Row) + static_cast<std::size_t>(region_.sampleColumns()) * sizeof(float));
  }

 private:
  using Row = std::vector<float>;
  using Rows = std::vector<std::shared_ptr<const Row>>;

  class Ground final : public DeformedGround {
   public:
    Ground(const DeformRegion& region, Rows rows, const SampleRectangle& changed)
        : region_(region), rows_(std::move(rows)), changed_(changed) {}

    double height(double east, double north) const override {
      const double x = east / region_.spacing, y = north / region_.spacing;
      assert(0.0 <= x && x <= region_.sampleColumns() - 1 && 0.0 <= y && y <= region_.sampleRows() - 1);
      const int column = std::min(static_cast<int>(x), region_.sampleColumns() - 2);
      const int row = std::min(static_cast<int>(y), region_.sampleRows() - 2);
      const double u = x - column, v = y - row;
      const double southWest = at(column, row), northEast = at(column + 1, row + 1);
      const double corner = u >= v ? at(column + 1, row) : at(column, row + 1);
      return southWest + (std::max(u, v) * (corner - southWest) + std::min(u, v) * (northEast - corner));
    }

    void samples(const SampleRectangle& rectangle, HeightView out) const override {
      assert(out.columns() == rectangle.columns && out.rows() == rectangle.rows);
      for (int y = 0; y < rectangle.rows; ++y) {
        const float* const row = rows_[static_cast<std::size_t>(rectangle.row + y)]->data();
        std::copy_n(row + rectangle.column, rectangle.columns, out.row(y));
      }
    }

    SampleRectangle changed() const override { return changed_; }

   private:
    double at(int x, int y) const {
      return (*rows_[static_cast<std::size_t>(y)])[static_cast<std::size_t>(x)];
    }

    DeformRegion region_;
    Rows rows_;
    SampleRectangle changed_;
  };

  std::size_t at(int x, int y) const noexcept {
    assert(0 <= x && x < region_.sampleColumns() && 0 <= y && y < region_.sampleRows());
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(region_.sampleColumns()) +
           static_cast<std::size_t>(x);
  }

  DeformRegion region_;
  SampleRectangle changeable_;
  std::vector<double> heights_;
  Rows rows_;  // as the last snapshot has them; null where a row has changed since
  int west_ = 1 << 30, east_ = 0, south_ = 1 << 30, north_ = 0;
};

}  // namespace teren
