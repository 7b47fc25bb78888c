#include "teren/HeightSampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"
#include "teren/HeightMapOperations.h"

#include "height/Surface.h"
#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

using Real = long double;
using SampleHeight = double (*)(ConstHeightView, double, double) noexcept;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double uniform(RandomSequence& random) {
  return std::ldexp(static_cast<double>(random.nextBits(53)), -53);
}

HeightMap randomMap(std::uint64_t seed, int columns, int rows, double base = 0.0, double amplitude = 1000.0) {
  RandomSequence random(seed);
  HeightMap map(columns, rows);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      map(x, y) = static_cast<float>(base + amplitude * (2.0 * uniform(random) - 1.0));
    }
  }
  return map;
}

// ---- The same in long double, written as the definitions are ----

struct Place {
  int sample = 0;
  Real fraction = 0.0L;
};
Place placeIn(Real s, int samples) {
  const int sample = std::min(static_cast<int>(std::floor(s)), std::max(samples - 2, 0));
  return {sample, s - sample};
}
Real heightOf(ConstHeightView map, int x, int y) {
  return map(std::min(x, map.columns() - 1), std::min(y, map.rows() - 1));
}

Real exactTriangle(ConstHeightView map, Real x, Real y) {
  const Place px = placeIn(x, map.columns()), py = placeIn(y, map.rows());
  const Real sw = heightOf(map, px.sample, py.sample), ne = heightOf(map, px.sample + 1, py.sample + 1);
  const Real corner = px.fraction >= py.fraction ? heightOf(map, px.sample + 1, py.sample)
                                                 : heightOf(map, px.sample, py.sample + 1);
  const Real high = std::max(px.fraction, py.fraction), low = std::min(px.fraction, py.fraction);
  return (1.0L - high) * sw + (high - low) * corner + low * ne;
}

Real exactBilinear(ConstHeightView map, Real x, Real y) {
  const Place px = placeIn(x, map.columns()), py = placeIn(y, map.rows());
  Real sum = 0.0L;
  for (int dy = 0; dy < 2; ++dy) {
    for (int dx = 0; dx < 2; ++dx) {
      const Real weight =
          (dx == 1 ? px.fraction : 1.0L - px.fraction) * (dy == 1 ? py.fraction : 1.0L - py.fraction);
      sum += weight * heightOf(map, px.sample + dx, py.sample + dy);
    }
  }
  return sum;
}

/// Catmull-Rom as a Hermite cubic: slopes of central differences, continued linearly beyond the rims.
Real hermite(const std::function<Real(int)>& row, Real s, int samples) {
  if (samples == 1) return row(0);
  const auto at = [&](int k) {
    if (k < 0) return 2.0L * row(0) - row(1);
    if (k >= samples) return 2.0L * row(samples - 1) - row(samples - 2);
    return row(k);
  };
  const Place place = placeIn(s, samples);
  const int k = place.sample;
  const Real t = place.fraction, m0 = (at(k + 1) - at(k - 1)) / 2.0L, m1 = (at(k + 2) - at(k)) / 2.0L;
  return (2.0L * t * t * t - 3.0L * t * t + 1.0L) * at(k) + (t * t * t - 2.0L * t * t + t) * m0 +
         (3.0L * t * t - 2.0L * t * t * t) * at(k + 1) + (t * t * t - t * t) * m1;
}
Real exactBicubic(ConstHeightView map, Real x, Real y) {
  const auto along = [&](int row) {
    return hermite([&](int column) { return static_cast<Real>(map(column, row)); }, x, map.columns());
  };
  return hermite(along, y, map.rows());
}

struct Kind {
  const char* name;
  Interpolation interpolation;
  SampleHeight sample;
  Real (*exact)(ConstHeightView, Real, Real);
  int reach;  // samples away from which a height no longer matters
};
constexpr std::array kKinds = {
    Kind{"triangles", Interpolation::triangles, triangleHeight, exactTriangle, 1},
    Kind{"bilinear", Interpolation::bilinear, bilinearHeight, exactBilinear, 1},
    Kind{"bicubic", Interpolation::bicubic, bicubicHeight, exactBicubic, 2},
};

constexpr std::array<std::array<int, 2>, 8> kSides = {
    {{1, 1}, {1, 6}, {6, 1}, {2, 2}, {2, 9}, {3, 3}, {7, 5}, {65, 33}}};

