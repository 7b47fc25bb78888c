#include "generators/spectral/SpectralSynthesis.h"

#include <bit>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "generators/spectral/SpectralReference.h"
#include "tests/support/AllocationCount.h"
#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

using test::finish;
using test::sameBits;

constexpr SpectralRule kRules[] = {SpectralRule::isotropic, SpectralRule::published};

const char* nameOf(SpectralRule rule) {
  return rule == SpectralRule::published ? "published" : "isotropic";
}

MapRequest requestOf(std::uint64_t seed, int samples) {
  return {.seed = seed, .samples = samples, .finestIntervals = samples - 1};
}

HeightMap made(const SpectralSynthesis& synthesis, const MapRequest& request,
               const Slice& slice = Slice::unlimited()) {
  HeightMap map(request.samples, request.samples);
  finish(*synthesis.begin(request, map.view()), slice);
  return map;
}

TEST(SpectralSynthesis, EqualsTheDirectSumButForRounding) {
  for (SpectralRule rule : kRules) {
    for (int harmonics : {1, 4, 16, 32, 128}) {
      const SpectralSynthesis synthesis(rule, 0.6, 1.0, harmonics, {.east = 0.3, .north = -0.1});
      for (int samples : {2, 3, 5, 17, 65}) {
        const MapRequest request = requestOf(9, samples);
        const HeightMap map = made(synthesis, request);
        const std::vector<double> reference = spectralReference(synthesis, request);
        double square = 0.0, largest = 0.0;
        for (std::size_t n = 0; n < reference.size(); ++n) {
          const double error = map.samples()[n] - reference[n];
          square += error * error;
          largest = std::max(largest, std::fabs(error));
        }
        const double rms = std::sqrt(square / static_cast<double>(reference.size()));
        EXPECT_LT(rms, 3e-7) << nameOf(rule) << ", " << harmonics << " harmonics, " << samples << " samples";
        EXPECT_LT(largest, 2e-6) << nameOf(rule) << ", " << harmonics << " harmonics, " << samples
                                 << " samples";
        RecordProperty("rms_" + std::to_string(harmonics), std::to_string(rms * 1e9) + " nm of 1 m");
      }
    }
  }
}

TEST(SpectralSynthesis, EveryLevelIsTheSubsampledFinestMap) {
  for (SpectralRule rule : kRules) {
    for (int harmonics : {1, 2, 20, 32, 128}) {
      const SpectralSynthesis synthesis(rule, 0.6, 4.0, harmonics);
      for (int samples : {3, 5, 65, 257}) {
        const HeightMap finest = made(synthesis, requestOf(3, samples));
        for (int level = 1; level <= 9; ++level) {
          const HeightMap coarse = test::subsampled(finest, level);
          MapRequest request = requestOf(3, coarse.columns());
          request.level = level;
          request.finestIntervals = samples - 1;
          EXPECT_TRUE(sameBits(made(synthesis, request).view(), coarse.view()))
              << nameOf(rule) << ", " << harmonics << " harmonics, " << samples << " samples, level "
              << level;
        }
      }
    }
  }
}

TEST(SpectralSynthesis, ShowsTheSameLandWithMoreSamples) {
  const SpectralSynthesis synthesis(SpectralRule::isotropic, 0.6, 4.0, 15);
  const HeightMap map = made(synthesis, requestOf(3, 33));
  EXPECT_TRUE(sameBits(map.view(), test::subsampled(made(synthesis, requestOf(3, 129)), 2).view()));
}

TEST(SpectralSynthesis, DoesNotDependOnSlicing) {
  for (SpectralRule rule : kRules) {
    const SpectralSynthesis synthesis(rule, 0.6, 4.0, 32);
    for (int samples : {1, 2, 3, 65}) {
      EXPECT_TRUE(sameBits(made(synthesis, requestOf(5, samples), test::shortestSlice()).view(),
                           made(synthesis, requestOf(5, samples)).view()))
          << nameOf(rule) << ", " << samples << " samples";
    }
  }
}

