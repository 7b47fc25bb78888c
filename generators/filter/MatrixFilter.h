// The matrix filter: every sample becomes a weighted mean of those around it, which smooths, sharpens or
// shifts a height map as its matrix says.
#pragma once

#include <memory>
#include <utility>

#include "teren/Generator.h"

#include "generators/filter/FilterMatrix.h"

namespace teren {

/// Applies a FilterMatrix to a whole map, `passes` times, each pass to the result of the one before. Sums are
/// made in double, as the matrix is written (from north to south, each row from west to east), multiplied by
/// the reciprocal of the sum of the used elements, and rounded once to float; so a flat map stays flat to the
/// bit, and a matrix of one element changes nothing. The cost grows with passes * side^2 * samples.
/// Immutable; any number of tasks may run at once, on any threads.
class MatrixFilter {
 public:
  static constexpr int kMaxPasses = 100;
  /// How much all passes together may magnify.
  static constexpr double kMaxTotalGain = 1e6;

  /// Refuses passes other than 1 ... kMaxPasses and a total gain, matrix.gain() to the power of passes,
  /// beyond kMaxTotalGain.
  static Result<MatrixFilter> make(FilterMatrix matrix, int passes);

  const FilterMatrix& matrix() const noexcept { return matrix_; }
  int passes() const noexcept { return passes_; }
  /// The most by which heights, measured from any level, can grow.
  double totalGain() const noexcept { return totalGain_; }

  /// How far a result may lie from the filter in exact arithmetic, in parts of the largest |height|: each
  /// pass rounds to half a unit in a float's last place and magnifies what was wrong before. 2^-140 m are to
  /// be added, for heights so small that floats have fewer digits.
  double roundingBound() const noexcept;

  /// Filter::range. The mean stays, for the weights of every mean sum to 1. With weights of sizes that sum to
  /// g, heights in [min, max] become heights in [min - w, max + w], w = (g - 1) / 2 * (max - min), which is
  /// the sharpest bound; and the deviation grows to g times itself at most, if all samples vary together.
  HeightRange range(const HeightRange& before) const noexcept;

  /// Filter::residual, but against what is drawn: the filter run on the level's coarse map, where the same
  /// matrix reaches 2^level times as far. Derived in the source file: an upper bound, away from the rims,
  /// for maps as rough as faults or rougher, 1 to 3.5 times what was measured of faults. On smoother
  /// maps, whose residual is small before, it may be too low.
  double residual(double before, int level) const noexcept;

  /// Begins filtering `inOut`, of any sides; Filter::begin. The task allocates radius + 1 rows and a few KiB
  /// when it is begun and never again; it asks whether its slice is over about every 3 us.
  std::unique_ptr<SlicedTask> begin(HeightView inOut) const;

 private:
  MatrixFilter(FilterMatrix matrix, int passes, double totalGain)
      : matrix_(std::move(matrix)), passes_(passes), totalGain_(totalGain) {}

  FilterMatrix matrix_;
  int passes_;
  double totalGain_;
};

}  // namespace teren
