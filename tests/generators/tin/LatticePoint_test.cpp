#include "generators/tin/LatticePoint.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "generators/tin/LatticeFrame.h"

namespace teren {
namespace {

int signOf(WideInteger x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

/// The sum over all permutations; no differences, so an independent way to both predicates. Entries up to
/// 2^57 in the last column and 2^28 in the others keep every product below 2^114.
template <int n>
WideInteger determinant(const std::array<std::array<WideInteger, n>, n>& m) {
  if constexpr (n == 1) {
    return m[0][0];
  } else {
    WideInteger sum = 0;
    for (int column = 0; column < n; ++column) {
      std::array<std::array<WideInteger, n - 1>, n - 1> minor;
      for (int i = 1; i < n; ++i) {
        for (int j = 0, to = 0; j < n; ++j) {
          if (j != column) minor[i - 1][to++] = m[i][j];
        }
      }
      sum += (column % 2 == 0 ? 1 : -1) * m[0][column] * determinant<n - 1>(minor);
    }
    return sum;
  }
}

WideInteger plainOrientation(LatticePoint a, LatticePoint b, LatticePoint c) {
  return determinant<3>({{{1, a.x, a.y}, {1, b.x, b.y}, {1, c.x, c.y}}});
}

WideInteger plainInCircle(LatticePoint a, LatticePoint b, LatticePoint c, LatticePoint d) {
  const auto row = [](LatticePoint p) -> std::array<WideInteger, 4> {
    const WideInteger x = p.x, y = p.y;
    return {x, y, x * x + y * y, 1};
  };
  return determinant<4>({{row(a), row(b), row(c), row(d)}});
}

/// Anything from single steps to the whole box, corners and sides included.
class RandomPoints {
 public:
  explicit RandomPoints(std::uint64_t seed) : random_(seed) {}

  LatticePoint next() {
    const int bits = static_cast<int>(random_.next() % 29);
    switch (random_.next() % 4) {
      case 0:
        return {coordinate(28), coordinate(28)};
      case 1:
        return {kLatticeSide - coordinate(bits), kLatticeSide - coordinate(bits)};
      case 2:
        return {coordinate(bits), kLatticeSide - coordinate(bits)};
      default:
        return {coordinate(bits), coordinate(bits)};
    }
  }

 private:
  std::int32_t coordinate(int bits) {
    return bits == 0 ? 0 : static_cast<std::int32_t>(random_.nextBits(bits));
  }

  RandomSequence random_;
};

TEST(LatticePoint, OrientationIsTheDeterminantWhereverThePointsLie) {
  RandomPoints points(1);
  for (int n = 0; n < 200000; ++n) {
    const LatticePoint a = points.next(), b = points.next(), c = points.next();
    ASSERT_TRUE(orientation(a, b, c) == plainOrientation(a, b, c)) << "case " << n << " of seed 1";
  }
}

TEST(LatticePoint, InCircleIsTheDeterminantWhereverThePointsLie) {
  RandomPoints points(2);
  for (int n = 0; n < 200000; ++n) {
    const LatticePoint a = points.next(), b = points.next(), c = points.next(), d = points.next();
    ASSERT_TRUE(inCircleDeterminant(a, b, c, d) == plainInCircle(a, b, c, d)) << "case " << n << " of seed 2";
  }
}

TEST(LatticePoint, PredicatesDoNotOverflowAtTheCornersOfTheLargestBox) {
  constexpr std::array<std::int32_t, 4> ends{0, 1, kLatticeSide - 1, kLatticeSide};
  std::vector<LatticePoint> points;
  for (std::int32_t x : ends) {
    for (std::int32_t y : ends) points.push_back({x, y});
  }
  for (const LatticePoint a : points) {
    for (const LatticePoint b : points) {
      for (const LatticePoint c : points) {
        ASSERT_TRUE(orientation(a, b, c) == plainOrientation(a, b, c));
        for (const LatticePoint d : points) {
          ASSERT_TRUE(inCircleDeterminant(a, b, c, d) == plainInCircle(a, b, c, d));
        }
      }
    }
  }
}

TEST(LatticePoint, ACircleThroughThreeCornersTellsOneStepAtFullSize) {
  const LatticePoint a{0, 0}, b{kLatticeSide, 0}, c{kLatticeSide, kLatticeSide}, d{0, kLatticeSide};
  EXPECT_FALSE(inCircle(a, b, c, d));
  EXPECT_TRUE(inCircle(a, b, c, {1, kLatticeSide}));
  EXPECT_TRUE(inCircle(a, b, c, {0, kLatticeSide - 1}));
  EXPECT_GT(orientation(a, c, {kLatticeSide - 1, kLatticeSide}), 0);
  EXPECT_LT(orientation(a, c, {kLatticeSide, kLatticeSide - 1}), 0);
}

/// Twice the distance of a coordinate from from + part (to - from), in units of 1 / whole.
WideInteger twiceTheDistance(std::int32_t at, std::int32_t from, std::int32_t to, WideInteger part,
                             WideInteger whole) {
  const WideInteger distance = 2 * (static_cast<WideInteger>(at - from) * whole - (to - from) * part);
  return distance < 0 ? -distance : distance;
}

TEST(LatticePoint, ACrossingIsRoundedToTheNearestLatticePoint) {
  RandomPoints points(3);
  int crossings = 0;
  for (int n = 0; n < 100000; ++n) {
    const LatticePoint a = points.next(), b = points.next(), c = points.next(), d = points.next();
    if (signOf(plainOrientation(a, b, c)) * signOf(plainOrientation(a, b, d)) >= 0) continue;
    if (signOf(plainOrientation(c, d, a)) * signOf(plainOrientation(c, d, b)) >= 0) continue;
    ++crossings;
    WideInteger part = plainOrientation(c, d, a);
    WideInteger whole = part - plainOrientation(c, d, b);
    if (whole < 0) part = -part, whole = -whole;
    const LatticePoint p = roundedCrossing(a, b, c, d);
    ASSERT_TRUE(twiceTheDistance(p.x, a.x, b.x, part, whole) <= whole) << "case " << n << " of seed 3";
    ASSERT_TRUE(twiceTheDistance(p.y, a.y, b.y, part, whole) <= whole) << "case " << n << " of seed 3";
  }
  EXPECT_GT(crossings, 1000);
}

TEST(LatticeFrame, SnapsByHalfAStepAtMostAndRefusesWhatIsOutside) {
  const LatticeFrame frame{-100.0, 50.0, 1.0 / 1024, 1 << 20, 1 << 18};
  RandomSequence random(4);
  for (int n = 0; n < 10000; ++n) {
    const double x = -100.0 + 1024.0 * static_cast<double>(random.nextBits(53)) * 0x1p-53;
    const double y = 50.0 + 256.0 * static_cast<double>(random.nextBits(53)) * 0x1p-53;
    const auto p = frame.snap(x, y);
    ASSERT_TRUE(p && frame.contains(*p));
    ASSERT_LE(std::fabs(frame.placeX(*p) - x), frame.step / 2);
    ASSERT_LE(std::fabs(frame.placeY(*p) - y), frame.step / 2);
  }
  EXPECT_TRUE(frame.snap(924.0, 306.0) == (LatticePoint{1 << 20, 1 << 18}));
  EXPECT_FALSE(frame.snap(924.0 + 1e-9, 60.0));
  EXPECT_FALSE(frame.snap(0.0, 50.0 - 1e-9));
  EXPECT_FALSE(frame.snap(std::nan(""), 60.0));
  EXPECT_FALSE(frame.snap(0.0, -HUGE_VAL));
}

}  // namespace
}  // namespace teren
