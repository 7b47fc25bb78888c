#include "generators/numbers/RandomNumber.h"

#include <cmath>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

TEST(RandomNumber, UniformReachesFromZeroToJustBelowOne) {
  EXPECT_EQ(uniform(0), 0.0);
  EXPECT_EQ(uniform(~0ULL), 1.0 - 0x1p-53);
  EXPECT_EQ(uniform(1ULL << 63), 0.5);
  EXPECT_EQ(uniform(0x7ff), 0.0) << "the lowest 11 bits count for nothing";
}

TEST(RandomNumber, UniformAroundZeroIsSymmetric) {
  EXPECT_EQ(uniformAroundZero(~0ULL), 1.0 - 0x1p-53);
  EXPECT_EQ(uniformAroundZero(0), -1.0 + 0x1p-53);
  RandomSequence random(1);
  for (int n = 0; n < 1000; ++n) {
    const std::uint64_t word = random.next();
    ASSERT_EQ(uniformAroundZero(~word), -uniformAroundZero(word)) << word;
  }
}

TEST(RandomNumber, HasTheMeanAndTheVarianceItSays) {
  constexpr int count = 1000000;
  constexpr std::uint64_t seed = 77;
  RandomSequence random(seed);
  double sum = 0.0, squares = 0.0, sumAround = 0.0, squaresAround = 0.0;
  for (int n = 0; n < count; ++n) {
    const std::uint64_t word = random.next();
    const double number = uniform(word), around = uniformAroundZero(word);
    sum += number;
    squares += (number - 0.5) * (number - 0.5);
    sumAround += around;
    squaresAround += around * around;
  }
  const double fourDeviations = 4.0 / std::sqrt(12.0 * count);
  EXPECT_NEAR(sum / count, 0.5, fourDeviations) << "seed " << seed;
  EXPECT_NEAR(sumAround / count, 0.0, 2.0 * fourDeviations);
  EXPECT_NEAR(squares / count, 1.0 / 12.0, 4e-4);
  EXPECT_NEAR(squaresAround / count, 1.0 / 3.0, 16e-4);
}

}  // namespace
}  // namespace teren
