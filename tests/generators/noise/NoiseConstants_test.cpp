// The constants of noise, computed again from its definition.
#include "generators/noise/NoiseConstants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace teren {
namespace {

constexpr double kPi = 3.141592653589793;

/// A corner's weight with its first and second derivatives, and the offset (x, y) from the corner.
struct Corner {
  double weight, east, north, eastEast, eastNorth, northNorth, x, y;
};

Corner perlinCorner(double x, double y, int i, int j) {
  struct Fall {
    double value, first, second;
  };
  const auto fall = [](double t, int far) -> Fall {
    const double s = far == 1 ? 1.0 - t : t, sign = far == 1 ? -1.0 : 1.0;
    return {1.0 - s * s * s * (s * (s * 6.0 - 15.0) + 10.0), -sign * 30.0 * s * s * (s - 1.0) * (s - 1.0),
            -60.0 * s * (s - 1.0) * (2.0 * s - 1.0)};
  };
  const Fall a = fall(x, i), b = fall(y, j);
  return {a.value * b.value,
          a.first * b.value,
          a.value * b.first,
          a.second * b.value,
          a.first * b.first,
          a.value * b.second,
          x - i,
          y - j};
}

Corner simplexCorner(double skewedX, double skewedY, int i, int j) {
  const double unskew = (skewedX - i + skewedY - j) * (3.0 - std::sqrt(3.0)) / 6.0;
  const double x = skewedX - i - unskew, y = skewedY - j - unskew;
  const double t = std::max(0.0, 0.5 - x * x - y * y), t2 = t * t, t3 = t2 * t;
  return {t2 * t2,
          -8.0 * t3 * x,
          -8.0 * t3 * y,
          -8.0 * t3 + 48.0 * t2 * x * x,
          48.0 * t2 * x * y,
          -8.0 * t3 + 48.0 * t2 * y * y,
          x,
          y};
}

/// The four corners of a cell, at (x, y) of it; one is nothing with simplex noise.
std::array<Corner, 4> cornersAt(NoiseKind kind, double x, double y) {
  std::array<Corner, 4> corners{};
  for (int n = 0; n < 4; ++n) {
    corners[static_cast<std::size_t>(n)] =
        kind == NoiseKind::perlin ? perlinCorner(x, y, n % 2, n / 2) : simplexCorner(x, y, n % 2, n / 2);
  }
  return corners;
}

constexpr NoiseKind kKinds[] = {NoiseKind::perlin, NoiseKind::simplex};

TEST(NoiseConstants, GradientsAreSixteenDirectionsOfOneLengthThatSumToNothing) {
  for (const NoiseKind kind : kKinds) {
    const NoiseGradients& gradients = noiseGradients(kind);
    std::vector<double> angles;
    for (int n = 0; n < 16; ++n) {
      const double east = gradients.east[n], north = gradients.north[n];
      const double length = noiseConstants(kind).gradient;
      EXPECT_NEAR(std::sqrt(east * east + north * north), length, 1e-7 * length);
      EXPECT_EQ(gradients.east[n ^ 1], -gradients.east[n]);
      EXPECT_EQ(gradients.north[n ^ 1], -gradients.north[n]);
      angles.push_back(std::atan2(north, east));
    }
    std::sort(angles.begin(), angles.end());
    for (std::size_t n = 1; n < 16; ++n) EXPECT_NEAR(angles[n] - angles[n - 1], kPi / 8.0, 1e-6);
    EXPECT_NEAR(angles[0], -kPi + kPi / 16.0, 1e-6);
  }
}

/// The largest over the cell of: the sum over the corners of `part`, at so many places and directions.
template <class Part>
double largestOverCell(NoiseKind kind, int places, int directions, const Part& part) {
  double largest = 0.0;
  for (int row = 0; row <= places; ++row) {
    for (int column = 0; column <= places; ++column) {
      const auto corners =
          cornersAt(kind, static_cast<double>(column) / places, static_cast<double>(row) / places);
      for (int n = 0; n < directions; ++n) {
        const double c = std::cos(kPi * n / directions), s = std::sin(kPi * n / directions);
        double sum = 0.0;
        for (const Corner& corner : corners) sum += part(corner, c, s);
        largest = std::max(largest, sum);
      }
    }
  }
  return largest;
}

// A gradient of length 1 may point wherever that makes the most of its corner.
TEST(NoiseConstants, NoiseReachesOneAndNeverMore) {
  for (const NoiseKind kind : kKinds) {
    const double largest = largestOverCell(kind, 400, 1, [](const Corner& corner, double, double) {
      return corner.weight * std::sqrt(corner.x * corner.x + corner.y * corner.y);
    });
    EXPECT_NEAR(largest * noiseConstants(kind).gradient, 1.0, 1e-9);
  }
}

TEST(NoiseConstants, SlopeAndCurvatureAreBoundsAndNotLooseOnes) {
  for (const NoiseKind kind : kKinds) {
    const NoiseConstants& noise = noiseConstants(kind);
    const double slope = largestOverCell(kind, 130, 32, [](const Corner& k, double c, double s) {
      const double along = k.east * c + k.north * s;
      return std::hypot(k.weight * c + k.x * along, k.weight * s + k.y * along);
    });
    EXPECT_LE(slope * noise.gradient, noise.slope);
    EXPECT_GE(slope * noise.gradient, 0.985 * noise.slope);
    const double curvature = largestOverCell(kind, 130, 32, [](const Corner& k, double c, double s) {
      const double along = k.east * c + k.north * s;
      const double bend = k.eastEast * c * c + 2.0 * k.eastNorth * c * s + k.northNorth * s * s;
      return std::hypot(2.0 * c * along + k.x * bend, 2.0 * s * along + k.y * bend);
    });
    EXPECT_LE(curvature * noise.gradient, noise.curvature);
    EXPECT_GE(curvature * noise.gradient, 0.985 * noise.curvature);
  }
}

/// E |n|^1 ... E |n|^4 over places of the cell and all choices of gradients; of a pair of opposite choices
/// one is enough.
std::array<double, 5> momentsOf(NoiseKind kind, int places) {
  std::array<double, 5> moments{};
  const NoiseGradients& gradients = noiseGradients(kind);
  for (int place = 0; place < places * places; ++place) {
    const auto corners = cornersAt(kind, (place % places + 0.5) / places,
                                   (static_cast<double>(place / places) + 0.5) / places);
    double parts[4][16];
    for (std::size_t n = 0; n < 4; ++n) {
      for (int g = 0; g < 16; ++g) {
        parts[n][g] =
            corners[n].weight * (gradients.east[g] * corners[n].x + gradients.north[g] * corners[n].y);
      }
    }
    // With simplex noise the north-west or the south-east corner counts nothing, so its directions are alike.
    double sums[5] = {};
    for (int a = 0; a < 16; a += 2) {
      for (double b : parts[1]) {
        for (double c : parts[2]) {
          for (double d : parts[3]) {
            const double size = std::fabs(parts[0][a] + b + c + d), square = size * size;
            sums[1] += size;
            sums[2] += square;
            sums[3] += square * size;
            sums[4] += square * square;
          }
        }
      }
    }
    for (std::size_t n = 1; n < 5; ++n) moments[n] += sums[n] / (32768.0 * places * places);
  }
  return moments;
}

TEST(NoiseConstants, MomentsAreThoseOfAllGradientsAtAllPlacesOfACell) {
  for (const NoiseKind kind : kKinds) {
    const NoiseConstants& noise = noiseConstants(kind);
    const auto moments = momentsOf(kind, 40);
    EXPECT_NEAR(moments[1], noise.size, 2e-4 * noise.size);
    EXPECT_NEAR(moments[2], noise.variance, 2e-4 * noise.variance);
    EXPECT_NEAR(moments[3], noise.sizeCubed, 2e-4 * noise.sizeCubed);
    EXPECT_NEAR(moments[4], noise.fourthMoment, 2e-4 * noise.fourthMoment);
  }
}

// Gradients are independent with covariance 1/2, so squares over the cell are all there is to add up.
TEST(NoiseConstants, VarianceAndSteepnessAreTheirIntegralsOverTheCell) {
  for (const NoiseKind kind : kKinds) {
    const NoiseConstants& noise = noiseConstants(kind);
    constexpr int places = 200;
    double variance = 0.0, slopes = 0.0;
    for (int place = 0; place < places * places; ++place) {
      for (const Corner& k : cornersAt(kind, (place % places + 0.5) / places,
                                       (static_cast<double>(place / places) + 0.5) / places)) {
        variance += k.weight * k.weight * (k.x * k.x + k.y * k.y) / 2.0;
        const double eastEast = k.weight + k.x * k.east, eastNorth = k.y * k.east;
        const double northEast = k.x * k.north, northNorth = k.weight + k.y * k.north;
        slopes +=
            (eastEast * eastEast + eastNorth * eastNorth + northEast * northEast + northNorth * northNorth) /
            4.0;
      }
    }
    const double scale = noise.gradient * noise.gradient / (places * places);
    EXPECT_NEAR(variance * scale, noise.variance, 1e-5 * noise.variance);
    EXPECT_NEAR(std::sqrt(slopes / variance), noise.steepness, 1e-5 * noise.steepness);
  }
}

}  // namespace
}  // namespace teren