TEST(SpectralSynthesis, DoesNotAllocateOnceBegun) {
  for (SpectralRule rule : kRules) {
    const SpectralSynthesis synthesis(rule, 0.6, 4.0, 32);
    made(synthesis, requestOf(1, 3));  // the table of Gaussian numbers is made once
    for (int samples : {1, 65}) {
      HeightMap map(samples, samples);
      const auto task = synthesis.begin(requestOf(1, samples), map.view());
      const long before = test::allocationCount();
      finish(*task, test::shortestSlice());
      EXPECT_EQ(test::allocationCount(), before);
    }
  }
}

TEST(SpectralSynthesis, HasMeanZeroAndItsDeviationAtEveryPointAndTime) {
  constexpr int seeds = 4000, samples = 3;
  constexpr double deviation = 4.0;
  for (SpectralRule rule : kRules) {
    for (const PhaseShift shift : {PhaseShift{}, PhaseShift{.east = 0.2, .north = 0.45}}) {
      const SpectralSynthesis synthesis(rule, 0.8, deviation, 32, shift);
      std::vector<double> sums(samples * samples), squares(samples * samples);
      for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        MapRequest request = requestOf(mixBits(seed), samples);
        request.level = 5;  // of 65 samples: all harmonics count
        const HeightMap map = made(synthesis, request);
        for (std::size_t n = 0; n < sums.size(); ++n) {
          sums[n] += map.samples()[n];
          squares[n] += static_cast<double>(map.samples()[n]) * map.samples()[n];
        }
      }
      for (std::size_t n = 0; n < sums.size(); ++n) {
        EXPECT_LT(std::fabs(sums[n] / seeds), 4.0 * deviation / std::sqrt(seeds)) << nameOf(rule) << " " << n;
        // The products of the published rule have long tails: its mean square converges more slowly.
        const double allowed = rule == SpectralRule::published ? 0.06 : 0.03;
        EXPECT_NEAR(std::sqrt(squares[n] / seeds), deviation, allowed * deviation)
            << nameOf(rule) << " " << n;
      }
    }
  }
}

TEST(SpectralSynthesis, PromisesARangeThatNoWavesLeave) {
  for (SpectralRule rule : kRules) {
    for (int harmonics : {1, 2, 32, 128}) {
      const SpectralSynthesis synthesis(rule, 0.5, 2.5, harmonics);
      const HeightRange range = synthesis.range();
      EXPECT_EQ(range.mean, 0.0);
      EXPECT_EQ(range.deviation, 2.5);
      EXPECT_EQ(range.min, -range.max);
      for (int samples : {3, 17, 65}) {
        const SpectralHarmonics waves = synthesis.harmonicsOf(requestOf(1, samples));
        std::vector<Harmonic> row(static_cast<std::size_t>(2 * waves.largest() + 1));
        double sum = 0.0;
        for (int l = 0; l <= waves.largest(); ++l) {
          waves.row(l, row.data());
          for (const Harmonic& wave : row) sum += std::hypot(wave.re, wave.im);
        }
        EXPECT_LT(synthesis.scaleOf(requestOf(1, samples)) * sum, range.max);
      }
    }
  }
  // One wave east and one north, both with two numbers at the cut: 4 sqrt(2) times two, over sqrt(2).
  EXPECT_NEAR(SpectralSynthesis(SpectralRule::isotropic, 0.5, 1.0, 1).range().max, 8.0, 1e-3);
}

