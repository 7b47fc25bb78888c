#include "generators/noise/Noise.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "tests/generators/noise/NoiseReference.h"
#include "tests/support/AllocationCount.h"
#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

using test::finish;
using test::sameBits;

constexpr NoiseKind kKinds[] = {NoiseKind::perlin, NoiseKind::simplex};
constexpr NoiseFractal kFractals[] = {NoiseFractal::fbm, NoiseFractal::ridged, NoiseFractal::billow};

std::string describe(const NoiseSettings& settings) {
  const char* const fractals[] = {"fbm", "ridged", "billow"};
  return std::string(settings.kind == NoiseKind::perlin ? "perlin " : "simplex ") +
         fractals[static_cast<int>(settings.fractal)] + ", " + std::to_string(settings.octaves) +
         " octaves from " + std::to_string(settings.frequency) + "/m, lacunarity " +
         std::to_string(settings.lacunarity) + ", hurst " + std::to_string(settings.hurst) + ", warp " +
         std::to_string(settings.warp);
}

/// `base` in both kinds, as all fractals, without warp and with.
std::vector<NoiseSettings> allVariants(NoiseSettings base, double warp) {
  std::vector<NoiseSettings> variants;
  for (const NoiseKind kind : kKinds) {
    for (const NoiseFractal fractal : kFractals) {
      for (const double metres : {0.0, warp}) {
        variants.push_back(base);
        variants.back().kind = kind;
        variants.back().fractal = fractal;
        variants.back().warp = metres;
      }
    }
  }
  return variants;
}

std::vector<NoisePath> paths() {
  std::vector<NoisePath> all;
  for (const NoisePath path : {NoisePath::plain, NoisePath::avx2, NoisePath::avx512}) {
    if (Noise::runs(path)) all.push_back(path);
  }
  return all;
}

HeightMap made(const Noise& noise, const FieldRequest& request, const Slice& slice = Slice::unlimited()) {
  HeightMap map(request.columns, request.rows);
  finish(*noise.begin(request, map.view()), slice);
  return map;
}

HeightMap made(const Noise& noise, const FieldRequest& request, NoisePath path) {
  HeightMap map(request.columns, request.rows);
  finish(*noise.begin(request, map.view(), path));
  return map;
}

/// Sample (column, row) of a request as a request of its own, its origin another lattice point where need be.
FieldRequest single(FieldRequest request, int column, int row) {
  const auto move = [&request](std::int64_t& point, double& offset, int samples) {
    const double place = offset + samples * request.spacing / request.pitch;
    point += static_cast<std::int64_t>(std::floor(place));
    offset = place - std::floor(place);
  };
  move(request.i, request.u, column);
  move(request.j, request.v, row);
  request.columns = request.rows = 1;
  return request;
}

test::Digits placeOf(std::int64_t point, double offset) {
  return test::position(point, static_cast<std::int64_t>(offset * 0x1p32));
}

