#include "generators/steps/Staircase.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "teren/Hash.h"
#include "teren/RowTask.h"

namespace teren {
namespace {

/// Places are counted in 2^-32 of a strip: a map of 2^k intervals, k <= 20, has all its samples on whole
/// numbers, so that every level finds each edge where the finest does.
constexpr int kPartBits = 32;

}  // namespace

Staircase::Staircase(double rise, int steps, int terraces)
    : rise_(rise), steps_(steps), terraces_(terraces), period_(2 * (steps + 1)) {
  assert(std::isfinite(rise) && rise >= 0.0);
  assert(1 <= steps && steps <= kMaxSteps);
  assert(1 <= terraces && terraces <= kMaxTerraces);
}

HeightRange Staircase::range() const noexcept {
  return {.mean = 0.0,
          .deviation = rise_ * std::sqrt(((steps_ + 1.0) * (steps_ + 1.0) - 1.0) / 12.0),
          .min = height(0),
          .max = height(steps_)};
}

float Staircase::height(std::int64_t strip) const noexcept {
  const auto place = static_cast<int>(strip % period_);
  const int climbed = place <= steps_ ? place : period_ - 1 - place;
  return static_cast<float>(rise_ * (climbed - steps_ / 2.0));
}

double Staircase::covariance(double apart) const noexcept {
  const auto whole = static_cast<std::int64_t>(apart);
  const double part = apart - static_cast<double>(whole);
  double sum = 0.0;
  for (int strip = 0; strip < period_; ++strip) {
    const double here = height(strip);
    sum += here * ((1.0 - part) * height(strip + whole) + part * height(strip + whole + 1));
  }
  return sum / period_;
}

/// The mean square of a height minus the weighted two at the ends of its interval follows from the
/// covariances of the three. The heights do not change northwards, so triangles interpolate along a row like
/// segments.
double Staircase::residual(int level, int samples) const noexcept {
  assert(level >= 0 && samples >= 1);
  if (level == 0) return 0.0;
  const int intervals = samples - 1;
  const double strips = static_cast<double>(terraces_) / intervals;  // an interval's width
  const double variance = covariance(0.0);
  double squares = 0.0;
  if (level < 31 && intervals >> level >= 2) {
    const int stride = 1 << level;
    const double ends = covariance(stride * strips);
    for (int n = 1; n < stride; ++n) {
      const double east = static_cast<double>(n) / stride, west = 1.0 - east;
      squares += (variance * (1.0 + west * west + east * east) - 2.0 * west * covariance(n * strips) -
                  2.0 * east * covariance((stride - n) * strips) + 2.0 * west * east * ends) *
                 (intervals / stride);
    }
  } else {  // the centre alone
    for (int n = 0; n < samples; ++n)
      squares += 2.0 * (variance - covariance(std::fabs(n - intervals / 2.0) * strips));
  }
  return squares > 0.0 ? std::sqrt(squares / samples) : 0.0;
}

std::unique_ptr<SlicedTask> Staircase::begin(const MapRequest& request, HeightView out) const {
  const int intervals = request.samples - 1;
  assert(out.columns() == request.samples && out.rows() == request.samples);
  assert(intervals == 0 || (std::has_single_bit(static_cast<unsigned>(intervals)) && intervals <= 1 << 20));
  const std::int64_t across = std::int64_t{terraces_} << kPartBits;
  const std::int64_t interval = intervals == 0 ? 0 : across / intervals;
  const std::int64_t shift = static_cast<std::int64_t>(RandomSequence(request.seed).next() %
                                                       (static_cast<std::uint64_t>(period_) << kPartBits));
  const std::int64_t west = intervals == 0 ? shift + across / 2 : shift;
  return makeRowTask(out, [staircase = *this, out, west, interval](int row) {
    if (row > 0) {  // all rows are alike
      std::copy_n(out.row(0), out.columns(), out.row(row));
      return;
    }
    for (int column = 0; column < out.columns(); ++column)
      out(column, row) = staircase.height((west + interval * column) >> kPartBits);
  });
}

}  // namespace teren
