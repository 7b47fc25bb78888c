#include "generators/numbers/Gaussian.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

long double chanceBelow(long double x) {
  return 0.5L * std::erfc(-x / std::sqrt(2.0L));
}

TEST(Gaussian, HasVarianceOne) {
  long double variance = 0.0L;
  const auto& ends = Gaussian::table().ends();
  for (std::size_t n = 0; n < Gaussian::kCells; ++n) {
    const long double low = ends[n], high = ends[n + 1];
    variance += (low * low + low * high + high * high) / 3.0L / Gaussian::kCells;
  }
  EXPECT_NEAR(static_cast<double>(variance), 1.0, Gaussian::kVarianceError);
}

TEST(Gaussian, StaysWithinItsErrorOfTheNormalDistribution) {
  const auto& ends = Gaussian::table().ends();
  double worst = 0.0;
  for (std::size_t n = 0; n < Gaussian::kCells; ++n) {
    for (int part = 0; part <= 16; ++part) {
      const long double x = ends[n] + (ends[n + 1] - ends[n]) * part / 16.0L;
      const long double chance =
          0.5L + (static_cast<long double>(n) + part / 16.0L) / (2.0L * Gaussian::kCells);
      worst = std::max(worst, static_cast<double>(std::fabs(chance - chanceBelow(x))));
    }
  }
  EXPECT_LE(worst, Gaussian::kDistributionError);
  EXPECT_GE(worst, Gaussian::kDistributionError / 2.0) << "a bound to be proud of says no more than it must";
}

TEST(Gaussian, GivesOppositeNumbersForOppositeSignsAndNoneBeyondTheCut) {
  const Gaussian& gaussian = Gaussian::table();
  RandomSequence random(5);
  for (int n = 0; n < 10000; ++n) {
    const std::uint64_t word = random.next();
    ASSERT_EQ(gaussian(word), -gaussian(word ^ 1)) << word;
    const auto half = static_cast<std::uint32_t>(word);
    ASSERT_EQ(gaussian.fromHalf(half), -gaussian.fromHalf(half ^ 1)) << half;
    ASSERT_LE(std::fabs(gaussian(word)), Gaussian::kCut);
  }
  EXPECT_LE(gaussian(~1ULL), Gaussian::kCut);
  EXPECT_GT(gaussian(~1ULL), Gaussian::kCut - 1e-9);
  EXPECT_LE(gaussian.fromHalf(~1U), Gaussian::kCut);
  EXPECT_EQ(gaussian(0), 0.0);
}

/// The numbers the words of a sequence make, sorted.
template <class Make>
std::vector<double> sorted(std::uint64_t seed, int count, Make make) {
  RandomSequence random(seed);
  std::vector<double> numbers;
  for (int n = 0; n < count; ++n) numbers.push_back(make(random.next()));
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

TEST(Gaussian, MakesNormalNumbersOfWordsAndOfHalves) {
  constexpr int count = 1000000;
  constexpr std::uint64_t seed = 31;
  const Gaussian& gaussian = Gaussian::table();
  const std::vector<double> samples[] = {
      sorted(seed, count, gaussian),
      sorted(seed, count,
             [&](std::uint64_t word) { return gaussian.fromHalf(static_cast<std::uint32_t>(word)); }),
      sorted(seed, count,
             [&](std::uint64_t word) { return gaussian.fromHalf(static_cast<std::uint32_t>(word >> 32)); })};
  for (const std::vector<double>& numbers : samples) {
    double sum = 0.0, squares = 0.0, worst = 0.0;
    for (int n = 0; n < count; ++n) {
      sum += numbers[n];
      squares += numbers[n] * numbers[n];
      const double chance = static_cast<double>(chanceBelow(numbers[n]));
      worst = std::max(worst, std::fabs((n + 0.5) / count - chance));
    }
    EXPECT_NEAR(sum / count, 0.0, 4.0 / std::sqrt(count)) << "seed " << seed;
    EXPECT_NEAR(squares / count, 1.0, 4.0 * std::sqrt(2.0 / count));
    EXPECT_LE(worst, Gaussian::kDistributionError + 2.0 / std::sqrt(count)) << "Kolmogorov and Smirnov";
  }
}

TEST(Gaussian, HasTheBitsItHadWhenWritten) {
  Fnv1a hash;
  for (double end : Gaussian::table().ends()) {
    const auto bits = std::bit_cast<std::uint64_t>(end);
    for (int shift = 0; shift < 64; shift += 8) hash.addByte(static_cast<std::uint8_t>(bits >> shift));
  }
  EXPECT_EQ(hash.value(), 0xbc58b63875dc61acULL);
}

}  // namespace
}  // namespace teren