TEST(Noise, EveryPathHasTheSameBits) {
  for (const int octaves : {1, 8, 24}) {
    for (const NoiseSettings& settings :
         allVariants({.octaves = octaves, .frequency = 0.05, .lacunarity = 1.9}, 30.0)) {
      const Noise noise(settings);
      for (const auto& [columns, rows] : {std::pair{1, 1}, {7, 3}, {16, 2}, {150, 9}, {300, 2}}) {
        const FieldRequest request{.i = -5,
                                   .j = (std::int64_t{1} << 45) + 3,
                                   .u = 0.3,
                                   .v = 0.75,
                                   .seed = 11,
                                   .spacing = 0.5,
                                   .columns = columns,
                                   .rows = rows};
        const HeightMap plain = made(noise, request, NoisePath::plain);
        for (const NoisePath path : paths()) {
          EXPECT_TRUE(sameBits(made(noise, request, path).view(), plain.view()))
              << describe(settings) << ", path " << static_cast<int>(path) << ", " << columns << " columns";
        }
      }
    }
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

TEST(Noise, HasTheBitsItHadWhenWritten) {
  constexpr std::uint64_t known[] = {0x1e5752d10be84297, 0x4fbf40f81f625116, 0x1f4508ac98ef6547,
                                     0x2365b9465d8927bd, 0xd5735e3147cee4f1, 0xed2e17bc98bd03c3,
                                     0x637f58247d8e3a7a, 0x01cfdacc21182c36, 0x835daf23042c4631,
                                     0x0a7e85da3cc3d97d, 0x7af9fa29728a5355, 0xe8cf6b49e97562eb};
  std::size_t n = 0;
  for (const NoiseSettings& settings : allVariants({.octaves = 10, .hurst = 0.7, .deviation = 20.0}, 40.0)) {
    const FieldRequest request{
        .i = -3, .j = std::int64_t{1} << 52, .u = 0.125, .seed = 42, .columns = 33, .rows = 33};
    EXPECT_EQ(hashOf(made(Noise(settings), request)), known[n++]) << describe(settings);
  }
}

TEST(Noise, LiesWithinItsRoundingBoundOfTheDefinitionHoweverFar) {
  for (const NoiseSettings& settings :
       allVariants({.octaves = 9, .frequency = 0.01, .deviation = 1.0}, 25.0)) {
    const Noise noise(settings);
    for (const std::int64_t far : {std::int64_t{0}, std::int64_t{1} << 40, (std::int64_t{1} << 52) + 1}) {
      const FieldRequest request{
          .i = far, .j = -far - 1, .u = 0.4375, .v = 0.25, .seed = 3, .columns = 13, .rows = 11};
      const test::NoiseReference reference(noise, request.seed, request.pitch);
      const HeightMap map = made(noise, request);
      for (int row = 0; row < request.rows; ++row) {
        for (int column = 0; column < request.columns; ++column) {
          const FieldRequest at = single(request, column, row);
          const long double exact = reference.height(placeOf(at.i, at.u), placeOf(at.j, at.v));
          EXPECT_NEAR(map(column, row), static_cast<double>(exact), noise.roundingBound())
              << describe(settings) << " at " << far;
          EXPECT_NEAR(noise.pointAt(at).height, static_cast<double>(exact), 1e-11);
        }
      }
      EXPECT_LT(noise.roundingBound(), settings.warp > 0.0 ? 1e-2 : 2e-4);
    }
  }
}

// The lower words of lattice coordinates begin anew every 2^32 cells, and nothing may be seen of it.
TEST(Noise, IsItselfWhereTheUpperWordsOfItsCoordinatesChange) {
  for (const NoiseSettings& settings : allVariants({.octaves = 1, .frequency = 1.0, .deviation = 1.0}, 1.5)) {
    const Noise noise(settings);
    constexpr std::uint64_t seed = 17;
    constexpr double pitch = 1.0;
    const NoiseLattice lattice(settings.kind, 1.0, seed, 0);
    __extension__ using Wide = __int128;
    const auto crossing = [&](WideWord phase) {
      const auto distance = static_cast<std::int64_t>((std::uint64_t{12345} << 32) - cellOf(phase));
      return static_cast<std::int64_t>((static_cast<Wide>(distance) << 32) /
                                       static_cast<Wide>(lattice.straight + lattice.across));
    };
    // With simplex noise y counts as well: along the diagonal one coordinate crosses, both by turns.
    const std::int64_t x = crossing(lattice.phaseX), y = crossing(lattice.phaseY);
    const bool simplex = settings.kind == NoiseKind::simplex;
    for (const auto& [i, j] : simplex ? std::vector{std::pair{x, x}, {y, y}} : std::vector{std::pair{x, y}}) {
      const FieldRequest request{
          .i = i - 6, .j = j - 6, .seed = seed, .pitch = pitch, .spacing = 0.25, .columns = 48, .rows = 48};
      const HeightMap map = made(noise, request);
      const test::NoiseReference reference(noise, seed, pitch);
      for (int row = 0; row < 48; ++row) {
        for (int column = 0; column < 48; ++column) {
          const FieldRequest at = single(request, column, row);
          ASSERT_NEAR(map(column, row),
                      static_cast<double>(reference.height(placeOf(at.i, at.u), placeOf(at.j, at.v))), 1e-4)
              << describe(settings) << " at " << column << ", " << row;
        }
      }
      for (const NoisePath path : paths())
        EXPECT_TRUE(sameBits(made(noise, request, path).view(), map.view())) << describe(settings);
    }
  }
}

TEST(Noise, ASampleIsAFunctionOfItsPositionAlone) {
  for (const NoiseSettings& settings : allVariants({.octaves = 12, .frequency = 0.03}, 20.0)) {
    const Noise noise(settings);
    FieldRequest all{.i = (std::int64_t{1} << 51) - 2,
                     .j = -3,
                     .u = 0.25,
                     .v = 0x1.8p-20,
                     .seed = 8,
                     .spacing = 1.0,
                     .columns = 180,
                     .rows = 140};
    const HeightMap whole = made(noise, all);
    all.level = 1;
    const HeightMap coarser = made(noise, all);
    RandomSequence random(4);
    for (int n = 0; n < 20; ++n) {
      all.level = n % 2;  // above 0 with the octaves that the spacing leaves
      const int column = static_cast<int>(random.nextBits(7)), row = static_cast<int>(random.nextBits(7));
      FieldRequest part = single(all, column, row);
      part.columns = 1 + static_cast<int>(random.next() % static_cast<unsigned>(all.columns - column));
      part.rows = 1 + static_cast<int>(random.next() % static_cast<unsigned>(all.rows - row));
      if (n % 4 == 0) part.columns = part.rows = 1;
      const HeightMap& from = all.level == 0 ? whole : coarser;
      EXPECT_TRUE(sameBits(made(noise, part).view(), from.view().part(column, row, part.columns, part.rows)))
          << describe(settings) << ": " << column << ", " << row;
    }
    all.level = 0;
    FieldRequest coarse = all;
    coarse.spacing = 4.0;
    coarse.columns = coarse.rows = 30;
    const HeightMap map = made(noise, coarse);
    for (int row = 0; row < 30; ++row) {
      for (int column = 0; column < 30; ++column) ASSERT_EQ(map(column, row), whole(4 * column, 4 * row));
    }
  }
}

TEST(Noise, RectanglesMayHaveSamplesMillionsOfCellsApart) {
  for (const NoiseSettings& settings :
       allVariants({.octaves = 24, .frequency = 10.0, .lacunarity = 4.0}, 1e5)) {
    const Noise noise(settings);
    for (const double spacing : {0x1p-20, 64.0, 0x1p30}) {
      const FieldRequest request{
          .i = INT64_MAX, .j = INT64_MIN, .u = 0.5, .seed = 2, .spacing = spacing, .columns = 5, .rows = 3};
      const HeightMap map = made(noise, request);
      const HeightRange range = noise.range();
      for (float height : map.samples()) {
        ASSERT_GE(height, range.min) << describe(settings);
        ASSERT_LE(height, range.max) << describe(settings);
      }
      EXPECT_TRUE(sameBits(made(noise, request, NoisePath::plain).view(), map.view())) << describe(settings);
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 5; ++column) {
          const double pitches = column * spacing / 64.0, northern = row * spacing / 64.0;
          FieldRequest at = request;
          at.i = static_cast<std::int64_t>(static_cast<std::uint64_t>(at.i) +
                                           static_cast<std::uint64_t>(pitches + 0.5));
          at.u = 0.5 + pitches - std::floor(pitches + 0.5);
          at.j += static_cast<std::int64_t>(northern);
          at.v = northern - std::floor(northern);
          at.columns = at.rows = 1;
          if (at.i < 0) continue;  // beyond the last lattice point begins another landscape
          ASSERT_EQ(made(noise, at)(0, 0), map(column, row)) << describe(settings) << ", spacing " << spacing;
        }
      }
    }
  }
}

