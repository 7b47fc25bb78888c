#include "generators/numbers/Logarithm.h"

#include <bit>
#include <cassert>
#include <cstdint>
#include <limits>

namespace teren {

/// x = 2^e m with sqrt(1/2) < m < sqrt(2); ln m = 2 (s + s^3 / 3 + s^5 / 5 ...), s = (m - 1) / (m + 1), so
/// that |s| < 0.172 and what follows s^21 is below 1e-18.
double binaryLogarithm(double x) noexcept {
  assert(x >= std::numeric_limits<double>::min() && x <= std::numeric_limits<double>::max());
  constexpr std::uint64_t kMantissa = (std::uint64_t{1} << 52) - 1;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  int exponent = static_cast<int>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & kMantissa) | std::uint64_t{1023} << 52);
  if (m > 1.4142135623730951) {
    m *= 0.5;
    ++exponent;
  }
  const double s = (m - 1.0) / (m + 1.0);
  const double square = s * s;
  double sum = 1.0 / 21.0;
  for (int odd = 19; odd >= 3; odd -= 2) sum = sum * square + 1.0 / odd;
  constexpr double kTwoByLn2 = 2.8853900817779268;
  return exponent + kTwoByLn2 * (s + s * (square * sum));
}

}  // namespace teren