TEST(HeightSampling, StaysWithinTheNamedErrorOfLongDoubleRimsIncluded) {
  constexpr std::uint64_t kSeed = 61;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  for (const Kind& kind : kKinds) {
    for (const auto& [columns, rows] : kSides) {
      const HeightMap map = randomMap(random.next(), columns, rows, 300.0);
      const HeightStatistics range = statistics(map.view());
      const double largest = std::max(std::fabs(range.min), std::fabs(range.max));
      for (int trial = 0; trial < 2000; ++trial) {
        const double x = uniform(random) * (columns - 1), y = uniform(random) * (rows - 1);
        const auto error = static_cast<double>(kind.sample(map.view(), x, y) - kind.exact(map.view(), x, y));
        ASSERT_LE(std::fabs(error), kSamplingError * largest)
            << kind.name << " of " << columns << " x " << rows << " at " << x << ", " << y;
      }
    }
  }
}

TEST(HeightSampling, GivesTheSamplesTheirExactBits) {
  for (const Kind& kind : kKinds) {
    for (const auto& [columns, rows] : kSides) {
      HeightMap map = randomMap(62, columns, rows);
      for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
          if ((x + y) % 3 == 0) map(x, y) *= 1e-30F;  // beside much larger ones
        }
      }
      for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
          ASSERT_EQ(kind.sample(map.view(), x, y), map(x, y)) << kind.name << " at " << x << ", " << y;
        }
      }
    }
  }
}

TEST(HeightSampling, TakesPlacesOutsideToTheRim) {
  constexpr std::uint64_t kSeed = 63;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const HeightMap map = randomMap(kSeed, 7, 5);
  for (const Kind& kind : kKinds) {
    for (int trial = 0; trial < 200; ++trial) {
      const double along = 4.0 * uniform(random), far = 1e3 * uniform(random);
      ASSERT_EQ(kind.sample(map.view(), -far, along), kind.sample(map.view(), 0.0, along)) << kind.name;
      ASSERT_EQ(kind.sample(map.view(), 6.0 + far, along), kind.sample(map.view(), 6.0, along)) << kind.name;
      ASSERT_EQ(kind.sample(map.view(), along, -far), kind.sample(map.view(), along, 0.0)) << kind.name;
      ASSERT_EQ(kind.sample(map.view(), along, 4.0 + far), kind.sample(map.view(), along, 4.0)) << kind.name;
    }
    EXPECT_EQ(kind.sample(map.view(), -kInfinity, kInfinity), map(0, 4));
    EXPECT_EQ(kind.sample(map.view(), 1e300, -1e300), map(6, 0));
  }
}

TEST(HeightSampling, IsNaNForPlacesThatAreNaNAndWithoutHeights) {
  const HeightMap map = randomMap(64, 7, 5);
  for (const Kind& kind : kKinds) {
    EXPECT_TRUE(std::isnan(kind.sample(map.view(), kNaN, 1.0))) << kind.name;
    EXPECT_TRUE(std::isnan(kind.sample(map.view(), 1.0, kNaN))) << kind.name;
    EXPECT_TRUE(std::isnan(kind.sample(ConstHeightView(), 0.0, 0.0))) << kind.name;
    EXPECT_TRUE(std::isnan(kind.sample(HeightMap(0, 4).view(), 0.0, 0.0))) << kind.name;
  }
}

TEST(HeightSampling, IsSpoiltByAHeightThatIsNotFiniteOnlyNearIt) {
  HeightMap map = randomMap(65, 12, 12);
  map(6, 6) = kNaN;
  for (const Kind& kind : kKinds) {
    for (double y = 0.0; y <= 11.0; y += 0.125) {
      for (double x = 0.0; x <= 11.0; x += 0.125) {
        const bool near = std::fabs(x - 6.0) <= kind.reach && std::fabs(y - 6.0) <= kind.reach;
        const double height = kind.sample(map.view(), x, y);
        if (!near) {
          ASSERT_TRUE(std::isfinite(height)) << kind.name << " at " << x << ", " << y;
        }
      }
    }
    EXPECT_TRUE(std::isnan(kind.sample(map.view(), 6.0, 6.0))) << kind.name;
  }
}

