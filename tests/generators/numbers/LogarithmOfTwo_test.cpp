#include "generators/numbers/LogarithmOfTwo.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "generators/numbers/PowerOfTwo.h"
#include "generators/numbers/RandomNumber.h"

namespace teren {
namespace {

TEST(LogarithmOfTwo, StaysWithinItsErrorOfLongDouble) {
  constexpr std::uint64_t seed = 4711;
  RandomSequence random(seed);
  for (double range : {0.01, 1.0, 1000.0}) {
    for (int n = 0; n < 200000; ++n) {
      const double x = powerOfTwo(range * uniformAroundZero(random.next()));
      const long double exact = std::log2(static_cast<long double>(x));
      const auto error = static_cast<double>(std::fabs(logarithmOfTwo(x) - exact));
      ASSERT_LE(error, kLogarithmOfTwoError * std::max(1.0, static_cast<double>(std::fabs(exact))))
          << "x = " << x << ", seed " << seed;
    }
  }
}

TEST(LogarithmOfTwo, IsExactForPowersOfTwo) {
  for (int n = -1022; n <= 1023; ++n) ASSERT_EQ(logarithmOfTwo(std::ldexp(1.0, n)), n);
}

}  // namespace
}  // namespace teren
