#include "generators/midpoint/MidpointDisplacement.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "generators/midpoint/MidpointReference.h"
#include "generators/numbers/Gaussian.h"
#include "tests/support/AllocationCount.h"
#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

using test::finish;
using test::sameBits;

MapRequest requestOf(std::uint64_t seed, int samples, int level = 0) {
  const int intervals = (samples - 1) >> level;
  return {.seed = seed,
          .samples = intervals < 2 ? 1 : intervals + 1,
          .level = level,
          .finestIntervals = samples - 1};
}

HeightMap made(const MidpointDisplacement& displacement, const MapRequest& request,
               const Slice& slice = Slice::unlimited()) {
  HeightMap map(request.samples, request.samples);
  finish(*displacement.begin(request, map.view()), slice);
  return map;
}

HeightMap plain(const MidpointDisplacement& displacement, const MapRequest& request) {
  HeightMap map(request.samples, request.samples);
  midpointReference(displacement, request, map.view());
  return map;
}

MidpointSettings withHurst(double hurst, bool published = false) {
  return {.hurst = hurst, .published = published};
}

MidpointSettings lopsided(bool published) {
  return {.hurst = 0.6,
          .deviation = 7.0,
          .published = published,
          .corners = {1.0, 0.25, 0.0, 0.5},
          .centre = MidpointSource::randR,
          .south = MidpointSource::randN,
          .west = MidpointSource::randR,
          .north = MidpointSource::randG,
          .east = MidpointSource::randN};
}

/// Settings of every kind: both rules, the ends and the middle of hurst, lopsided and missing corners.
std::vector<MidpointSettings> variousSettings() {
  std::vector<MidpointSettings> settings;
  for (const bool published : {false, true}) {
    for (double hurst : {0.0, 0.2, 0.5, 0.8, 1.0}) settings.push_back(withHurst(hurst, published));
    settings.push_back(lopsided(published));
    settings.push_back({.hurst = 0.7, .published = published, .corners = {}});
    settings.push_back({.hurst = 0.7, .deviation = 0.0, .published = published});
  }
  return settings;
}

std::string describe(const MidpointSettings& settings) {
  return (settings.published ? "published, hurst " : "corrected, hurst ") + std::to_string(settings.hurst) +
         ", first corner " + std::to_string(settings.corners[0]);
}

TEST(MidpointDisplacement, EqualsThePlainVersionBitForBit) {
  for (const MidpointSettings& settings : variousSettings()) {
    const MidpointDisplacement displacement(settings);
    for (int samples : {2, 3, 5, 9, 33, 129}) {
      for (std::uint64_t seed : {0ULL, 1ULL, ~0ULL}) {
        const MapRequest request{.seed = seed, .samples = samples};
        EXPECT_TRUE(sameBits(made(displacement, request).view(), plain(displacement, request).view()))
            << describe(settings) << ", " << samples << " samples, seed " << seed;
      }
    }
    const MapRequest centre = requestOf(5, 65, 6);
    EXPECT_EQ(made(displacement, centre)(0, 0), plain(displacement, centre)(0, 0)) << describe(settings);
  }
}

std::uint64_t hashOf(const HeightMap& map) {
  Fnv1a hash;
  for (float height : map.samples()) {
    const auto bits = std::bit_cast<std::uint32_t>(height);
    for (int shift = 0; shift < 32; shift += 8) hash.addByte(static_cast<std::uint8_t>(bits >> shift));
  }
  return hash.value();
}

TEST(MidpointDisplacement, HasTheBitsItHadWhenWritten) {
  const std::pair<MidpointSettings, std::uint64_t> known[] = {{withHurst(0.8), 0x96186aceb02e427c},
                                                              {withHurst(0.25), 0x15e58267ccd62d5},
                                                              {lopsided(false), 0xd06960ab82884935},
                                                              {lopsided(true), 0xf8af13d4c06e118e}};
  for (const auto& [settings, hash] : known) {
    EXPECT_EQ(hashOf(made(MidpointDisplacement(settings), requestOf(42, 129))), hash) << describe(settings);
  }
}

