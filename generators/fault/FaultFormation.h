// Fault formation: ground cracked along random straight lines, each moving its two sides apart. Few large
// faults draw the character of the land, many small ones its detail.
#pragma once

#include <cstdint>
#include <memory>

#include "teren/Generator.h"

namespace teren {

/// The published method (pick two random points, raise one side of their line, about 150 times with a step
/// that shrinks) with three changes: both sides move, so that the mean does not drift; the steps are the
/// integers faults, faults - 1 ... 1, so that sums are exact whatever their order; and the result is scaled
/// by the known law of the sum, never by measuring the map.
///
/// The sum at a point is a sum of independent terms +-d, d = faults ... 1, each sign a fair coin. So over all
/// seeds its mean is 0 and its variance is N (N + 1) (2 N + 1) / 6, exactly and at every point;
/// height = deviation / sqrt(variance) * sum, computed in double and rounded once to float.
///
/// Work: proportional to faults * side + side^2, where the plain way (FaultReference.h) costs
/// faults * side^2. A task asks whether its slice is over every 0.5 to 4 us (25 us at a side of 2049).
/// Immutable; any number of tasks may run at once, on any threads.
class FaultFormation {
 public:
  static constexpr int kMaxFaults = 65535;  ///< the largest whose sum fits 32 bits

  /// faults: 1 ... kMaxFaults; deviation [m]: finite, >= 0. Anything else is a broken contract.
  FaultFormation(int faults, double deviation);

  int faults() const noexcept { return faults_; }
  double metresPerStep() const noexcept { return metresPerStep_; }  ///< height = this * sum

  /// The exact mean and deviation over all seeds; min and max are what the sum of all steps would give.
  HeightRange range() const noexcept;

  /// Generator::residual, derived in the source file; within a factor 1.5 of what is measured while the
  /// level still has 3 samples a side or more. Beyond, the only sample is the centre and the law only says
  /// how far the map lies from that one height.
  double residual(int level, int samples) const noexcept;

  /// Begins a map; Generator::begin. request.samples is 1 or 2^k + 1 with k <= kFaultUnitBits, `out` has
  /// that side. The task allocates (32 bytes a fault, 132 a column) when it is begun and never again.
  std::unique_ptr<SlicedTask> begin(const MapRequest& request, HeightView out) const;

 private:
  int faults_;
  double deviation_;
  double metresPerStep_;
};

}  // namespace teren