/// The mean of |F(k, l)|^2 over maps, by the definition.
std::vector<double> meanPower(const SpectralSynthesis& synthesis, int intervals, int maps) {
  const auto n = static_cast<std::size_t>(intervals);
  std::vector<double> cosines(n), sines(n), power(n * n);
  for (std::size_t m = 0; m < n; ++m) {
    cosines[m] = std::cos(2.0 * std::numbers::pi * static_cast<double>(m) / intervals);
    sines[m] = std::sin(2.0 * std::numbers::pi * static_cast<double>(m) / intervals);
  }
  for (int seed = 0; seed < maps; ++seed) {
    const HeightMap map =
        made(synthesis, requestOf(mixBits(static_cast<std::uint64_t>(seed)), intervals + 1));
    std::vector<double> re(n * n), im(n * n);
    for (std::size_t y = 0; y < n; ++y) {
      for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t x = 0; x < n; ++x) {
          const double height = map(static_cast<int>(x), static_cast<int>(y));
          re[y * n + k] += height * cosines[k * x % n];
          im[y * n + k] -= height * sines[k * x % n];
        }
      }
    }
    for (std::size_t l = 0; l < n; ++l) {
      for (std::size_t k = 0; k < n; ++k) {
        double a = 0.0, b = 0.0;
        for (std::size_t y = 0; y < n; ++y) {
          const double c = cosines[l * y % n], s = sines[l * y % n];
          a += re[y * n + k] * c + im[y * n + k] * s;
          b += im[y * n + k] * c - re[y * n + k] * s;
        }
        power[l * n + k] += (a * a + b * b) / maps;
      }
    }
  }
  return power;
}

/// The slope of a straight line through the points (log x, log y).
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double u = std::log(x[n]), v = std::log(y[n]);
    sx += u, sy += v, sxx += u * u, sxy += u * v;
  }
  const double count = static_cast<double>(x.size());
  return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

TEST(SpectralSynthesis, HasTheHurstExponentAskedForInItsRadialSpectrum) {
  constexpr int intervals = 32, maps = 64;
  for (double hurst : {0.2, 0.5, 0.8}) {
    const std::vector<double> power =
        meanPower(SpectralSynthesis(SpectralRule::isotropic, hurst, 1.0, 15), intervals, maps);
    // The mean over rings of width 1, at the mean radius of each.
    std::vector<double> radii(15), sums(15), counts(15);
    for (int l = -15; l <= 15; ++l) {
      for (int k = -15; k <= 15; ++k) {
        const double radius = std::hypot(k, l);
        const auto ring = static_cast<std::size_t>(std::lround(radius));
        if (ring < 1 || ring >= 15) continue;
        radii[ring] += std::log(radius);
        sums[ring] += power[static_cast<std::size_t>((l & 31) * intervals + (k & 31))];
        counts[ring] += 1.0;
      }
    }
    std::vector<double> x, y;
    for (std::size_t ring = 1; ring < 15; ++ring) {
      x.push_back(std::exp(radii[ring] / counts[ring]));
      y.push_back(sums[ring] / counts[ring]);
    }
    EXPECT_NEAR(-slope(x, y) / 2.0 - 1.0, hurst, 0.05) << "|k|^-(2 H + 2)";
  }
}

TEST(SpectralSynthesis, FallsAlongTheAxesAsPublished) {
  constexpr int intervals = 32, maps = 64;
  for (double hurst : {0.2, 0.5, 0.8}) {
    const std::vector<double> power =
        meanPower(SpectralSynthesis(SpectralRule::published, hurst, 1.0, 15), intervals, maps);
    std::vector<double> x, y;
    for (int k = 1; k < 15; ++k) {
      double east = 0.0, north = 0.0;
      for (int l = 0; l < 15; ++l) {
        east += power[static_cast<std::size_t>(l * intervals + k)];
        north += power[static_cast<std::size_t>(k * intervals + l)];
      }
      x.push_back(k + 1.0);
      y.push_back(east + north);
      EXPECT_LT(power[static_cast<std::size_t>((intervals - k) * intervals + k)], 1e-6 * east)
          << "one quadrant";
    }
    EXPECT_NEAR((-slope(x, y) - 1.0) / 2.0, hurst, 0.1) << "(k + 1)^-(2 H + 1)";
  }
}

