#include "generators/numbers/Turn.h"

#include <bit>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "generators/numbers/RandomNumber.h"

namespace teren {
namespace {

void expectWithinError(double turns) {
  const long double angle =
      2.0L * std::numbers::pi_v<long double> * static_cast<long double>(turns - std::floor(turns));
  const SineCosine mine = sineCosineOfTurn(turns);
  ASSERT_LE(std::fabs(mine.sine - std::sin(angle)), kTurnError) << turns;
  ASSERT_LE(std::fabs(mine.cosine - std::cos(angle)), kTurnError) << turns;
}

TEST(Turn, StaysWithinItsErrorOfLongDouble) {
  constexpr std::uint64_t seed = 20240812;
  RandomSequence random(seed);
  for (int n = 0; n < 400000; ++n) expectWithinError(uniform(random.next()));
  for (int n = 0; n < 100000; ++n) expectWithinError(1e4 * uniform(random.next()));
  for (int n = 0; n <= 4096; ++n) expectWithinError(n / 4096.0);
}

TEST(Turn, HasExactSymmetries) {
  RandomSequence random(5);
  for (int n = 0; n < 20000; ++n) {
    const double part = std::ldexp(static_cast<double>(random.nextBits(40)), -43);  // [0, 1/8)
    const SineCosine a = sineCosineOfTurn(part);
    const auto expectSame = [part](const SineCosine& b, double sine, double cosine) {
      ASSERT_EQ(b.sine, sine) << part;
      ASSERT_EQ(b.cosine, cosine) << part;
    };
    expectSame(sineCosineOfTurn(-part), -a.sine, a.cosine);
    expectSame(sineCosineOfTurn(0.25 - part), a.cosine, a.sine);
    expectSame(sineCosineOfTurn(0.25 + part), a.cosine, -a.sine);
    expectSame(sineCosineOfTurn(0.5 + part), -a.sine, -a.cosine);
    expectSame(sineCosineOfTurn(0.75 + part), -a.cosine, a.sine);
    expectSame(sineCosineOfTurn(7.0 + part), a.sine, a.cosine);
  }
}

TEST(Turn, GivesWholeNumbersAtWholeQuarters) {
  const int sines[] = {0, 1, 0, -1}, cosines[] = {1, 0, -1, 0};
  for (int n = -8; n <= 8; ++n) {
    const SineCosine mine = sineCosineOfTurn(0.25 * n);
    EXPECT_EQ(mine.sine, sines[n & 3]) << n;
    EXPECT_EQ(mine.cosine, cosines[n & 3]) << n;
  }
  EXPECT_EQ(sineCosineOfTurn(0.125).sine, sineCosineOfTurn(0.125).cosine);
  EXPECT_EQ(sineCosineOfTurn(0x1p51).cosine, 1.0);
}

TEST(Turn, HasTheBitsItHadWhenWritten) {
  struct Known {
    double turns;
    std::uint64_t sine, cosine;
  };
  for (const Known& known : {Known{0.1, 0x3fe2cf2304755a5e, 0x3fe9e3779b97f4a7},
                             Known{1.0 / 3.0, 0x3febb67ae8584cab, 0xbfdffffffffffffd},
                             Known{-0.7, 0x3fee6f0e134454ff, 0xbfd3c6ef372fe954}}) {
    const SineCosine mine = sineCosineOfTurn(known.turns);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(mine.sine), known.sine) << known.turns;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(mine.cosine), known.cosine) << known.turns;
  }
}

}  // namespace
}  // namespace teren