TEST(HeightSampling, StaysBetweenTheHeightsAroundOrOvershootsAsFarAsNamed) {
  constexpr std::uint64_t kSeed = 66;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  double beyond = 0.0;
  for (int trial = 0; trial < 300; ++trial) {
    HeightMap map(6, 6);  // steps: the worst for a cubic
    for (int y = 0; y < 6; ++y) {
      for (int x = 0; x < 6; ++x) map(x, y) = random.nextBits(1) == 0 ? 0.0F : 1.0F;
    }
    if (trial == 0) {  // the worst of all
      for (int y = 0; y < 6; ++y) {
        for (int x = 0; x < 6; ++x) map(x, y) = (x == 2 || x == 3) == (y == 2 || y == 3) ? 1.0F : 0.0F;
      }
    }
    for (double y = 0.0; y <= 5.0; y += 0.25) {
      for (double x = 0.0; x <= 5.0; x += 0.25) {
        for (const SampleHeight sample : {triangleHeight, bilinearHeight}) {
          ASSERT_GE(sample(map.view(), x, y), 0.0);
          ASSERT_LE(sample(map.view(), x, y), 1.0);
        }
        const double cubic = bicubicHeight(map.view(), x, y);
        beyond = std::max({beyond, -cubic, cubic - 1.0});
      }
    }
  }
  EXPECT_LE(beyond, 9.0 / 32.0 + 1e-12);
  EXPECT_GE(beyond, 9.0 / 32.0 - 1e-12) << "the named overshoot is not sharp";
}

TEST(HeightSampling, OfTrianglesHasOneEdgeBetweenNeighbouringSquares) {
  constexpr std::uint64_t kSeed = 24;
  RecordProperty("seed", static_cast<int>(kSeed));
  const HeightMap map = randomMap(kSeed, 9, 9);
  RandomSequence random(kSeed);
  for (int trial = 0; trial < 2000; ++trial) {
    const int line = 1 + static_cast<int>(random.nextBits(20) % 7);
    const double along = 8.0 * uniform(random);
    const int first = std::min(static_cast<int>(along), 7);
    const auto at = [&](int x, int y) { return static_cast<double>(map(x, y)); };
    const double across = at(line, first) + (along - first) * (at(line, first + 1) - at(line, first));
    ASSERT_NEAR(triangleHeight(map.view(), line, along), across, 1e-9);
    ASSERT_NEAR(triangleHeight(map.view(), std::nextafter(line, 0.0), along), across, 1e-9);
    const double up = at(first, line) + (along - first) * (at(first + 1, line) - at(first, line));
    ASSERT_NEAR(triangleHeight(map.view(), along, line), up, 1e-9);
    ASSERT_NEAR(triangleHeight(map.view(), along, std::nextafter(line, 0.0)), up, 1e-9);
  }
}

// ---- Resampling ----

TEST(HeightSampling, ResamplesToWhatIsSampledAtTheNewPlaces) {
  const int sides[][4] = {{7, 5, 13, 9}, {9, 9, 4, 6}, {65, 33, 100, 7}, {5, 5, 1, 1}, {6, 4, 1, 3},
                          {1, 7, 3, 3},  {1, 1, 4, 2}, {8, 8, 8, 8},     {3, 3, 2, 2}};
  for (const Kind& kind : kKinds) {
    for (const auto& [columns, rows, newColumns, newRows] : sides) {
      const HeightMap map = randomMap(67, columns, rows);
      HeightMap whole = randomMap(68, newColumns + 2, newRows + 2);
      const HeightMap before = whole;
      resample(map.view(), whole.view().part(1, 1, newColumns, newRows), kind.interpolation);
      for (int y = 0; y < newRows + 2; ++y) {
        for (int x = 0; x < newColumns + 2; ++x) {
          if (x == 0 || y == 0 || x > newColumns || y > newRows) {
            ASSERT_EQ(whole(x, y), before(x, y)) << "outside the target";
            continue;
          }
          const double px =
              newColumns == 1 ? (columns - 1) / 2.0 : (x - 1.0) * (columns - 1) / (newColumns - 1);
          const double py = newRows == 1 ? (rows - 1) / 2.0 : (y - 1.0) * (rows - 1) / (newRows - 1);
          ASSERT_EQ(whole(x, y), static_cast<float>(kind.sample(map.view(), px, py)))
              << kind.name << " from " << columns << " x " << rows << ", sample " << x - 1 << ", " << y - 1;
        }
      }
    }
  }
}

