#include "generators/numbers/PowerOfTwo.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace teren {

double powerOfTwo(double x) noexcept {
  assert(-1022.0 <= x && x <= 1023.0);
  // 2^x = 2^whole * e^(r ln 2) with |r| <= 1/2, whose Taylor series is cut after ln2^13 r^13 / 13!: what is
  // left out is below 6e-18 of the value. The coefficients are ln2^n / n!.
  constexpr double kCoefficients[] = {
      1.0,
      0.693147180559945309417232121458,
      0.240226506959100712333551263163,
      0.0555041086648215799531422637687,
      0.00961812910762847716197907157366,
      0.00133335581464284434234122219880,
      1.54035303933816099544370973327e-4,
      1.52527338040598402800254390120e-5,
      1.32154867901443094884037582282e-6,
      1.01780860092396997274900075960e-7,
      7.05491162080112332987539218687e-9,
      4.44553827187081149759640896030e-10,
      2.56784359934882051419948020411e-11,
      1.36914888539041288808919536550e-12,
  };
  const double whole = std::floor(x + 0.5);
  const double r = x - whole;
  double sum = kCoefficients[13];
  for (int n = 12; n >= 0; --n) sum = sum * r + kCoefficients[n];
  // x < 1023 may round up to 2^1024 / 2^r with r < 0: two factors keep each of them a double.
  const auto exponent = static_cast<std::int64_t>(whole);
  const auto factor = [](std::int64_t power) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(power + 1023) << 52);
  };
  return sum * factor(exponent / 2) * factor(exponent - exponent / 2);
}

}  // namespace teren
