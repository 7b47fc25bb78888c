#include "height/CubicInterpolation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

double uniform(RandomSequence& random) {
  return std::ldexp(static_cast<double>(random.nextBits(53)), -53);
}

double interpolate(const std::vector<double>& p, double s) {
  const CubicTaps taps = cubicTaps(s, static_cast<int>(p.size()));
  const auto at = [&](std::size_t k) { return p[static_cast<std::size_t>(taps.index[k])]; };
  return combine(taps.weight, at(0), at(1), at(2), at(3));
}

std::vector<double> randomRow(RandomSequence& random, int samples) {
  std::vector<double> row;
  for (int k = 0; k < samples; ++k) row.push_back(200.0 * uniform(random) - 100.0);
  return row;
}

TEST(CubicInterpolation, GivesTheSamplesTheirExactBits) {
  constexpr std::uint64_t kSeed = 11;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  for (const int samples : {2, 3, 4, 5, 9, 65}) {
    const std::vector<double> row = randomRow(random, samples);
    for (int k = 0; k < samples; ++k) {
      EXPECT_EQ(interpolate(row, k), row[static_cast<std::size_t>(k)]) << "sample " << k << " of " << samples;
    }
  }
}

TEST(CubicInterpolation, TakesExactlyOneSampleAtASample) {
  for (const int samples : {2, 3, 5, 65}) {
    for (int k = 0; k < samples; ++k) {
      const CubicTaps taps = cubicTaps(k, samples);
      for (std::size_t tap = 0; tap < 4; ++tap) {
        const bool same = taps.index[tap] == k && taps.weight[tap] != 0.0;
        EXPECT_EQ(taps.weight[tap], same ? 1.0 : 0.0)
            << "sample " << k << " of " << samples << ", tap " << tap;
      }
    }
  }
}

TEST(CubicInterpolation, HasIndicesInsideTheRowAndWeightsThatSumToOne) {
  constexpr std::uint64_t kSeed = 12;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  for (const int samples : {2, 3, 4, 5, 9, 2049}) {
    for (int trial = 0; trial < 5000; ++trial) {
      const double s = trial == 0 ? 0.0 : trial == 1 ? samples - 1.0 : uniform(random) * (samples - 1);
      const CubicTaps taps = cubicTaps(s, samples);
      double sum = 0.0;
      for (std::size_t tap = 0; tap < 4; ++tap) {
        ASSERT_GE(taps.index[tap], 0) << "s = " << s << " of " << samples;
        ASSERT_LE(taps.index[tap], samples - 1) << "s = " << s << " of " << samples;
        sum += taps.weight[tap];
      }
      ASSERT_NEAR(sum, 1.0, 8 * 0x1p-53) << "s = " << s << " of " << samples;
    }
  }
}

TEST(CubicInterpolation, HasNeighbouringOrRepeatedIndicesSoThatFourKeptRowsAreEnough) {
  for (const int samples : {3, 4, 5, 9}) {
    for (double s = 0.0; s <= samples - 1; s += 0.125) {
      const CubicTaps taps = cubicTaps(s, samples);
      for (std::size_t tap = 0; tap < 4; ++tap) {
        const bool inOrder = taps.index[tap] == taps.index[1] - 1 + static_cast<int>(tap);
        const bool folded =
            taps.weight[tap] == 0.0 && (taps.index[tap] == taps.index[1] || taps.index[tap] == taps.index[2]);
        EXPECT_TRUE(inOrder || folded) << "s = " << s << " of " << samples << ", tap " << tap;
      }
    }
  }
}

TEST(CubicInterpolation, ReproducesQuadraticsAwayFromTheRimsAndLinesEverywhere) {
  constexpr std::uint64_t kSeed = 13;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const auto quadratic = [](double s) { return 3.0 - 1.5 * s + 0.75 * s * s; };
  const auto line = [](double s) { return 3.0 - 1.5 * s; };
  const auto sampled = [](const std::function<double(double)>& f, int samples) {
    std::vector<double> row;
    for (int k = 0; k < samples; ++k) row.push_back(f(k));
    return row;
  };
  const std::vector<double> quadraticRow = sampled(quadratic, 17), lineRow = sampled(line, 17);
  for (int trial = 0; trial < 5000; ++trial) {
    const double inside = 1.0 + 14.0 * uniform(random), anywhere = 16.0 * uniform(random);
    ASSERT_NEAR(interpolate(quadraticRow, inside), quadratic(inside), 1e-12) << "s = " << inside;
    ASSERT_NEAR(interpolate(lineRow, anywhere), line(anywhere), 1e-12) << "s = " << anywhere;
  }
  for (const int samples : {2, 3}) {
    EXPECT_NEAR(interpolate(sampled(line, samples), 0.3), line(0.3), 1e-13);
  }
}

/// Slopes just west and just east of a sample, by one-sided second-order difference quotients.
double slopeWest(const std::vector<double>& row, double s, double h) {
  return (3.0 * interpolate(row, s) - 4.0 * interpolate(row, s - h) + interpolate(row, s - 2 * h)) / (2 * h);
}
double slopeEast(const std::vector<double>& row, double s, double h) {
  return (-3.0 * interpolate(row, s) + 4.0 * interpolate(row, s + h) - interpolate(row, s + 2 * h)) / (2 * h);
}

TEST(CubicInterpolation, HasTheCatmullRomSlopeOnBothSidesOfEverySample) {
  constexpr std::uint64_t kSeed = 14;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  constexpr double h = 0x1p-12;
  for (const int samples : {3, 4, 5, 33}) {
    const std::vector<double> row = randomRow(random, samples);
    for (int k = 1; k < samples - 1; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const double slope = (row[at + 1] - row[at - 1]) / 2.0;
      EXPECT_NEAR(slopeWest(row, k, h), slope, 2e-3) << "sample " << k << " of " << samples;
      EXPECT_NEAR(slopeEast(row, k, h), slope, 2e-3) << "sample " << k << " of " << samples;
    }
    EXPECT_NEAR(slopeEast(row, 0.0, h), row[1] - row[0], 2e-3);
    const std::size_t last = row.size() - 1;
    EXPECT_NEAR(slopeWest(row, samples - 1.0, h), row[last] - row[last - 1], 2e-3);
  }
}

TEST(CubicInterpolation, IsContinuousAcrossSamplesToTheLastBits) {
  constexpr std::uint64_t kSeed = 15;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const std::vector<double> row = randomRow(random, 9);
  for (int k = 1; k < 8; ++k) {
    const double sample = row[static_cast<std::size_t>(k)];
    EXPECT_NEAR(interpolate(row, std::nextafter(k, 0.0)), sample, 1e-11);
    EXPECT_NEAR(interpolate(row, std::nextafter(k, 9.0)), sample, 1e-11);
  }
}

}  // namespace
}  // namespace teren
