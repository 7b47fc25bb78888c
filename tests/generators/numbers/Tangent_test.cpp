#include "generators/numbers/Tangent.h"

#include <cmath>

#include <gtest/gtest.h>

namespace teren {
namespace {

TEST(Tangent, LiesWithinItsErrorOfTheTangent) {
  constexpr long double pi = 3.14159265358979323846L;
  for (int n = 1; n < 90'000; ++n) {
    const double angle = n * 0.001;
    const long double exact = std::tan(angle * pi / 180.0L);
    ASSERT_LE(std::fabs(static_cast<double>(tangentOfDegrees(angle) / exact - 1.0L)), kTangentError) << angle;
  }
}

TEST(Tangent, IsExactlyZeroOfTheHorizontal) {
  EXPECT_EQ(tangentOfDegrees(0.0), 0.0);
}

}  // namespace
}  // namespace teren