TEST(MidpointDisplacement, EveryLevelIsTheSubsampledFinestMap) {
  for (const MidpointSettings& settings : variousSettings()) {
    const MidpointDisplacement displacement(settings);
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const HeightMap finest = made(displacement, requestOf(seed, 129));
      for (int level = 1; level <= 8; ++level) {
        EXPECT_TRUE(sameBits(made(displacement, requestOf(seed, 129, level)).view(),
                             test::subsampled(finest, level).view()))
            << describe(settings) << ", level " << level << ", seed " << seed;
      }
    }
  }
}

TEST(MidpointDisplacement, DoesNotDependOnSlicing) {
  const MidpointDisplacement displacement(withHurst(0.5));
  for (int samples : {3, 65}) {
    const MapRequest request = requestOf(9, samples);
    EXPECT_TRUE(sameBits(made(displacement, request, test::shortestSlice()).view(),
                         made(displacement, request).view()));
  }
}

TEST(MidpointDisplacement, StopsAfterARowWhenTheSliceIsOver) {
  const MidpointDisplacement displacement(withHurst(0.5));
  HeightMap map(257, 257);
  int rows = 0;
  for (int squares = 1; squares < 256; squares *= 2) rows += 3 * squares + 1;
  EXPECT_EQ(finish(*displacement.begin(requestOf(1, 257), map.view()), test::shortestSlice()), rows);
}

TEST(MidpointDisplacement, DoesNotAllocateOnceBegun) {
  const MidpointDisplacement displacement(withHurst(0.5));
  for (int level : {0, 6}) {
    const MapRequest request = requestOf(1, 65, level);
    HeightMap map(request.samples, request.samples);
    const auto task = displacement.begin(request, map.view());
    const long before = test::allocationCount();
    finish(*task, test::shortestSlice());
    EXPECT_EQ(test::allocationCount(), before);
  }
}

/// Mean squared difference of two heights so many samples apart, both ways along both axes.
double meanSquaredDifference(const HeightMap& map, int lag, bool diagonal = false) {
  double sum = 0.0;
  long count = 0;
  const auto add = [&](float a, float b) {
    const double difference = static_cast<double>(a) - static_cast<double>(b);
    sum += difference * difference;
    ++count;
  };
  const int side = map.columns();
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      if (!diagonal && column + lag < side) add(map(column, row), map(column + lag, row));
      if (!diagonal && row + lag < side) add(map(column, row), map(column, row + lag));
      if (diagonal && column + lag < side && row + lag < side) {
        add(map(column, row), map(column + lag, row + lag));
        add(map(column + lag, row), map(column, row + lag));
      }
    }
  }
  return sum / static_cast<double>(count);
}

constexpr int kLags = 6;  // 1, 2 ... 32 samples of 257

/// The estimator: half the slope of the least-squares line through the logarithms of the mean squared
/// differences at lags 1, 2, 4 ... against the logarithms of the lags.
double hurstOf(const std::array<double, kLags>& differences) {
  double sum = 0.0, weights = 0.0;
  for (int n = 0; n < kLags; ++n) {
    const double fromMiddle = n - 0.5 * (kLags - 1);
    sum += fromMiddle * std::log2(differences[n]);
    weights += fromMiddle * fromMiddle;
  }
  return 0.5 * sum / weights;
}

struct Estimates {
  double mean = 0.0;                            ///< of the estimates of single maps
  std::array<double, kLags> along{}, across{};  ///< mean squared differences, axes and diagonals
};

