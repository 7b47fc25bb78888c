#include "generators/numbers/PowerOfTwo.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "generators/numbers/RandomNumber.h"

namespace teren {
namespace {

double relativeError(double x) {
  const long double exact = std::exp2(static_cast<long double>(x));
  return static_cast<double>(std::fabs((powerOfTwo(x) - exact) / exact));
}

TEST(PowerOfTwo, StaysWithinItsErrorOfLongDouble) {
  constexpr std::uint64_t seed = 20240811;
  RandomSequence random(seed);
  for (double range : {1.0, 60.0, 1022.0}) {
    for (int n = 0; n < 200000; ++n) {
      const double x = range * uniformAroundZero(random.next());
      ASSERT_LE(relativeError(x), kPowerOfTwoError) << "x = " << x << ", seed " << seed;
    }
  }
  for (int n = -1022; n < 1022; ++n) {
    for (double x : {n + 0.5, std::nextafter(n + 0.5, 2000.0), std::nextafter(n + 0.5, -2000.0)}) {
      ASSERT_LE(relativeError(x), kPowerOfTwoError) << "x = " << x;
    }
  }
}

TEST(PowerOfTwo, IsExactForWholeNumbers) {
  for (int n = -1022; n <= 1023; ++n) ASSERT_EQ(powerOfTwo(n), std::ldexp(1.0, n)) << n;
}

TEST(PowerOfTwo, HasTheBitsItHadWhenWritten) {
  const std::pair<double, std::uint64_t> known[] = {{0.5, 0x3ff6a09e667f3bcc},
                                                    {-0.2, 0x3febdb8cdadbe120},
                                                    {1.0 / 3.0, 0x3ff428a2f98d728b},
                                                    {-1021.7, 0x13b2c47bff827a},
                                                    {1022.9, 0x7fdddb680117aa8e}};
  for (const auto& [x, bits] : known) EXPECT_EQ(std::bit_cast<std::uint64_t>(powerOfTwo(x)), bits) << x;
}

}  // namespace
}  // namespace teren
