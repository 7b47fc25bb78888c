// The maps filters are tried on: noise about as rough as faults, with a law so simple that its range and
// deviation are exact.
#pragma once

#include <memory>

#include "teren/Generator.h"

namespace teren::check {

/// A sum of grids of random numbers, each half as wide as the one before and sqrt(1/2) times as high (so
/// Hurst's exponent is about 1/2), interpolated bilinearly and shifted by a random whole number of samples,
/// so that the deviation is the same at every sample. Levels are exact. Maps of 2^k + 1 samples, k <= 12. 0.2
/// us a sample.
class SourceNoise final : public Generator {
 public:
  static constexpr double kDeviation = 4.0;  ///< [m]

  HeightRange range() const override;
  /// An upper bound: the residual of white noise.
  double residual(int level, int samples, double spacing) const override;
  std::unique_ptr<GenerationTask> begin(const MapRequest& request, HeightView out) const override;
};

}  // namespace teren::check
