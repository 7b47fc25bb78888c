// Evens ground out under a round tool: heat flow from sample to sample, in steps of one pass each.
#pragma once

#include <vector>

#include "teren/DeformGrid.h"

namespace teren {

/// In a step, h grows by the sum over its four neighbours of w (h' - h) / 8, all from the heights before the
/// step (explicit Euler). w is (1 - q)^2 in the middle between the two, q the squared distance from the
/// tool's middle in parts of its radius squared, and 0 beyond: firm in the middle, soft at the rim. Every
/// height becomes a mean of itself (at least half) and its neighbours with weights >= 0, so no ground,
/// however rough, is swung over, and nothing leaves the range of the heights before. What crosses between two
/// samples one gains and the other loses, to the bit: only the sums are rounded.
///
/// In the middle, N steps blur like a Gaussian of standard deviation sqrt(N) / 2 samples.
class Smoothing {
 public:
  /// More than a gentle hand needs; an upper bound of what one stamp may cost.
  static constexpr int kMostSteps = 1024;
  static constexpr double kMostSamples = 16.0;  ///< the standard deviation of so many steps [samples]

  /// By how much the sum of all heights may change in a step, at most, in parts of the number of samples
  /// within the tool times the largest |height|: each rounds three sums of sizes up to 1/2, 3/4 and 1 and its
  /// new height.
  static constexpr double kVolumeError = 3.5 * 0x1p-53;

  /// Steps that blur with a standard deviation of `samples` or a little more, at least 1; 0 <= samples <=
  /// kMostSamples.
  static int stepsFor(double samples) noexcept;

  /// [m] from the tool's middle where nothing changes any more: samples half a cell beyond the radius may
  /// still be one side of a place within it.
  static double reach(double radius, double spacing) noexcept { return radius + 0.5 * spacing; }

  /// east, north, radius [m], radius > 0; what is within reach lies inside the grid's collar; 1 ...
  /// kMostSteps steps.
  Smoothing(const DeformRegion& region, double east, double north, double radius, int steps);

  /// Works at the current step, one row of samples (at most some microseconds for a thousand). True: that was
  /// its last row.
  bool row(DeformGrid& grid);
  int stepsLeft() const noexcept { return steps_; }

  std::size_t bytes() const noexcept {
    return sizeof(*this) + (here_.capacity() + south_.capacity()) * sizeof(double);
  }

 private:
  /// 1/8 of the weight in the middle between two samples, at (x, y) in halves of a sample.
  double share(int twiceX, int twiceY) const noexcept;

  double east_, north_, radius_, spacing_;
  int steps_;
  SampleRectangle covered_;           // the samples within reach
  int row_ = 0;                       // that comes next
  std::vector<double> here_, south_;  // the current row and the one south of it, before this step; a sample
                                      // more on both sides
};

}  // namespace teren