Estimates estimates(const MidpointSettings& settings, int maps) {
  const MidpointDisplacement displacement(settings);
  Estimates result;
  for (int n = 0; n < maps; ++n) {
    const HeightMap map = made(displacement, requestOf(mixBits(n), 257));
    std::array<double, kLags> differences{};
    for (int k = 0; k < kLags; ++k) {
      differences[k] = meanSquaredDifference(map, 1 << k);
      result.along[k] += differences[k] / maps;
      result.across[k] += meanSquaredDifference(map, 1 << k, true) / maps;
    }
    result.mean += hurstOf(differences) / maps;
  }
  return result;
}

TEST(MidpointDisplacement, HasTheRoughnessAskedFor) {
  for (double hurst : {0.2, 0.35, 0.5, 0.65, 0.8}) {
    const Estimates measured = estimates(withHurst(hurst), 64);
    EXPECT_NEAR(measured.mean, hurst, 0.03);
    RecordProperty("hurst_" + std::to_string(hurst), std::to_string(measured.mean));
    for (int k = 1; k < kLags; ++k) {
      EXPECT_NEAR(0.5 * std::log2(measured.along[k] / measured.along[k - 1]), hurst, 0.05)
          << "hurst " << hurst << ", lags " << (1 << (k - 1)) << " and " << (1 << k);
    }
  }
}

TEST(MidpointDisplacement, IsAsRoughAlongDiagonalsAsAlongAxes) {
  for (double hurst : {0.2, 0.5, 0.8}) {
    const Estimates measured = estimates(withHurst(hurst), 32);
    for (int k = 0; k < kLags; ++k) {
      EXPECT_NEAR(measured.across[k] / measured.along[k] / std::exp2(hurst), 1.0, 0.06)
          << "hurst " << hurst << ", lag " << (1 << k);
    }
  }
}

TEST(MidpointDisplacement, HasTheKnownBiasWhenPublished) {
  const std::pair<double, double> known[] = {{0.2, 0.24}, {0.5, 0.44}, {0.8, 0.69}};
  for (const auto& [hurst, estimate] : known) {
    const double measured = estimates(withHurst(hurst, true), 64).mean;
    EXPECT_NEAR(measured, estimate, 0.03) << "hurst " << hurst;
    RecordProperty("published_" + std::to_string(hurst), std::to_string(measured));
  }
}

/// Mean squares of every sample over seeds.
std::vector<double> meanSquares(const MidpointSettings& settings, int samples, int seeds) {
  const MidpointDisplacement displacement(settings);
  std::vector<double> squares(static_cast<std::size_t>(samples) * static_cast<std::size_t>(samples));
  for (int n = 0; n < seeds; ++n) {
    const HeightMap map = made(displacement, requestOf(mixBits(n), samples));
    for (std::size_t sample = 0; sample < squares.size(); ++sample) {
      const double height = map.samples()[sample];
      squares[sample] += height * height / seeds;
    }
  }
  return squares;
}

double meanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

TEST(MidpointDisplacement, HasTheDeviationAskedForOverAThousandSeeds) {
  for (const MidpointSettings& settings : variousSettings()) {
    for (int samples : {65, 257}) {
      const double measured = std::sqrt(meanOf(meanSquares(settings, samples, samples == 65 ? 1000 : 100)));
      const double tolerance = samples == 65 ? 0.03 : 0.1;
      EXPECT_NEAR(measured, settings.deviation, tolerance * settings.deviation)
          << describe(settings) << ", " << samples << " samples";
    }
  }
}

TEST(MidpointDisplacement, HasMeanZeroAtEveryPointWhateverTheSources) {
  constexpr int seeds = 20000, samples = 9;
  for (const bool published : {false, true}) {
    const MidpointDisplacement displacement(lopsided(published));
    std::vector<double> sums(samples * samples), squares(samples * samples);
    for (int n = 0; n < seeds; ++n) {
      const HeightMap map = made(displacement, requestOf(mixBits(n), samples));
      for (std::size_t sample = 0; sample < sums.size(); ++sample) {
        sums[sample] += map.samples()[sample];
        squares[sample] += static_cast<double>(map.samples()[sample]) * map.samples()[sample];
      }
    }
    for (std::size_t sample = 0; sample < sums.size(); ++sample) {
      EXPECT_LT(std::fabs(sums[sample]), 5.0 * std::sqrt(squares[sample])) << "sample " << sample;
    }
  }
}