TEST(Noise, SlopesAreThoseOfTheField) {
  double worst = 0.0;
  for (const NoiseSettings& settings :
       allVariants({.octaves = 6, .frequency = 0.02, .deviation = 10.0}, 10.0)) {
    const Noise noise(settings);
    const test::NoiseReference reference(noise, 5, 64.0);
    RandomSequence random(6);
    int creases = 0;
    for (int n = 0; n < 60; ++n) {
      const FieldRequest at{.i = n,
                            .j = -n,
                            .u = static_cast<double>(random.next() >> 40) * 0x1p-24,
                            .v = static_cast<double>(random.next() >> 40) * 0x1p-24,
                            .seed = 5};
      const NoisePoint point = noise.pointAt(at);
      const auto height = [&](std::int64_t east, std::int64_t north) {
        return reference.height(test::sum(placeOf(at.i, at.u), test::position(0, east)),
                                test::sum(placeOf(at.j, at.v), test::position(0, north)));
      };
      constexpr std::int64_t step = 256;
      const double width = 2.0 * step * 0x1p-32 * at.pitch;
      const double east = static_cast<double>(height(step, 0) - height(-step, 0)) / width;
      const double north = static_cast<double>(height(0, step) - height(0, -step)) / width;
      const double error = std::max(std::fabs(east - point.east), std::fabs(north - point.north));
      creases += error > 1e-5;
      if (error <= 1e-5) worst = std::max(worst, error);
    }
    EXPECT_LE(creases, settings.fractal == NoiseFractal::fbm ? 0 : 1) << describe(settings);
  }
  RecordProperty("worst", std::to_string(worst));
}

