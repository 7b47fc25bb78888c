// The band filter: takes the sharpness off a height map, as rain and frost do with fresh faults.
#pragma once

#include <memory>

#include "teren/Generator.h"

namespace teren {

/// The published first-order filter h[x] = h[x-1] (1 - k) + h[x] k, over every row eastwards and westwards
/// and then over every column northwards and southwards, `passes` times; the first sample of a sweep stays.
/// It is computed in float as h[x] + (1 - k) (h[x-1] - h[x]), the same number, because so a flat map stays
/// flat to the bit and k = 1 changes nothing. Lower k or more passes smooth more; the cost grows with passes
/// * samples.
///
/// Every result is a weighted mean of the map's heights, weights >= 0; both directions together shift
/// nothing. Immutable; any number of tasks may run at once, on any threads.
class BandFilter {
 public:
  static constexpr double kMinK = 0.01;
  static constexpr int kMaxPasses = 100;

  /// k: kMinK ... 1; passes: 1 ... kMaxPasses. Anything else is a broken contract.
  BandFilter(double k, int passes);

  float remainder() const noexcept { return remainder_; }  ///< 1 - k
  int passes() const noexcept { return passes_; }

  /// How far a result may lie from the filter in exact arithmetic, in parts of the largest |height|: each of
  /// 4 * passes sweeps adds at most 5 half-units in the last place per sample, and remembers 1 / k of them.
  double roundingBound() const noexcept;

  /// Filter::range. The mean stays; the deviation, of a weighted mean, can only shrink; bounds stay but for
  /// rounding.
  HeightRange range(const HeightRange& before) const noexcept;

  /// Filter::residual, but against what is drawn: the filter run on the level's coarse map. An upper bound
  /// for maps as rough as faults or rougher. On smoother maps, whose residual is small before, it may be too
  /// low.
  double residual(double before, int level) const noexcept;

  /// Begins filtering `inOut`, of any sides; Filter::begin. The task does not allocate once it is begun.
  std::unique_ptr<SlicedTask> begin(HeightView inOut) const;

 private:
  double k_;
  float remainder_;
  int passes_;
};

}  // namespace teren
