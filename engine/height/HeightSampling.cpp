#include "teren/HeightSampling.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "teren/HeightMapOperations.h"

#include "height/CubicInterpolation.h"
#include "height/Overlap.h"
#include "height/Surface.h"

namespace teren {

namespace {

/// The two samples around a place of an axis and how far the place lies from the lower one, 0 ... 1.
struct LinearTaps {
  int low = 0, high = 0;
  double fraction = 0.0;
};

/// A place as a number in [0, samples - 1]; NaN for NaN.
double clamped(double place, int samples) noexcept {
  return std::min(std::max(place, 0.0), static_cast<double>(samples - 1));
}

LinearTaps linearTaps(double place, int samples) noexcept {
  const int low = static_cast<int>(place);
  return {low, std::min(low + 1, samples - 1), place - low};
}

CubicTaps smoothTaps(double place, int samples) noexcept {
  if (samples == 1) return {{0, 0, 0, 0}, {0.0, 1.0, 0.0, 0.0}};
  return cubicTaps(place, samples);
}

double triangles(ConstHeightView heights, const LinearTaps& x, const LinearTaps& y) noexcept {
  const SquareHeights corner{heights(x.low, y.low), heights(x.high, y.low), heights(x.low, y.high),
                             heights(x.high, y.high)};
  return sampleTriangle(corner, x.fraction, y.fraction).height;
}

double between(double low, double high, double fraction) noexcept {
  return (1.0 - fraction) * low + fraction * high;
}

double bilinear(ConstHeightView heights, const LinearTaps& x, const LinearTaps& y) noexcept {
  const auto along = [&](int row) { return between(heights(x.low, row), heights(x.high, row), x.fraction); };
  return between(along(y.low), along(y.high), y.fraction);
}

double bicubic(ConstHeightView heights, const CubicTaps& x, const CubicTaps& y) noexcept {
  const auto along = [&](std::size_t tap) { return combineAlong(x, heights.row(y.index[tap])); };
  return combine(y.weight, along(0), along(1), along(2), along(3));
}

template <class Taps>
using MakeTaps = Taps (*)(double place, int samples) noexcept;
template <class Taps>
using Sample = double (*)(ConstHeightView heights, const Taps& x, const Taps& y) noexcept;

template <class Taps>
double sampleAt(ConstHeightView heights, double x, double y, MakeTaps<Taps> taps,
                Sample<Taps> sample) noexcept {
  if (heights.empty() || std::isnan(x) || std::isnan(y)) return std::numeric_limits<double>::quiet_NaN();
  return sample(heights, taps(clamped(x, heights.columns()), heights.columns()),
                taps(clamped(y, heights.rows()), heights.rows()));
}

/// Where sample k of an axis of `count` samples lies among `sourceCount`.
double placeOf(int k, int count, int sourceCount) noexcept {
  if (count == 1) return 0.5 * (sourceCount - 1);
  return static_cast<double>(k) * (sourceCount - 1) / (count - 1);
}

template <class Taps>
void fill(ConstHeightView source, HeightView target, MakeTaps<Taps> taps, Sample<Taps> sample) {
  std::vector<Taps> columns;
  columns.reserve(static_cast<std::size_t>(target.columns()));
  for (int x = 0; x < target.columns(); ++x) {
    columns.push_back(taps(placeOf(x, target.columns(), source.columns()), source.columns()));
  }
  for (int y = 0; y < target.rows(); ++y) {
    const Taps row = taps(placeOf(y, target.rows(), source.rows()), source.rows());
    float* const heights = target.row(y);
    for (std::size_t x = 0; x < columns.size(); ++x) {
      heights[x] = static_cast<float>(sample(source, columns[x], row));
    }
  }
}

/// The slope per spacing along an axis, from the neighbours that are there.
template <class HeightAt>
double slope(HeightAt heightAt, int place, int samples) noexcept {
  const int low = std::max(place - 1, 0), high = std::min(place + 1, samples - 1);
  if (low == high) return 0.0;
  return (static_cast<double>(heightAt(high)) - static_cast<double>(heightAt(low))) / (high - low);
}

}  // namespace

double triangleHeight(ConstHeightView heights, double x, double y) noexcept {
  return sampleAt<LinearTaps>(heights, x, y, linearTaps, triangles);
}

double bilinearHeight(ConstHeightView heights, double x, double y) noexcept {
  return sampleAt<LinearTaps>(heights, x, y, linearTaps, bilinear);
}

double bicubicHeight(ConstHeightView heights, double x, double y) noexcept {
  return sampleAt<CubicTaps>(heights, x, y, smoothTaps, bicubic);
}

void resample(ConstHeightView source, HeightView target, Interpolation interpolation) {
  assert(!overlapping(source, target));
  if (source.empty()) {
    fillHeights(target, std::numeric_limits<float>::quiet_NaN());
    return;
  }
  switch (interpolation) {
    case Interpolation::triangles:
      return fill<LinearTaps>(source, target, linearTaps, triangles);
    case Interpolation::bilinear:
      return fill<LinearTaps>(source, target, linearTaps, bilinear);
    case Interpolation::bicubic:
      return fill<CubicTaps>(source, target, smoothTaps, bicubic);
  }
}

std::array<double, 3> normalAt(ConstHeightView heights, int column, int row, double spacing) noexcept {
  assert(0 <= column && column < heights.columns() && 0 <= row && row < heights.rows());
  const double x = slope([&](int at) { return heights(at, row); }, column, heights.columns());
  const double y = slope([&](int at) { return heights(column, at); }, row, heights.rows());
  return faceNormal({heights(column, row), x, y}, spacing);
}

}  // namespace teren