TEST(HeightSampling, ResamplesToCoarserLevelsAsGeneratorsDo) {
  const HeightMap finest = randomMap(69, 65, 65);
  for (const Kind& kind : kKinds) {
    for (int level = 0; level <= 5; ++level) {
      const HeightMap expected = test::subsampled(finest, level);
      HeightMap coarse(expected.columns(), expected.rows());
      resample(finest.view(), coarse.view(), kind.interpolation);
      EXPECT_TRUE(test::sameBits(coarse.view(), expected.view())) << kind.name << ", level " << level;
    }
    HeightMap centre(1, 1);
    resample(finest.view(), centre.view(), kind.interpolation);
    EXPECT_EQ(centre(0, 0), finest(32, 32));
  }
}

TEST(HeightSampling, ResamplesNothingToNaNAndToNothing) {
  for (const Kind& kind : kKinds) {
    HeightMap target(3, 2);
    resample(ConstHeightView(), target.view(), kind.interpolation);
    for (const float height : target.samples()) EXPECT_TRUE(std::isnan(height));
    resample(target.view(), HeightMap(0, 3).view(), kind.interpolation);
  }
}

#ifndef NDEBUG
TEST(HeightSamplingDeathTest, RefusesToResampleAMapOntoItself) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  HeightMap map = randomMap(70, 9, 9);
  EXPECT_DEATH(resample(map.view().part(0, 0, 5, 5), map.view().part(4, 4, 3, 3), Interpolation::bicubic),
               "overlapping");
}
#endif

// ---- Normals ----

std::array<Real, 3> exactNormal(ConstHeightView map, int x, int y, Real spacing) {
  const auto slope = [&](int dx, int dy) -> Real {
    const auto inside = [&](int px, int py) {
      return px >= 0 && py >= 0 && px < map.columns() && py < map.rows();
    };
    const int ahead = inside(x + dx, y + dy) ? 1 : 0, behind = inside(x - dx, y - dy) ? 1 : 0;
    if (ahead + behind == 0) return 0.0L;
    return (static_cast<Real>(map(x + ahead * dx, y + ahead * dy)) - map(x - behind * dx, y - behind * dy)) /
           ((ahead + behind) * spacing);
  };
  const Real sx = slope(1, 0), sy = slope(0, 1), length = std::sqrt(sx * sx + sy * sy + 1.0L);
  return {-sx / length, -sy / length, 1.0L / length};
}

TEST(HeightSampling, HasNormalsOfCentralDifferencesOneSidedOnTheRim) {
  for (const double spacing : {1e-3, 2.0, 4096.0}) {
    for (const auto& [columns, rows] : kSides) {
      const HeightMap map = randomMap(71, columns, rows);
      for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
          const std::array<double, 3> normal = normalAt(map.view(), x, y, spacing);
          const std::array<Real, 3> exact = exactNormal(map.view(), x, y, spacing);
          for (std::size_t axis = 0; axis < 3; ++axis) {
            ASSERT_LE(std::fabs(normal[axis] - exact[axis]), kNormalError)
                << columns << " x " << rows << " at " << x << ", " << y << ", axis " << axis;
          }
        }
      }
    }
  }
}

TEST(HeightSampling, HasTheNormalsThatMeshesAreDrawnWith) {
  const HeightMap map = randomMap(72, 33, 33, 0.0, 20.0);
  for (int y = 1; y < 32; ++y) {
    for (int x = 1; x < 32; ++x) {
      const PackedNormal drawn =
          vertexNormal(map(x - 1, y), map(x + 1, y), map(x, y - 1), map(x, y + 1), 2.0);
      const std::array<double, 3> normal = normalAt(map.view(), x, y, 2.0);
      ASSERT_LE(std::fabs(drawn.x - 32767.0 * normal[0]), 0.5 + 1e-9);
      ASSERT_LE(std::fabs(drawn.y - 32767.0 * normal[1]), 0.5 + 1e-9);
    }
  }
}

TEST(HeightSampling, HasNoNormalBesideANaN) {
  HeightMap map = randomMap(73, 5, 5);
  map(2, 2) = kNaN;
  EXPECT_TRUE(std::isnan(normalAt(map.view(), 1, 2, 1.0)[2]));
  EXPECT_TRUE(std::isnan(normalAt(map.view(), 2, 3, 1.0)[2]));
  EXPECT_TRUE(std::isfinite(normalAt(map.view(), 1, 1, 1.0)[2]));
  EXPECT_TRUE(std::isfinite(normalAt(map.view(), 2, 2, 1.0)[2])) << "its own height does not matter";
}

}  // namespace
}  // namespace teren