TEST(Noise, DoesNotDependOnSlicing) {
  for (const NoiseSettings& settings : allVariants({.octaves = 5}, 30.0)) {
    const Noise noise(settings);
    for (const auto& [columns, rows] : {std::pair{1, 1}, {1, 40}, {129, 33}, {257, 5}}) {
      for (const int level : {0, 3}) {
        const FieldRequest request{
            .seed = 5, .spacing = 16.0, .columns = columns, .rows = rows, .level = level};
        EXPECT_TRUE(sameBits(made(noise, request, test::shortestSlice()).view(), made(noise, request).view()))
            << describe(settings);
      }
    }
  }
}

TEST(Noise, StopsAfterASmallUnitWhenTheSliceIsOver) {
  for (const NoiseSettings& settings : allVariants({.octaves = 24}, 30.0)) {
    HeightMap map(257, 257);
    const int steps = finish(*Noise(settings).begin({.seed = 1, .columns = 257, .rows = 257}, map.view()),
                             test::shortestSlice());
    EXPECT_GE(steps, 257 * 257 * 24 / 4096) << describe(settings);
  }
}

TEST(Noise, DoesNotAllocateOnceBegun) {
  for (const NoiseSettings& settings : allVariants({.octaves = 24}, 30.0)) {
    HeightMap map(200, 40);
    const auto task = Noise(settings).begin({.seed = 1, .columns = 200, .rows = 40}, map.view());
    const long before = test::allocationCount();
    finish(*task, test::shortestSlice());
    EXPECT_EQ(test::allocationCount(), before);
  }
}

/// Sums of heights and of their squares over many seeds, at each of 16 places several cells apart.
struct Statistics {
  static constexpr int kPlaces = 16;
  std::array<double, kPlaces> sums{}, squares{};
  int seeds = 0;

  void add(const HeightMap& map) {
    for (std::size_t n = 0; n < kPlaces; ++n) {
      const double height = map.samples()[n];
      sums[n] += height;
      squares[n] += height * height;
    }
    ++seeds;
  }
  double meanSquare() const {
    double sum = 0.0;
    for (double square : squares) sum += square / (seeds * kPlaces);
    return sum;
  }
};

