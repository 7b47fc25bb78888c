// Gaussian random numbers from hashes, cut at 4 deviations so that what is built of them has bounds; the same
// bits on every processor (law 1).
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace teren {

/// The standard normal distribution cut to [-4, 4], by inversion: a word's lowest bit is the sign, its next
/// kCellBits bits choose one of 1024 equally likely cells of the absolute value, and the others the place
/// within the cell, where the density is constant. The cells' ends are the quantiles of the cut normal
/// distribution, all but the last multiplied by one factor (0.99998) that makes the variance 1. So
///   the mean is exactly 0 (the two signs give opposite numbers),
///   the variance is 1 within kVarianceError,
///   the distribution function is within kDistributionError of the normal one.
/// Immutable; any thread. A number costs about 1 ns when the table (8 KiB) is in the first-level cache.
class Gaussian {
 public:
  static constexpr double kCut = 4.0;
  static constexpr int kCellBits = 10;
  static constexpr int kCells = 1 << kCellBits;
  static constexpr double kVarianceError = 1e-12;
  static constexpr double kDistributionError = 1.5e-4;

  /// The table, made at its first use (under a millisecond) and kept. Take it outside of loops.
  static const Gaussian& table();

  /// A number from the whole word; |number| <= kCut.
  double operator()(std::uint64_t word) const noexcept {
    return at((word >> 1) & (kCells - 1), static_cast<double>(word >> 11) * 0x1p-53, word << 63);
  }

  /// A number from 32 bits: 2^21 values in each cell, enough for heights kept as floats, and one word makes
  /// two. Mean and variance as above.
  double fromHalf(std::uint32_t half) const noexcept {
    return at((half >> 1) & (kCells - 1), (static_cast<double>(half >> 11) + 0.5) * 0x1p-21,
              static_cast<std::uint64_t>(half) << 63);
  }

  /// The ends of the cells of the absolute value, ascending from 0 to kCut.
  const std::array<double, kCells + 1>& ends() const noexcept { return ends_; }

 private:
  Gaussian();

  double at(std::uint64_t cell, double place, std::uint64_t sign) const noexcept {
    const double low = ends_[cell];
    const double size = low + place * (ends_[cell + 1] - low);
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(size) ^ sign);
  }

  std::array<double, kCells + 1> ends_;
};

}  // namespace teren
