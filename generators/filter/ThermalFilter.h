// Thermal erosion: ground steeper than loose rock can lie slides down, a little in each pass, until slopes of
// scree are left.
#pragma once

#include <memory>

#include "teren/Generator.h"

namespace teren {

/// What may stay between neighbours [m]: beside each other, and on a diagonal.
struct ThermalLimits {
  float straight, diagonal;
};

/// The excess of a difference of heights over what may stay: nothing from -most to most. Odd to the bit, so
/// that what one sample gains the other loses.
inline float thermalExcess(float difference, float most) noexcept {
  const float low = difference < -most ? -most : difference;
  return difference - (low > most ? most : low);
}

/// A height after a pass, from the excesses of its neighbours over it. Opposite ones are added first, so that
/// a mirrored map becomes the mirrored result.
inline float thermalHeight(float height, float west, float east, float south, float north, float southWest,
                           float northEast, float southEast, float northWest) noexcept {
  const float beside = (west + east) + (south + north);
  const float diagonal = (southWest + northEast) + (southEast + northWest);
  return height + 0.125f * (beside + diagonal);
}

/// In every pass each sample gives to each of its eight neighbours that lies lower than the talus angle
/// allows an eighth of the excess: of the difference of their heights beyond the tangent times their distance
/// (spacing, or sqrt 2 times that on a diagonal). All samples move at once, from the heights before the pass.
/// So a pass makes every height a mean of the neighbourhood's with weights >= 0, and what one gains another
/// loses. Nothing leaves a map: at the rims there are fewer neighbours. (After
/// Musgrave, Kolb and Mace 1989, who move material to one neighbour after the other; here the order of
/// samples does not matter.) More passes bring the ground nearer to rest; the cost grows with passes *
/// samples.
///
/// Sums are made in float. Immutable; any number of tasks may run at once, on any threads.
class ThermalFilter {
 public:
  static constexpr double kMaxTalus = 89.0;
  static constexpr int kMaxPasses = 1000;

  /// talus [degree]: 0 ... kMaxTalus; passes: 1 ... kMaxPasses. Anything else is a broken contract.
  ThermalFilter(double talus, int passes);

  int passes() const noexcept { return passes_; }
  /// For a map with this spacing [m, > 0, finite].
  ThermalLimits limits(double spacing) const noexcept;

  /// By how much rounding may move a height in all passes, in parts of the largest |height|: a pass rounds
  /// eight differences and their sum, and the new height. So far may a height leave its range, and so much
  /// may the mean of a map change, at most; roundings go either way, so the mean of a map of 257 a side is
  /// found to change by less than 1 / 257 of it.
  double roundingBound() const noexcept;

  /// Filter::range. Bounds stay, but for rounding, for every height becomes a mean of heights. The mean of a
  /// map stays; the mean at every sample stays where heights so much above it and so much below are equally
  /// likely. Summed over a map, squared differences from any height only shrink, so the deviation does on
  /// average over the map.
  HeightRange range(const HeightRange& before) const noexcept;

  /// Filter::residual, but against what is drawn: the filter run on the level's coarse map. What it becomes
  /// depends on how much is steeper than the talus angle: of faults, between a third of `before` and this
  /// bound, sqrt(1 + 1.5 sqrt(passes)) times `before`, which is nearly met where all is. For maps as rough as
  /// faults or rougher; on smoother maps, whose residual is small before, it may be too low.
  double residual(double before, int level) const noexcept;

  /// Begins filtering `inOut`, of any sides, `spacing` [m, > 0, finite] between samples; Filter::begin. The
  /// task allocates two rows when it is begun and never again; it asks whether its slice is over after every
  /// row, 0.1 to 4 us (at a side of 2049).
  std::unique_ptr<SlicedTask> begin(double spacing, HeightView inOut) const;

 private:
  double slope_;  // the tangent of the talus angle
  int passes_;
};

}  // namespace teren
