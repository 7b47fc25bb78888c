// Ground that takes craters and is smoothed: the live surface of the plugin "crater".
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "teren/DeformGrid.h"

#include "generators/crater/CraterShape.h"
#include "generators/crater/Smoothing.h"

namespace teren {

/// A tool as a stamp describes it, checked.
struct CraterTool {
  enum class Kind { crater, smooth };
  Kind kind = Kind::crater;
  double radius = 1.0;                ///< [m] of the rim, or of what is smoothed
  double depth = 0.0;                 ///< [m] crater: CraterShape
  double rim = 0.0, irregular = 0.0;  ///< crater: CraterShape
  int steps = 0;                      ///< smooth: Smoothing
  double reach = 0.0;                 ///< [m]
};

/// Craters are there at once and at rest. Smoothing goes on for its number of steps; where several overlap,
/// each step does one of each, in the order of the stamps.
class CraterSurface final : public LiveSurface {
 public:
  static constexpr double kLargest = 1e5;  ///< [m] radius

  CraterSurface(const DeformRegion& region, ConstHeightView ground) : grid_(region, ground) {}

  /// What a stamp means, or one sentence why it means nothing. size: the radius, above 0 to kLargest. Crater:
  /// depth within +-size. Smooth: depth is the standard deviation of the blur in its middle, above 0 to size
  /// and to Smoothing::kMostSamples samples; so it comes to rest after 4 (depth / spacing)^2 steps, rounded
  /// up.
  static Result<CraterTool> read(const Stamp& stamp, double spacing);

  Result<void> apply(const Stamp& stamp) override;
  bool step(const Slice& slice, std::uint64_t upTo) override;
  std::uint64_t steps() const noexcept override { return steps_; }
  bool atRest() const noexcept override { return smoothings_.empty(); }
  std::shared_ptr<const DeformedGround> snapshot() override { return grid_.snapshot(); }
  std::size_t bytes() const noexcept override;
  Result<void> grow(const DeformRegion& region, ConstHeightView ground) override;
  Result<void> merge(const DeformRegion& region, ConstHeightView ground,
                     std::span<LiveSurface* const> others) override;

 private:
  void dig(const Stamp& stamp, const CraterTool& tool);
  /// One row of the current step.
  void work();

  DeformGrid grid_;
  std::vector<Smoothing> smoothings_;  // each with steps left, in the order of their stamps
  std::size_t current_ = 0;            // of smoothings_, within the step
  bool begun_ = false;                 // a step, which is not done
  std::uint64_t steps_ = 0;
};

}  // namespace teren
