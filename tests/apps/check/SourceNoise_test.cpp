#include "apps/check/SourceNoise.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "apps/check/Ensemble.h"
#include "apps/check/MapComparison.h"

namespace teren::check {
namespace {

MapMaker maker() {
  return MapMaker(std::make_shared<SourceNoise>(), "defaults");
}

TEST(SourceNoise, HasItsMeanAndDeviationAtEverySampleWhateverTheSide) {
  const MapMaker noise = maker();
  Ensemble ensemble(noise);
  while (ensemble.seeds() < 1000) ensemble.add();
  for (int y = 0; y < Ensemble::kSamples; ++y) {
    for (int x = 0; x < Ensemble::kSamples; ++x) {
      EXPECT_NEAR(ensemble.meanAt(x, y).value, 0.0, 5.0 * ensemble.meanAt(x, y).error) << x << ", " << y;
      EXPECT_NEAR(ensemble.deviationAt(x, y), SourceNoise::kDeviation, 0.12 * SourceNoise::kDeviation)
          << x << ", " << y;
    }
  }
  for (const int samples : {3, 65}) {
    double square = 0.0;
    for (int n = 0; n < 400; ++n) {
      const float height = noise.make(requestOf(n, samples, 6))(0, 0);
      square += height * height / 400.0;
    }
    EXPECT_NEAR(std::sqrt(square), SourceNoise::kDeviation, 0.15 * SourceNoise::kDeviation) << samples;
  }
}

TEST(SourceNoise, HasExactLevelsInsideItsRange) {
  const MapMaker noise = maker();
  const HeightRange range = noise.range();
  for (const int samples : {3, 65}) {
    const HeightMap finest = noise.make(requestOf(1, samples));
    for (const float height : finest.samples()) {
      EXPECT_GE(height, range.min);
      EXPECT_LE(height, range.max);
    }
    for (int level = 1; level <= 7; ++level) {
      EXPECT_TRUE(sameBits(noise.make(requestOf(1, samples, level)).view(), subsampled(finest, level).view()))
          << level;
    }
  }
}

TEST(SourceNoise, IsAsRoughAsFaultsAndLosesLessThanItSays) {
  const MapMaker noise = maker();
  std::vector<double> squares(4);
  for (int n = 0; n < 40; ++n) {
    const HeightMap finest = noise.make(requestOf(n, 129));
    for (int level = 1; level <= 3; ++level)
      squares[level] += squaredError(finest, subsampled(finest, level), level) / 40.0;
  }
  for (int level = 1; level <= 3; ++level)
    EXPECT_LE(std::sqrt(squares[level]), noise.residual(level, 129)) << level;
  // Hurst's exponent 1/2: twice the distance, sqrt 2 times the error.
  for (int level = 1; level <= 2; ++level)
    EXPECT_NEAR(std::sqrt(squares[level + 1] / squares[level]), std::sqrt(2.0), 0.15) << level;
}

}  // namespace
}  // namespace teren::check
