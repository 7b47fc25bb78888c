#include <algorithm>
#include <array>
#include <cmath>

#include "apps/check/Allowance.h"
#include "apps/check/Counterexample.h"
#include "apps/check/MapComparison.h"
#include "apps/check/MapMaker.h"
#include "apps/check/Properties.h"
#include "apps/check/Rounded.h"
#include "apps/check/Subject.h"

namespace teren::check {
namespace {

constexpr int kSamples = 65, kLevels = 3;
constexpr int kFewest = 16, kSeeds = 128;
constexpr double kFactor = 1.5;
/// In standard errors of the mean square.
constexpr double kChance = 4.0;

/// Squared errors of one level over seeds.
struct Squares {
  double sum = 0.0, sumOfSquares = 0.0, before = 0.0;  // before: what a filter was given
  int seeds = 0;

  void add(double square) {
    sum += square;
    sumOfSquares += square * square;
    ++seeds;
  }
  double mean() const { return sum / seeds; }
  double error() const {
    return std::sqrt(std::max(0.0, sumOfSquares / seeds - mean() * mean()) / (seeds - 1));
  }
};

class Residual final : public Property {
 public:
  std::string_view name() const noexcept override { return "residual"; }
  std::string_view demand() const noexcept override {
    return "What the levels 1 to 3 get wrong is within a factor of 1.5 of the promised residual (of a "
           "filter: "
           "at most 1.5 times it), and level 0 promises 0.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort& effort) const override {
    std::string figure;
    for (const Setting& setting : subject.settings()) {
      const MapMaker maker = subject.maker(setting);
      checkLevelZero(maker);
      const std::array<Squares, kLevels + 1> levels = measure(maker, effort);
      for (int level = 1; level <= kLevels; ++level) compare(maker, level, levels[level]);
      if (!setting.empty()) continue;
      for (int level = 1; level <= kLevels; ++level) {
        figure += (level == 1 ? "" : ", ") + rounded(std::sqrt(levels[level].mean())) + " of " +
                  rounded(promised(maker, level, levels[level])) + " m";
      }
    }
    return figure;
  }

 private:
  static double promised(const MapMaker& maker, int level, const Squares& squares) {
    if (!maker.filters()) return maker.residual(level, kSamples);
    return maker.filteredResidual(std::sqrt(squares.before / squares.seeds), level);
  }

  static void checkLevelZero(const MapMaker& maker) {
    const double promise = maker.filters() ? maker.filteredResidual(0.0, 0) : maker.residual(0, kSamples);
    if (promise == 0.0) return;
    throw Counterexample{"with " + maker.setting() + ": at level 0 it promises " + rounded(promise) +
                         " m, but nothing is left out there"};
  }

  static std::array<Squares, kLevels + 1> measure(const MapMaker& maker, const Effort& effort) {
    std::array<Squares, kLevels + 1> levels;
    const Allowance allowance(effort.perSetting);
    for (int n = 0; n < kSeeds && (n < kFewest || allowance.left()); ++n) {
      const HeightMap finest = maker.make(requestOf(n, kSamples));
      if (!std::isfinite(finest(0, 0))) continue;
      const HeightMap source = maker.filters() ? maker.source(requestOf(n, kSamples)) : HeightMap();
      for (int level = 1; level <= kLevels; ++level) {
        levels[level].add(squaredError(finest, maker.make(requestOf(n, kSamples, level)), level));
        if (maker.filters()) levels[level].before += squaredError(source, subsampled(source, level), level);
      }
    }
    return levels;
  }

  static void compare(const MapMaker& maker, int level, const Squares& squares) {
    const HeightRange range = maker.range();
    const double rounding = 0x1p-22 * std::max(std::fabs(range.min), std::fabs(range.max));
    const double promise = promised(maker, level, squares);
    const double most = std::pow(kFactor * promise + rounding, 2.0);
    const double least = std::pow(std::max(0.0, promise / kFactor - rounding), 2.0);
    const double chance = kChance * squares.error();
    const bool tooMuch = !(squares.mean() - chance <= most);
    const bool tooLittle = !maker.filters() && squares.mean() + chance < least;
    if (!tooMuch && !tooLittle) return;
    throw Counterexample{"with " + maker.setting() + ": level " + std::to_string(level) + " of " +
                         std::to_string(kSamples) + " samples a side is wrong by " +
                         rounded(std::sqrt(squares.mean())) + " m (root mean square over " +
                         std::to_string(squares.seeds) + " seeds), promised is " + rounded(promise) + " m"};
  }
};

}  // namespace

PropertyPointer makeResidual() {
  return std::make_unique<Residual>();
}

}  // namespace teren::check
