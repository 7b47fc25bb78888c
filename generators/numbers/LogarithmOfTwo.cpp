#include "generators/numbers/LogarithmOfTwo.h"

#include <bit>
#include <cassert>
#include <cstdint>
#include <limits>

namespace teren {

double logarithmOfTwo(double x) noexcept {
  assert(std::numeric_limits<double>::min() <= x && x <= std::numeric_limits<double>::max());
  constexpr std::uint64_t kMantissa = (std::uint64_t{1} << 52) - 1;
  constexpr double kRootOfTwo = 1.4142135623730951;
  constexpr double kTwoByLn2 = 2.8853900817779268;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  auto exponent = static_cast<int>(bits >> 52) - 1023;
  double mantissa = std::bit_cast<double>((bits & kMantissa) | std::uint64_t{1023} << 52);
  if (mantissa > kRootOfTwo) {
    mantissa *= 0.5;
    ++exponent;
  }
  // ln m = 2 artanh s with |s| < 0.172: what is left out after s^23 / 23 is below 4e-21.
  const double s = (mantissa - 1.0) / (mantissa + 1.0);
  double sum = 0.0;
  for (int n = 23; n >= 1; n -= 2) sum = sum * (s * s) + 1.0 / n;
  return exponent + kTwoByLn2 * s * sum;
}

}  // namespace teren
