// Uniform random numbers from hashes, in place of the std distributions, which differ between libraries
// (law 1). A word is any hash whose bits are all equally likely (teren/Hash.h).
#pragma once

#include <cstdint>

namespace teren {

/// Uniform in [0, 1): a multiple of 2^-53, from the upper 53 bits. Mean 1/2 - 2^-54, variance 1/12 (1 -
/// 2^-106).
constexpr double uniform(std::uint64_t word) noexcept {
  return static_cast<double>(word >> 11) * 0x1p-53;
}

/// Uniform in (-1, 1): an odd multiple of 2^-53, from the upper 53 bits. Symmetric, so its mean is exactly
/// 0; variance 1/3 (1 - 2^-106).
constexpr double uniformAroundZero(std::uint64_t word) noexcept {
  return static_cast<double>(2 * static_cast<std::int64_t>(word >> 11) + 1 - (std::int64_t{1} << 53)) *
         0x1p-53;
}

}  // namespace teren
