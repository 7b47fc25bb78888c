// Circles: ground heaped up of round hills and hollows of many sizes, as wind and ice leave it.
#pragma once

#include <cstdint>
#include <memory>

#include "teren/Generator.h"

#include "generators/circles/Disc.h"

namespace teren {

/// The published method (a random centre and radius, the inside raised or lowered with a trigonometric
/// rounding, about 1000 times), made exact: every disc is independent, its radius uniform between smallest *
/// radius and radius, its height proportional to its radius, hill or hollow by a fair coin. Centres are
/// uniform over the map's square widened by the largest radius on every side, so that every place of the map
/// is covered alike; discs that do not touch the map cost nothing but being drawn.
///
/// So over all seeds the mean is 0 and the variance the same at every point, exactly: discs * unit^2 * K *
/// E[pi r^2 (r / radius)^2] / (2 + 2 radius)^2, r in pitches, K = 3/8 - 2/pi^2 the mean square of the profile
/// over a disc; `unit`, the height of the largest disc, follows from the deviation. Where discs are few and
/// small, most of a map is flat and the rest the higher for it.
///
/// A sample's sum is made in float, in the order in which discs are drawn. Work: proportional to the area
/// that all discs cover, 32 sums a sample at the defaults, where the plain way (CirclesReference.h) asks
/// every disc at every sample. A task asks whether its slice is over every few microseconds. Immutable; any
/// number of tasks may run at once, on any threads.
class Circles {
 public:
  static constexpr int kMaxDiscs = 65535;
  static constexpr double kMinRadius = 0.01, kMaxRadius = 1.0;  ///< [pitches]
  static constexpr double kMinSmallest = 0.01;

  /// discs: 1 ... kMaxDiscs; deviation [m]: finite, >= 0; radius of the largest disc [pitches]: kMinRadius
  /// ... kMaxRadius; smallest: radius of the smallest in parts of the largest, kMinSmallest ... 1. Anything
  /// else is a broken contract.
  Circles(int discs, double deviation, double radius, double smallest);

  int discs() const noexcept { return discs_; }

  /// The next disc, from two words: its place, then its size and sign.
  template <class Words>
  Disc draw(Words& words) const noexcept {
    const std::uint64_t place = words.next();
    const std::uint64_t size = words.next();
    const auto across = [this](std::uint64_t word) {
      return static_cast<std::int32_t>((static_cast<std::uint64_t>(extent_) * word) >> 32) - margin_;
    };
    const double share = smallest_ + (1.0 - smallest_) * (static_cast<double>(size >> 32) * 0x1p-32);
    const double radius = share * largest_;
    const double height = share * unit_;
    return {.x = across(place >> 32),
            .y = across(place & 0xffffffffu),
            .radius = static_cast<float>(radius),
            .inverseSquare = static_cast<float>(1.0 / (radius * radius)),
            .height = static_cast<float>((size & 1) != 0 ? height : -height)};
  }

  /// How far a height may lie from the sum of its discs in exact arithmetic [m]: each of them may be off by
  /// kDiscProfileError, and each sum by half a unit in its last place. Far above what happens, for it lets
  /// all discs lie on one point.
  double roundingBound() const noexcept;

  /// The exact mean and deviation over all seeds; min and max are where all discs lie on one point.
  HeightRange range() const noexcept;

  /// Generator::residual; derived in the source file, within a factor of 1.5 of what is measured.
  double residual(int level, int samples) const noexcept;

  /// Begins a map; Generator::begin. request.samples is 1 or 2^k + 1 with k <= kCircleUnitBits. The task
  /// allocates 20 bytes a disc and 32 a column when it is begun and never again.
  std::unique_ptr<SlicedTask> begin(const MapRequest& request, HeightView out) const;

 private:
  int discs_;
  double deviation_;
  double radius_;                 // of the largest [pitches]
  double largest_;                // the same [units]
  double smallest_;               // in parts of it
  double unit_;                   // [m] height of the largest
  std::int32_t margin_, extent_;  // of the centres' square [units]: beyond the map, from side to side
};

}  // namespace teren