Statistics statisticsOf(const Noise& noise, int seeds, int level) {
  Statistics statistics;
  for (int seed = 0; seed < seeds; ++seed) {
    statistics.add(made(noise, {.i = -1,
                                .seed = mixBits(static_cast<std::uint64_t>(seed)),
                                .spacing = 128.0,
                                .columns = 4,
                                .rows = 4,
                                .level = level}));
  }
  return statistics;
}

TEST(Noise, HasMeanZeroAndItsDeviationAtEveryPlace) {
  std::vector<NoiseSettings> all =
      allVariants({.octaves = 8, .frequency = 1.0 / 37.0, .deviation = 5.0}, 20.0);
  for (double hurst : {0.0, 1.0}) {
    for (const NoiseSettings& settings : allVariants(
             {.octaves = 4, .frequency = 1.0 / 37.0, .lacunarity = 3.0, .hurst = hurst, .deviation = 5.0},
             200.0)) {
      all.push_back(settings);
    }
  }
  for (const NoiseSettings& settings : all) {
    constexpr int seeds = 1000;
    const Statistics statistics = statisticsOf(Noise(settings), seeds, 0);
    EXPECT_NEAR(std::sqrt(statistics.meanSquare()), 5.0, 0.03 * 5.0) << describe(settings);
    for (std::size_t n = 0; n < Statistics::kPlaces; ++n) {
      EXPECT_LT(std::fabs(statistics.sums[n] / seeds), 4.5 * 5.0 / std::sqrt(seeds))
          << describe(settings) << ", place " << n;
      // Of 1000 seeds a deviation is off by 2 to 4 % itself.
      EXPECT_NEAR(std::sqrt(statistics.squares[n] / seeds), 5.0, 0.15 * 5.0)
          << describe(settings) << ", place " << n;
    }
  }
}

TEST(Noise, KeepsItsMeanAndTheRestOfItsVarianceWhenOctavesAreLeftOut) {
  for (const NoiseSettings& settings :
       allVariants({.octaves = 5, .frequency = 1.0 / 1024.0, .hurst = 0.3, .deviation = 1.0}, 200.0)) {
    const Noise noise(settings);
    ASSERT_EQ(noise.kept(1, 128.0), 3);
    constexpr int seeds = 3000;
    const Statistics coarse = statisticsOf(noise, seeds, 1);
    double mean = 0.0, missing = 0.0;
    for (double sum : coarse.sums) mean += sum / (seeds * Statistics::kPlaces);
    for (int seed = 0; seed < seeds; ++seed) {
      FieldRequest request{.i = -1, .seed = mixBits(static_cast<std::uint64_t>(seed)), .spacing = 128.0};
      const double fine = made(noise, request)(0, 0);
      request.level = 1;
      const double difference = fine - made(noise, request)(0, 0);
      missing += difference * difference / seeds;
    }
    // Places are 1/8 of the coarsest cell apart, so that seeds are all that is independent.
    EXPECT_LT(std::fabs(mean), 4.0 / std::sqrt(seeds)) << describe(settings);
    EXPECT_NEAR(missing, noise.plan().missingSquare(3), 0.12 * missing) << describe(settings);
    EXPECT_NEAR(coarse.meanSquare() + missing, 1.0, 0.1) << describe(settings);
  }
}

TEST(Noise, LeavesOutWhatIsFinerThanTwoSamplesACellAndNothingAtLevelZero) {
  const Noise noise({.octaves = 8, .frequency = 1.0 / 512.0});
  EXPECT_EQ(noise.kept(0, 1e9), 8);
  EXPECT_EQ(noise.kept(1, 2.0), 8);
  EXPECT_EQ(noise.kept(3, 4.0), 7);
  EXPECT_EQ(noise.kept(3, 4.1), 6);
  EXPECT_EQ(noise.kept(5, 256.0), 1);
  EXPECT_EQ(noise.kept(5, 257.0), 0);
  const FieldRequest nothing{.spacing = 512.0, .columns = 3, .rows = 3, .level = 8};
  for (const NoiseSettings& settings : allVariants({}, 10.0)) {
    const HeightMap map = made(Noise(settings), nothing);
    for (float height : map.samples()) EXPECT_EQ(height, 0.0f);
  }
}