TEST(SpectralSynthesis, DriftsWithTheWind) {
  // A sixteenth of a turn of the longest wave is a sixteenth of the map.
  const SpectralSynthesis still(SpectralRule::isotropic, 0.7, 1.0, 20);
  const SpectralSynthesis blown(SpectralRule::isotropic, 0.7, 1.0, 20,
                                {.east = 1.0 / 16, .north = -1.0 / 32});
  const HeightMap before = made(still, requestOf(4, 65)), after = made(blown, requestOf(4, 65));
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      ASSERT_NEAR(after((x + 4) % 64, (y + 62) % 64), before(x, y), 2e-6) << x << ", " << y;
    }
  }
}

TEST(SpectralSynthesis, TurnsThePhasesOfThePublishedRuleAndKeepsWhole) {
  const SpectralSynthesis still(SpectralRule::published, 0.7, 1.0, 20);
  const SpectralSynthesis half(SpectralRule::published, 0.7, 1.0, 20, {.east = 0.5});
  const SpectralSynthesis whole(SpectralRule::published, 0.7, 1.0, 20, {.east = 3.0, .north = -2.0});
  const HeightMap before = made(still, requestOf(4, 65)), opposite = made(half, requestOf(4, 65));
  EXPECT_TRUE(sameBits(made(whole, requestOf(4, 65)).view(), before.view()));
  for (std::size_t n = 0; n < before.samples().size(); ++n) {
    ASSERT_NEAR(opposite.samples()[n], -before.samples()[n], 2e-6) << "cos and sin of pa change sign";
  }
}

TEST(SpectralSynthesis, ResidualIsWithinAFactorOfWhatIsMeasured) {
  for (SpectralRule rule : kRules) {
    for (int harmonics : {4, 32, 128}) {
      const SpectralSynthesis synthesis(rule, 0.7, 3.0, harmonics);
      EXPECT_EQ(synthesis.residual(0, 257), 0.0);
      for (int samples : {17, 129}) {
        constexpr int seeds = 40;
        std::vector<double> squares(10);
        for (std::uint64_t seed = 0; seed < seeds; ++seed) {
          const HeightMap finest = made(synthesis, requestOf(mixBits(seed), samples));
          test::addSquaredErrors(finest, seeds, squares);
        }
        for (int level = 1; (samples - 1) >> level >= 2; ++level) {
          const double ratio = synthesis.residual(level, samples) / std::sqrt(squares[level]);
          EXPECT_GT(ratio, 0.8) << nameOf(rule) << harmonics << ", " << samples << " samples, level "
                                << level;
          EXPECT_LT(ratio, 1.3) << nameOf(rule) << harmonics << ", " << samples << " samples, level "
                                << level;
        }
        EXPECT_NEAR(synthesis.residual(40, samples) / std::sqrt(squares[0]), 1.0, 0.3) << "the centre alone";
      }
    }
  }
}

// Law 1: any processor, any width of registers.
TEST(SpectralSynthesis, HasTheBitsItHadWhenWritten) {
  const std::tuple<SpectralRule, int, std::uint64_t> known[] = {
      {SpectralRule::isotropic, 65, 0xd890e943f222786a},
      {SpectralRule::isotropic, 257, 0x86c4110a67813900},
      {SpectralRule::published, 65, 0x35719477403bbc27},
      {SpectralRule::published, 257, 0x3fcbd46614cc1cb8},
  };
  for (const auto& [rule, samples, expected] : known) {
    const SpectralSynthesis synthesis(rule, 0.7, 60.0, 32, {.east = 0.3, .north = 0.123});
    const HeightMap map = made(synthesis, requestOf(42, samples));
    Fnv1a hash;
    for (float height : map.samples()) {
      const auto bits = std::bit_cast<std::uint32_t>(height);
      for (int shift = 0; shift < 32; shift += 8) hash.addByte(static_cast<std::uint8_t>(bits >> shift));
    }
    EXPECT_EQ(hash.value(), expected) << nameOf(rule) << ", " << samples << " samples";
  }
}

}  // namespace
}  // namespace teren
