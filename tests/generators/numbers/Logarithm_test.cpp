#include "generators/numbers/Logarithm.h"

#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

void expectWithinError(double x) {
  const long double exact = std::log2(static_cast<long double>(x));
  const long double bound = kBinaryLogarithmError * std::max(1.0L, std::fabs(exact));
  ASSERT_LE(std::fabs(binaryLogarithm(x) - exact), bound) << x;
}

TEST(Logarithm, StaysWithinItsErrorOfLongDouble) {
  constexpr std::uint64_t seed = 20240813;
  RandomSequence random(seed);
  for (int n = 0; n < 300000; ++n) {
    const std::uint64_t mantissa = random.next() >> 12;
    expectWithinError(std::bit_cast<double>(mantissa | std::uint64_t{1023} << 52));
    expectWithinError(std::bit_cast<double>(mantissa | (1 + random.next() % 2046) << 52));
  }
  for (int n = 1; n <= 40000; ++n) expectWithinError(n);
  expectWithinError(std::nextafter(1.0, 0.0));
  expectWithinError(std::nextafter(1.0, 2.0));
  expectWithinError(std::numeric_limits<double>::max());
  expectWithinError(std::numeric_limits<double>::min());
}

TEST(Logarithm, IsExactForPowersOfTwo) {
  for (int n = -1022; n <= 1023; ++n) ASSERT_EQ(binaryLogarithm(std::ldexp(1.0, n)), n);
}

TEST(Logarithm, HasTheBitsItHadWhenWritten) {
  const std::pair<double, std::uint64_t> known[] = {
      {3.0, 0x3ff95c01a39fbd69}, {0.7, 0xbfe0776228967d14}, {32768.5, 0x402e0002e2a77b52}};
  for (const auto& [x, bits] : known) EXPECT_EQ(std::bit_cast<std::uint64_t>(binaryLogarithm(x)), bits) << x;
}

}  // namespace
}  // namespace teren
