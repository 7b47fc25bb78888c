// What a promise about all seeds is measured on: the maps of many seeds, their mean and their deviation, each
// with its standard error.
#pragma once

#include <array>

#include "apps/check/MapMaker.h"

namespace teren::check {

/// A measured number and the standard deviation of its own error.
struct Estimate {
  double value = 0.0, error = 0.0;
};

/// Sums over maps of kSamples samples a side. Areas count the samples of the rim half and those of the
/// corners a quarter, as maps that lie side by side would.
class Ensemble {
 public:
  static constexpr int kSamples = 17;
  static constexpr int kFewestSeeds = 50;     ///< however slow the plugin is
  static constexpr double kTolerance = 0.03;  ///< in parts of the promised deviation

  explicit Ensemble(const MapMaker& maker) : maker_(maker), range_(maker.range()) {}

  /// One more seed. A map with a height that is not finite is left out: that is another property's.
  void add();

  int seeds() const noexcept { return seeds_; }
  const HeightRange& promised() const noexcept { return range_; }

  /// Of the heights minus the promised mean [m], at one sample and over the area.
  Estimate meanAt(int x, int y) const noexcept;
  Estimate mean() const noexcept;
  /// Root mean square [m] of the same, at one sample and over the area.
  double deviationAt(int x, int y) const noexcept;
  Estimate deviation() const noexcept;

 private:
  struct Sums {
    double first = 0.0, second = 0.0;
    void add(double number) noexcept {
      first += number;
      second += number * number;
    }
    Estimate mean(int count) const noexcept;
  };
  const Sums& at(int x, int y) const noexcept { return samples_[static_cast<std::size_t>(y * kSamples + x)]; }

  const MapMaker& maker_;
  HeightRange range_;
  int next_ = 0, seeds_ = 0;
  std::array<Sums, static_cast<std::size_t>(kSamples* kSamples)> samples_;
  Sums means_, squares_;  // over the area of each map
};

}  // namespace teren::check