// Second differences see the octaves around their distance only, so neither the coarsest nor the finest
// octave spoils the law between them.
TEST(Noise, RoughnessIsTheHurstExponentAskedFor) {
  for (const double hurst : {0.2, 0.5, 0.8}) {
    for (NoiseSettings settings :
         allVariants({.octaves = 20, .frequency = 1.0 / 512.0, .hurst = hurst}, 20.0)) {
      const Noise noise(settings);
      std::array<double, 4> squares{};
      for (std::uint64_t seed = 0; seed < 64; ++seed) {
        const HeightMap map =
            made(noise, {.seed = mixBits(seed), .spacing = 1.0, .columns = 257, .rows = 33});
        for (std::size_t n = 0; n < squares.size(); ++n) {
          const int distance = 2 << n;
          for (int row = 0; row < map.rows(); row += 4) {
            for (int column = distance; column + distance < map.columns(); ++column) {
              const double difference =
                  map(column - distance, row) - 2.0 * map(column, row) + map(column + distance, row);
              squares[n] += difference * difference / (map.columns() - 2 * distance);
            }
          }
        }
      }
      // Least squares through the logarithms of four points.
      double slope = 0.0;
      for (std::size_t n = 0; n < 4; ++n)
        slope += (static_cast<double>(n) - 1.5) * std::log2(squares[n]) / 5.0;
      EXPECT_NEAR(slope / 2.0, hurst, 0.05) << describe(settings);
    }
  }
}

TEST(Noise, ResidualIsWithinAFactorOfWhatIsMeasured) {
  constexpr int samples = 65, seeds = 10;
  double least = 1e9, most = 0.0;
  for (const double frequency : {1.0 / 300.0, 1.0 / 40.0, 1.0 / 9.0}) {
    for (const double hurst : {0.1, 0.9}) {
      for (const double warp : {0.1, 0.6}) {
        for (const NoiseSettings& settings :
             allVariants({.octaves = 6, .frequency = frequency, .hurst = hurst, .deviation = 1.0},
                         warp / frequency)) {
          const Noise noise(settings);
          EXPECT_EQ(noise.residual(0, samples, 1.0), 0.0);
          std::array<double, 7> squares{};
          for (std::uint64_t seed = 0; seed < seeds; ++seed) {
            FieldRequest request{
                .seed = mixBits(seed), .pitch = 32.0, .spacing = 1.0, .columns = samples, .rows = samples};
            const HeightMap finest = made(noise, request);
            for (int level = 1; level <= 5; ++level) {
              request.level = level;
              request.spacing = static_cast<double>(1 << level);
              request.columns = request.rows = ((samples - 1) >> level) + 1;
              squares[static_cast<std::size_t>(level)] +=
                  test::squaredError(finest, made(noise, request), level) / seeds;
            }
            const float centre = made(
                noise, {.i = 1, .j = 1, .seed = mixBits(seed), .pitch = 32.0, .spacing = 64.0, .level = 6})(
                0, 0);
            for (float height : finest.samples())
              squares[6] += (height - centre) * (height - centre) / (samples * samples * seeds);
          }
          for (int level = 1; level <= 6; ++level) {
            const double ratio =
                noise.residual(level, samples, 1.0) / std::sqrt(squares[static_cast<std::size_t>(level)]);
            EXPECT_GT(ratio, 1.0 / 1.5) << describe(settings) << ", level " << level;
            EXPECT_LT(ratio, 1.5) << describe(settings) << ", level " << level;
            least = std::min(least, ratio);
            most = std::max(most, ratio);
          }
        }
      }
    }
  }
  RecordProperty("least", std::to_string(least));
  RecordProperty("most", std::to_string(most));
}

