#include "generators/noise/NoiseLattice.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/generators/noise/NoiseReference.h"

namespace teren {
namespace {

using test::Digits;

constexpr std::int64_t kFar[] = {0,
                                 -1,
                                 std::int64_t{1} << 40,
                                 -(std::int64_t{1} << 40) - 3,
                                 std::int64_t{1} << 52,
                                 1 - (std::int64_t{1} << 52),
                                 INT64_MAX,
                                 INT64_MIN};

TEST(NoiseLattice, CoordinatesAreExactHoweverFar) {
  RandomSequence random(1);
  for (const std::int64_t point : kFar) {
    for (int n = 0; n < 200; ++n) {
      const std::uint64_t parts = random.next() >> 32, factor = random.next() >> (n % 40);
      const WideWord phase = (static_cast<WideWord>(random.next()) << 64) + random.next();
      const WideWord coordinate = noisePosition(point, static_cast<double>(parts) * 0x1p-32) * factor + phase;
      const Digits exact =
          test::sum(test::product(test::position(point, static_cast<std::int64_t>(parts)), factor),
                    test::digitsOf(phase));
      EXPECT_EQ(test::digitsOf(coordinate), exact) << point << ", " << parts << ", " << factor;
      EXPECT_EQ(cellOf(coordinate), (static_cast<std::uint64_t>(exact[3]) << 32) + exact[2]);
      EXPECT_EQ(partOf(coordinate), exact[1]);
    }
  }
}

TEST(NoiseLattice, APositionIsTheSameFromWhicheverLatticePointItIsCounted) {
  for (const std::int64_t point : {std::int64_t{-7}, std::int64_t{1} << 52}) {
    const std::uint64_t step = noiseStep(0.25, 64.0);
    EXPECT_EQ(noisePosition(point, 0.5) + 256 * static_cast<WideWord>(step), noisePosition(point + 1, 0.5));
    EXPECT_EQ(noisePosition(point, 0.5) + 128 * static_cast<WideWord>(step), noisePosition(point + 1, 0.0));
  }
  EXPECT_EQ(noiseStep(0x1p20 * 3.0, 3.0), std::uint64_t{1} << 52);
  EXPECT_EQ(noiseStep(3.0 * 0x1p-32, 3.0), 1u);
}

TEST(NoiseLattice, KeepsItsFrequencyToTheLastBitItHas) {
  for (double cells : {0x1p-30, 1e-5, 0.0321, 1.0, 77.7, 1e6, kMostCells}) {
    const NoiseLattice perlin(NoiseKind::perlin, cells, 1, 0);
    EXPECT_NEAR(static_cast<double>(perlin.straight) * 0x1p-32, cells, 0x1p-33 + 1e-16 * cells);
    EXPECT_EQ(perlin.across, 0u);
    const NoiseLattice simplex(NoiseKind::simplex, cells, 1, 0);
    const double skew = (std::sqrt(3.0) - 1.0) / 2.0;
    EXPECT_NEAR(static_cast<double>(simplex.straight) * 0x1p-32, cells * (1.0 + skew),
                0x1p-32 + 2e-16 * cells);
    EXPECT_NEAR(static_cast<double>(simplex.across) * 0x1p-32, cells * skew, 0x1p-32 + 2e-16 * cells);
  }
  EXPECT_EQ(NoiseLattice(NoiseKind::perlin, 1e12, 1, 0).straight,
            NoiseLattice(NoiseKind::perlin, 1e13, 1, 0).straight);
  EXPECT_EQ(NoiseLattice(NoiseKind::perlin, 1e-20, 1, 0).straight, 1u);
}

TEST(NoiseLattice, HasItsOwnNumbersForEverySeedAndOctave) {
  std::vector<WideWord> phases;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (int octave = 0; octave < kMostNoiseOctaves + 2; ++octave) {
      const NoiseLattice lattice(NoiseKind::perlin, 1.0, seed, octave);
      phases.push_back(lattice.phaseX);
      phases.push_back(lattice.phaseY);
      EXPECT_NE(lattice.seedX, lattice.seedY);
    }
  }
  std::sort(phases.begin(), phases.end());
  EXPECT_EQ(std::adjacent_find(phases.begin(), phases.end()), phases.end());
}

TEST(AxisHash, IsThatOfTheCellWhereverTheKeysBegin) {
  for (const std::uint64_t cell : {std::uint64_t{0}, std::uint64_t{5}, std::uint64_t{0xffffffff},
                                   std::uint64_t{1} << 32, (std::uint64_t{7} << 32) + 3, ~std::uint64_t{0}}) {
    const std::uint32_t hash = axisHash(cell, axisKeysFrom(cell, 99));
    for (const std::uint64_t before : {1u, 4u, 1000u, 0x7fffffffu}) {
      EXPECT_EQ(axisHash(cell, axisKeysFrom(cell - before, 99)), hash) << cell << " from " << before;
    }
  }
  // Cells 2^32 apart have nothing in common.
  int equal = 0;
  for (std::uint64_t cell = 0; cell < 1000; ++cell) {
    const std::uint64_t far = cell + (std::uint64_t{1} << 32);
    equal += axisHash(cell, axisKeysFrom(cell, 99)) >> 24 == axisHash(far, axisKeysFrom(far, 99)) >> 24;
  }
  EXPECT_LT(equal, 20);
}

/// Chi-square of counts that should be alike, in deviations from what is expected of it.
double unevenness(const std::vector<int>& counts) {
  double total = 0.0, chi = 0.0;
  for (int count : counts) total += count;
  const double expected = total / static_cast<double>(counts.size());
  for (int count : counts) chi += (count - expected) * (count - expected) / expected;
  const double freedom = static_cast<double>(counts.size()) - 1.0;
  return (chi - freedom) / std::sqrt(2.0 * freedom);
}

// Neighbours, straight and diagonal, have independent directions: all 256 pairs are equally frequent, near
// the origin and where the upper words are not 0; so are the four corners of a cell, which share their lines.
TEST(CornerGradient, DirectionsOfNeighboursAreIndependent) {
  for (const std::uint64_t origin : {std::uint64_t{0}, std::uint64_t{1} << 52, ~std::uint64_t{0} - 100}) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      const AxisKeys keysX = axisKeysFrom(origin, mixBits(seed)),
                     keysY = axisKeysFrom(origin, mixBits(~seed));
      const auto direction = [&](int i, int j) {
        return cornerGradient(axisHash(origin + static_cast<unsigned>(i), keysX),
                              axisHash(origin + static_cast<unsigned>(j), keysY));
      };
      constexpr int side = 400;
      std::vector<int> east(256), diagonal(256), cell(65536);
      for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
          const int own = direction(i, j), right = direction(i + 1, j), up = direction(i, j + 1),
                    far = direction(i + 1, j + 1);
          ++east[static_cast<std::size_t>(16 * own + right)];
          ++diagonal[static_cast<std::size_t>(16 * own + far)];
          ++cell[static_cast<std::size_t>(16 * (16 * (16 * own + right) + up) + far)];
        }
      }
      EXPECT_LT(std::fabs(unevenness(east)), 5.0) << origin << ", seed " << seed;
      EXPECT_LT(std::fabs(unevenness(diagonal)), 5.0) << origin << ", seed " << seed;
      EXPECT_LT(std::fabs(unevenness(cell)), 5.0) << origin << ", seed " << seed;
    }
  }
}

}  // namespace
}  // namespace teren
