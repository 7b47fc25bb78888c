// Terraces that climb eastwards to the highest and go down again, endlessly: ground whose every figure is
// known exactly.
#pragma once

#include <cstdint>
#include <memory>

#include "teren/Generator.h"

namespace teren {

/// A base map is crossed from west to east by `terraces` level strips of equal width. Over steps + 1 of them
/// the ground climbs by `rise` from each to the next, over the next steps + 1 it goes down again; the two
/// highest and the two lowest strips of a period touch. Where in this period of 2 (steps + 1) strips a map
/// begins is drawn from its seed, uniformly; so at every sample each height is equally likely, the mean is 0
/// and the deviation rise * sqrt(((steps + 1)^2 - 1) / 12), that of a fair die.
///
/// Work: proportional to the samples. Immutable; any number of tasks may run at once, on any threads.
class Staircase {
 public:
  static constexpr int kMaxSteps = 63;
  static constexpr int kMaxTerraces = 4096;

  /// rise [m]: finite, >= 0; steps: 1 ... kMaxSteps; terraces: 1 ... kMaxTerraces. Anything else is a broken
  /// contract.
  Staircase(double rise, int steps, int terraces);

  /// Exact.
  HeightRange range() const noexcept;

  /// Generator::residual, exact over all seeds but for rounding, which near 0 leaves at most 1e-7 of the
  /// deviation. Costs up to (steps + 1) * samples covariances.
  double residual(int level, int samples) const noexcept;

  /// Begins a map; Generator::begin. request.samples is 1 or 2^k + 1 with k <= 20. Does not allocate later.
  std::unique_ptr<SlicedTask> begin(const MapRequest& request, HeightView out) const;

 private:
  /// Of a strip, counted eastwards from the first of the lowest two that is reached going up, >= 0.
  float height(std::int64_t strip) const noexcept;

  /// Over all seeds, of the heights at two places so many strips apart (>= 0): linear between whole numbers.
  double covariance(double apart) const noexcept;

  double rise_;
  int steps_, terraces_, period_;
};

}  // namespace teren
