#include "generators/filter/ThermalFilter.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "generators/numbers/Tangent.h"

namespace teren {
namespace {

/// Three rows of heights before the pass, and what may stay between the middle one and the others. A row that
/// is not there is replaced by the middle one, and everything may stay.
struct Neighbourhood {
  const float *south, *here, *north;
  ThermalLimits southern, own, northern;
};

/// The height a pass gives to column x, which has neighbours on both sides.
inline float eroded(const Neighbourhood& rows, int x) noexcept {
  const float height = rows.here[x];
  const float west = thermalExcess(rows.here[x - 1] - height, rows.own.straight);
  const float east = thermalExcess(rows.here[x + 1] - height, rows.own.straight);
  const float south = thermalExcess(rows.south[x] - height, rows.southern.straight);
  const float north = thermalExcess(rows.north[x] - height, rows.northern.straight);
  const float southWest = thermalExcess(rows.south[x - 1] - height, rows.southern.diagonal);
  const float northEast = thermalExcess(rows.north[x + 1] - height, rows.northern.diagonal);
  const float southEast = thermalExcess(rows.south[x + 1] - height, rows.southern.diagonal);
  const float northWest = thermalExcess(rows.north[x - 1] - height, rows.northern.diagonal);
  return thermalHeight(height, west, east, south, north, southWest, northEast, southEast, northWest);
}

/// The same for the first and the last column.
float erodedAtRim(const Neighbourhood& rows, int x, int columns) noexcept {
  const float height = rows.here[x];
  const auto excess = [&](const float* row, int column, float most) {
    return 0 <= column && column < columns ? thermalExcess(row[column] - height, most) : 0.0f;
  };
  return thermalHeight(
      height, excess(rows.here, x - 1, rows.own.straight), excess(rows.here, x + 1, rows.own.straight),
      excess(rows.south, x, rows.southern.straight), excess(rows.north, x, rows.northern.straight),
      excess(rows.south, x - 1, rows.southern.diagonal), excess(rows.north, x + 1, rows.northern.diagonal),
      excess(rows.south, x + 1, rows.southern.diagonal), excess(rows.north, x - 1, rows.northern.diagonal));
}

/// Bound by arithmetic: about 45 operations a sample, which compilers do four samples at a time.
void erodeRow(const Neighbourhood rows, int columns, float* __restrict out) noexcept {
  for (int x = 1; x < columns - 1; ++x) out[x] = eroded(rows, x);
  out[0] = erodedAtRim(rows, 0, columns);
  out[columns - 1] = erodedAtRim(rows, columns - 1, columns);
}

/// Rows from south to north, pass by pass. A row is kept before it is changed, for itself and for the next.
class ThermalTask final : public SlicedTask {
 public:
  ThermalTask(const ThermalLimits& limits, int passes, HeightView map)
      : limits_(limits),
        passes_(map.empty() ? 0 : passes),
        map_(map),
        kept_(2 * static_cast<std::size_t>(map.columns())) {}

  bool step(const Slice& slice) override {
    do {
      if (pass_ < passes_) changeRow();
      if (pass_ == passes_) return true;
    } while (!slice.over());
    return false;
  }

 private:
  void changeRow() {
    constexpr float kAll = std::numeric_limits<float>::infinity();
    float* const heights = map_.row(row_);
    const float* const here = std::copy_n(heights, map_.columns(), kept(row_)) - map_.columns();
    const bool first = row_ == 0, last = row_ == map_.rows() - 1;
    const ThermalLimits none{kAll, kAll};
    erodeRow({.south = first ? here : kept(row_ - 1),
              .here = here,
              .north = last ? here : map_.row(row_ + 1),
              .southern = first ? none : limits_,
              .own = limits_,
              .northern = last ? none : limits_},
             map_.columns(), heights);
    if (!last) {
      ++row_;
    } else {
      row_ = 0;
      ++pass_;
    }
  }

  float* kept(int row) { return kept_.data() + static_cast<std::ptrdiff_t>(row % 2) * map_.columns(); }

  ThermalLimits limits_;
  int passes_;
  HeightView map_;
  std::vector<float> kept_;  // the current row and the one south of it, before this pass
  int pass_ = 0, row_ = 0;
};

}  // namespace

ThermalFilter::ThermalFilter(double talus, int passes) : slope_(tangentOfDegrees(talus)), passes_(passes) {
  assert(0.0 <= talus && talus <= kMaxTalus);
  assert(1 <= passes && passes <= kMaxPasses);
}

ThermalLimits ThermalFilter::limits(double spacing) const noexcept {
  assert(std::isfinite(spacing) && spacing > 0.0);
  const double straight = slope_ * spacing;
  return {static_cast<float>(straight), static_cast<float>(straight * 1.4142135623730951)};
}

/// With M the largest |height| and half a unit in the last place u = 2^-24: a difference is up to 2 M, wrong
/// by 2 M u, and so is its excess; three levels of sums add 3 u of their sizes, up to 16 M; an eighth of all
/// that is 8 M u, and the new height is rounded by M u. The tenth is for what M itself has grown by in
/// passes.
double ThermalFilter::roundingBound() const noexcept {
  return 10.0 * 0x1p-24 * passes_;
}

HeightRange ThermalFilter::range(const HeightRange& before) const noexcept {
  const double rounding = roundingBound() * std::max(std::fabs(before.min), std::fabs(before.max));
  return {.mean = before.mean,
          .deviation = before.deviation,
          .min = before.min - rounding,
          .max = before.max + rounding};
}

/// Where all is steeper, a pass is the mean of the eight neighbours, which spreads a sample with variance 3/4
/// [samples^2] along each axis; as with the band filter (BandFilter.cpp) the coarse map's filter then moves a
/// height by about sqrt(spread * spacing), hence 1 + c * sqrt(passes). c = 1.5 is at or above all that was
/// measured of 150 faults on maps of 129 a side, 2 m apart: deviations of 4, 40 and 400 m, talus 0 to 60
/// degrees, 1 to 500 passes, levels 1 to 5.
double ThermalFilter::residual(double before, int) const noexcept {
  return before * std::sqrt(1.0 + 1.5 * std::sqrt(passes_));
}

std::unique_ptr<SlicedTask> ThermalFilter::begin(double spacing, HeightView inOut) const {
  return std::make_unique<ThermalTask>(limits(spacing), passes_, inOut);
}

}  // namespace teren
