#include "stream/Turn.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

constexpr long double kFull = 2.0L * std::numbers::pi_v<long double>;

TEST(Turn, IsExactAtQuarters) {
  for (const int turns : {-3, 0, 1, 1000}) {
    EXPECT_EQ(turned(turns).cosine, 1.0);
    EXPECT_EQ(turned(turns).sine, 0.0);
    EXPECT_EQ(turned(turns + 0.25).cosine, 0.0);
    EXPECT_EQ(turned(turns + 0.25).sine, 1.0);
    EXPECT_EQ(turned(turns + 0.5).cosine, -1.0);
    EXPECT_EQ(turned(turns - 0.25).sine, -1.0);
  }
}

TEST(Turn, IsWithinItsErrorEverywhere) {
  for (std::uint64_t k = 0; k < 100'000; ++k) {
    const double turns = static_cast<double>(hashWith(7, k) >> 11) * 0x1p-53 * 4.0 - 2.0;
    const UnitVector unit = turned(turns);
    ASSERT_NEAR(unit.cosine, static_cast<double>(std::cos(kFull * turns)), kTurnedError) << turns;
    ASSERT_NEAR(unit.sine, static_cast<double>(std::sin(kFull * turns)), kTurnedError) << turns;
    const double small = std::ldexp(turns, -5 - static_cast<int>(k % 900));
    const long double sine = std::sin(kFull * small);
    ASSERT_LE(std::fabs(turned(small).sine - sine), kTurnedError * std::fabs(sine)) << small;
  }
}

TEST(Turn, OfWhatIsNotAnAngleIsNone) {
  for (const double turns : {std::nan(""), std::numeric_limits<double>::infinity(), -1e300}) {
    EXPECT_EQ(turned(turns).cosine, 1.0);
    EXPECT_EQ(turned(turns).sine, 0.0);
  }
}

}  // namespace
}  // namespace teren