TEST(MidpointDisplacement, HasTheSameDeviationAtEveryPoint) {
  constexpr int seeds = 20000, samples = 17;
  for (double hurst : {0.2, 0.5, 0.8, 1.0}) {
    const std::vector<double> squares = meanSquares(withHurst(hurst), samples, seeds);
    for (std::size_t sample = 0; sample < squares.size(); ++sample) {
      // 0.02 are promised, five standard errors of the measurement come on top.
      EXPECT_NEAR(std::sqrt(squares[sample]) / 4.0, 1.0, 0.02 + 5.0 / std::sqrt(2.0 * seeds))
          << "hurst " << hurst << ", sample " << sample;
    }
  }
}

TEST(MidpointDisplacement, NeverLeavesItsRangeHoweverUnlikely) {
  for (const MidpointSettings& settings : variousSettings()) {
    const MidpointDisplacement displacement(settings);
    const HeightRange range = displacement.range();
    EXPECT_EQ(range.mean, 0.0);
    EXPECT_EQ(range.deviation, settings.deviation);
    EXPECT_EQ(range.min, -range.max);
    // All displacements at their largest, all the same way, by the plan alone.
    const MidpointPlan& plan = displacement.plan(8);
    double largest = plan.cornerMove * Gaussian::kCut;
    if (settings.centre != MidpointSource::randG) continue;
    for (const MidpointStage& stage : plan.stages) {
      double weights = 0.0;
      for (double weight : stage.centre) weights += weight;
      const double centre = weights * largest + stage.centreMove * Gaussian::kCut;
      const double edge = 2.0 * stage.ends * largest + (stage.firstCentre + stage.secondCentre) * centre +
                          stage.moves[0] * Gaussian::kCut;
      const double rim =
          2.0 * stage.rimEnds * largest + stage.rimCentre * centre + stage.rimMoves[0] * Gaussian::kCut;
      largest = std::max({largest, centre, edge, rim});
    }
    EXPECT_GE(range.max, largest) << describe(settings);
    if (settings.corners[0] > 0.0) {
      EXPECT_LE(range.max, 60.0 * settings.deviation) << describe(settings);
    }
  }
}

TEST(MidpointDisplacement, ResidualIsWithinAFactorOfWhatIsMeasured) {
  for (const MidpointSettings& settings : variousSettings()) {
    if (settings.deviation == 0.0) continue;
    const MidpointDisplacement displacement(settings);
    EXPECT_EQ(displacement.residual(0, 257), 0.0);
    for (int samples : {17, 257}) {
      const int seeds = samples == 17 ? 400 : 30;
      std::array<double, 9> squares{};
      for (int seed = 0; seed < seeds; ++seed) {
        const HeightMap finest = made(displacement, requestOf(mixBits(seed), samples));
        test::addSquaredErrors(finest, seeds, squares);
      }
      for (int level = 1; (samples - 1) >> level >= 2; ++level) {
        const double ratio = displacement.residual(level, samples) / std::sqrt(squares[level]);
        EXPECT_GT(ratio, 1.0 / 1.5) << describe(settings) << ", " << samples << " samples, level " << level;
        EXPECT_LT(ratio, 1.5) << describe(settings) << ", " << samples << " samples, level " << level;
      }
      if (settings.corners[0] == 0.0) continue;  // a centre that knows nothing of its map
      const double ratio = displacement.residual(20, samples) / std::sqrt(squares[0]);
      EXPECT_GT(ratio, 1.0 / 1.6) << describe(settings) << ", the centre alone";
      EXPECT_LT(ratio, 1.6) << describe(settings) << ", the centre alone";
    }
  }
}

}  // namespace
}  // namespace teren