/// The largest |field - triangles through every stride-th sample| of a map.
double largestError(const HeightMap& finest, int stride) {
  double largest = 0.0;
  for (int row = 0; row + 1 < finest.rows(); ++row) {
    for (int column = 0; column + 1 < finest.columns(); ++column) {
      const int x = column / stride * stride, y = row / stride * stride;
      const double u = static_cast<double>(column - x) / stride, v = static_cast<double>(row - y) / stride;
      const double corner = u >= v ? finest(x + stride, y) : finest(x, y + stride);
      const double drawn = finest(x, y) + std::max(u, v) * (corner - finest(x, y)) +
                           std::min(u, v) * (finest(x + stride, y + stride) - corner);
      largest = std::max(largest, std::fabs(finest(column, row) - drawn));
    }
  }
  return largest;
}

TEST(Noise, FieldErrorIsABoundOfWhatTrianglesMiss) {
  for (const int octaves : {1, 6}) {
    for (const NoiseSettings& settings :
         allVariants({.octaves = octaves, .frequency = 1.0 / 128.0, .deviation = 10.0}, 40.0)) {
      const Noise noise(settings);
      for (const int stride : {2, 16, 64}) {
        double largest = 0.0;
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
          largest = std::max(
              largest,
              largestError(made(noise, {.seed = seed, .spacing = 0.5, .columns = 257, .rows = 257}), stride));
        }
        const double bound = noise.fieldError(0.5 * stride);
        EXPECT_LE(largest, bound) << describe(settings) << ", stride " << stride;
        EXPECT_LT(bound, (settings.warp > 0.0 ? 60.0 : 12.0) * largest)
            << describe(settings) << ", stride " << stride;
      }
    }
  }
}

// One cell, its corners at their steepest: nothing smaller would be a bound.
TEST(Noise, FieldErrorOfOneOctaveIsNearlyReached) {
  for (const NoiseKind kind : kKinds) {
    const Noise noise({.kind = kind, .octaves = 1, .frequency = 1.0 / 64.0, .deviation = 1.0});
    double largest = 0.0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      largest = std::max(
          largest, largestError(made(noise, {.seed = seed, .spacing = 2.0, .columns = 257, .rows = 257}), 4));
    }
    EXPECT_GT(largest, 0.5 * noise.fieldError(8.0));
    EXPECT_LE(largest, noise.fieldError(8.0));
  }
}

// Triangles have no axes: noise is equally rough along all directions. Squares show a little, 6 % at a cell's
// distance.
TEST(Noise, DirectionsAreAlike) {
  // Samples straight and diagonal that are about as far, 17 / 32 of a cell and twice as much.
  for (const auto& [far, slant] : {std::pair{17, 12}, {34, 24}}) {
    for (const NoiseKind kind : kKinds) {
      const Noise noise({.kind = kind, .octaves = 1, .frequency = 1.0 / 64.0, .deviation = 1.0});
      double straight = 0.0, diagonal = 0.0;
      for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const HeightMap map = made(noise, {.seed = seed, .spacing = 2.0, .columns = 257, .rows = 257});
        for (int row = 34; row < 223; row += 8) {
          for (int column = 34; column < 223; column += 8) {
            const double east = map(column + far, row) - 2.0 * map(column, row) + map(column - far, row);
            const double northEast =
                map(column + slant, row + slant) - 2.0 * map(column, row) + map(column - slant, row - slant);
            straight += east * east;
            diagonal += northEast * northEast;
          }
        }
      }
      EXPECT_NEAR(straight / diagonal, 1.0, kind == NoiseKind::simplex ? 0.03 : 0.08) << far;
    }
  }
}

}  // namespace
}  // namespace teren
