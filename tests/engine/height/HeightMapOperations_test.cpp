#include "teren/HeightMapOperations.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "height/Overlap.h"
#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

HeightMap randomMap(std::uint64_t seed, int columns, int rows, double base, double amplitude) {
  RandomSequence random(seed);
  HeightMap map(columns, rows);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      map(x, y) = static_cast<float>(
          base + amplitude * (std::ldexp(static_cast<double>(random.nextBits(53)), -52) - 1.0));
    }
  }
  return map;
}

struct Exact {
  long double min = 0.0L, max = 0.0L, mean = 0.0L, deviation = 0.0L, largest = 0.0L;
};
Exact exactStatistics(ConstHeightView heights) {
  Exact exact{heights(0, 0), heights(0, 0)};
  const long double count = static_cast<long double>(heights.columns()) * heights.rows();
  for (int y = 0; y < heights.rows(); ++y) {
    for (int x = 0; x < heights.columns(); ++x) {
      const long double height = heights(x, y);
      exact.min = std::min(exact.min, height);
      exact.max = std::max(exact.max, height);
      exact.mean += height / count;
      exact.largest = std::max(exact.largest, std::fabs(height));
    }
  }
  for (int y = 0; y < heights.rows(); ++y) {
    for (int x = 0; x < heights.columns(); ++x) {
      exact.deviation += (heights(x, y) - exact.mean) * (heights(x, y) - exact.mean) / count;
    }
  }
  exact.deviation = std::sqrt(exact.deviation);
  return exact;
}

TEST(HeightMapOperations, StatisticsAgreeWithLongDouble) {
  struct Case {
    int columns, rows;
    double base, amplitude;
  };
  constexpr Case kCases[] = {{1, 1, 7.0, 3.0},        {1, 500, 0.0, 100.0},     {500, 1, -20.0, 1.0},
                             {1025, 513, 0.0, 500.0}, {257, 129, 8000.0, 0.01}, {65, 65, 1e30, 1e29}};
  std::uint64_t seed = 31;
  for (const Case& c : kCases) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << c.columns << " x " << c.rows);
    const HeightMap map = randomMap(seed++, c.columns, c.rows, c.base, c.amplitude);
    const HeightStatistics found = statistics(map.view());
    const Exact exact = exactStatistics(map.view());
    EXPECT_EQ(found.min, static_cast<double>(exact.min));
    EXPECT_EQ(found.max, static_cast<double>(exact.max));
    EXPECT_NEAR(found.mean, static_cast<double>(exact.mean),
                static_cast<double>(kStatisticsError * exact.largest));
    EXPECT_NEAR(found.deviation, static_cast<double>(exact.deviation),
                static_cast<double>(kStatisticsError * exact.largest));
  }
}

TEST(HeightMapOperations, StatisticsOfNothingAreZeroAndOfOneHeightHaveNoDeviation) {
  const HeightStatistics nothing = statistics(HeightMap(0, 5).view());
  EXPECT_EQ(nothing.min, 0.0);
  EXPECT_EQ(nothing.max, 0.0);
  EXPECT_EQ(nothing.mean, 0.0);
  EXPECT_EQ(nothing.deviation, 0.0);
  HeightMap flat(33, 33);
  fillHeights(flat.view(), 0.1F);
  const HeightStatistics one = statistics(flat.view());
  EXPECT_EQ(one.mean, static_cast<double>(0.1F));
  EXPECT_EQ(one.deviation, 0.0);
}

TEST(HeightMapOperations, StatisticsOfAPartSeeNothingAroundIt) {
  HeightMap map = randomMap(32, 20, 20, 0.0, 1.0);
  for (int k = 0; k < 20; ++k) map(k, 0) = map(0, k) = map(k, 19) = map(19, k) = 1e6F;
  const HeightStatistics inner = statistics(std::as_const(map).view().part(1, 1, 18, 18));
  EXPECT_LE(inner.max, 1.0);
  EXPECT_GE(inner.min, -1.0);
}

TEST(HeightMapOperations, StatisticsOfAMapWithNaNAreNaNAndInfinityStandsInMinOrMax) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(),
                  kInfinity = std::numeric_limits<float>::infinity();
  for (const int place : {0, 5, 11}) {
    HeightMap map = randomMap(34, 4, 3, 0.0, 1.0);
    map(place % 4, place / 4) = kNaN;
    const HeightStatistics broken = statistics(map.view());
    for (const double figure : {broken.min, broken.max, broken.mean, broken.deviation}) {
      EXPECT_TRUE(std::isnan(figure)) << place;
    }
    map(place % 4, place / 4) = kInfinity;
    const HeightStatistics endless = statistics(map.view());
    EXPECT_EQ(endless.max, kInfinity);
    EXPECT_LE(endless.min, 1.0);
    EXPECT_FALSE(std::isfinite(endless.mean));
    EXPECT_FALSE(std::isfinite(endless.deviation));
  }
}

// ---- Arithmetic between two rectangles ----

struct Operation {
  const char* name;
  std::function<void(ConstHeightView, HeightView)> apply;
  /// The exact result, and the sum of what its terms weigh.
  std::function<long double(long double to, long double from)> exact, size;
};

std::vector<Operation> operations() {
  using Real = long double;
  const auto sum = [](Real a, Real b) { return std::fabs(a) + std::fabs(b); };
  const auto none = [](Real, Real) { return 0.0L; };
  std::vector<Operation> all = {
      {"copy", copyHeights, [](Real, Real b) { return b; }, none},
      {"add", addHeights, [](Real a, Real b) { return a + b; }, sum},
      {"subtract", subtractHeights, [](Real a, Real b) { return a - b; }, sum},
      {"multiply", multiplyHeights, [](Real a, Real b) { return a * b; },
       [](Real a, Real b) { return std::fabs(a * b); }},
      {"min", minHeights, [](Real a, Real b) { return std::min(a, b); }, none},
      {"max", maxHeights, [](Real a, Real b) { return std::max(a, b); }, none},
  };
  for (const double t : {0.0, 0.3, 0.5, 1.0, -0.7, 1.9}) {
    all.push_back({"lerp", [t](ConstHeightView from, HeightView to) { lerpHeights(from, t, to); },
                   [t](Real a, Real b) { return (1.0L - t) * a + t * b; },
                   [t](Real a, Real b) { return std::fabs((1.0L - t) * a) + std::fabs(t * b); }});
  }
  for (const double weight : {2.0, -1.0 / 3.0}) {
    all.push_back({"weighted sum",
                   [weight](ConstHeightView from, HeightView to) {
                     const WeightedHeights terms[] = {{to, 0.1}, {from, weight}};
                     weightedSum(terms, to);
                   },
                   [weight](Real a, Real b) { return 0.1 * a + weight * b; },
                   [weight](Real a, Real b) { return std::fabs(0.1 * a) + std::fabs(weight * b); }});
  }
  return all;
}

TEST(HeightMapOperations, StayWithinTheNamedErrorOfLongDoubleAndChangeNothingElse) {
  struct Sizes {
    double base, amplitude;
  };
  for (const Sizes& sizes : {Sizes{0.0, 500.0}, Sizes{8000.0, 1e-3}, Sizes{0.0, 1e18}, Sizes{0.0, 1e-39}}) {
    const HeightMap source = randomMap(35, 12, 10, sizes.base, sizes.amplitude);
    const HeightMap before = randomMap(36, 9, 9, sizes.base / 2.0, sizes.amplitude);
    for (const Operation& operation : operations()) {
      SCOPED_TRACE(testing::Message() << operation.name << " of heights about " << sizes.amplitude);
      HeightMap target = before;
      operation.apply(source.view().part(3, 2, 4, 5), target.view().part(1, 4, 4, 5));
      for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < 9; ++x) {
          const bool inside = x >= 1 && x < 5 && y >= 4;
          if (!inside) {
            ASSERT_EQ(target(x, y), before(x, y)) << x << ", " << y;
            continue;
          }
          const long double to = before(x, y), from = source(x + 2, y - 2);
          const long double exact = operation.exact(to, from), size = operation.size(to, from);
          const long double bound =
              size == 0.0L ? 0.0L
                           : kHeightRounding * std::fabs(exact) + kTermRounding * size + kSmallestHeight;
          ASSERT_LE(std::fabs(target(x, y) - exact), bound) << x << ", " << y;
        }
      }
    }
  }
}

TEST(HeightMapOperations, BetweenOverlappingPartsOfOneMapReadTheSourceAsItWas) {
  for (const Operation& operation : operations()) {
    if (std::string(operation.name) == "weighted sum") continue;  // refuses it: see the next test
    for (int dy = -3; dy <= 3; ++dy) {
      for (int dx = -3; dx <= 3; ++dx) {
        HeightMap map = randomMap(37, 14, 13, 0.0, 10.0);
        HeightMap apart = map;
        const HeightMap source = map;
        operation.apply(map.view().part(3 + dx, 3 + dy, 8, 7), map.view().part(3, 3, 8, 7));
        operation.apply(source.view().part(3 + dx, 3 + dy, 8, 7), apart.view().part(3, 3, 8, 7));
        ASSERT_TRUE(test::sameBits(map.view(), apart.view())) << operation.name << ", " << dx << ", " << dy;
      }
    }
  }
}

TEST(HeightMapOperations, KnowWhichPartsOfAMapOverlap) {
  HeightMap map(40, 30);
  RandomSequence random(38);
  const auto part = [&] {
    const int x = static_cast<int>(random.next() % 30), y = static_cast<int>(random.next() % 20);
    return HeightRectangle{x, y, static_cast<int>(random.next() % 10), static_cast<int>(random.next() % 10)};
  };
  int meeting = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    const HeightRectangle a = part(), b = part();
    const bool meet = a.columns > 0 && a.rows > 0 && b.columns > 0 && b.rows > 0 &&
                      a.column < b.column + b.columns && b.column < a.column + a.columns &&
                      a.row < b.row + b.rows && b.row < a.row + a.rows;
    meeting += meet ? 1 : 0;
    ASSERT_EQ(overlapping(map.view().part(a.column, a.row, a.columns, a.rows),
                          map.view().part(b.column, b.row, b.columns, b.rows)),
              meet)
        << a.column << " " << a.row << " " << a.columns << " " << a.rows << ", " << b.column << " " << b.row
        << " " << b.columns << " " << b.rows;
  }
  EXPECT_GT(meeting, 1000);
}

#ifndef NDEBUG
TEST(HeightMapOperationsDeathTest, RefuseOtherSizesAndTermsThatWouldBeReadAfterTheyAreWritten) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  HeightMap map = randomMap(39, 9, 9, 0.0, 1.0);
  EXPECT_DEATH(addHeights(map.view().part(0, 0, 3, 4), map.view().part(4, 4, 4, 3)), "columns");
  const WeightedHeights shifted[] = {{map.view().part(1, 1, 5, 5), 1.0}};
  EXPECT_DEATH(weightedSum(shifted, map.view().part(2, 1, 5, 5)), "overlapping");
  const HeightView everySecondRow(map.view().data(), 5, 4, 18);
  EXPECT_DEATH(addHeights(map.view().part(0, 0, 5, 4), everySecondRow), "overlapping");
}
#endif

TEST(HeightMapOperations, GiveNaNWhereAnOperandIsNaNAndOnlyThere) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  for (const Operation& operation : operations()) {
    HeightMap source = randomMap(40, 6, 1, 0.0, 1.0), target = randomMap(41, 6, 1, 0.0, 1.0);
    source(1, 0) = source(2, 0) = target(2, 0) = target(3, 0) = kNaN;
    operation.apply(source.view(), target.view());
    for (int x = 0; x < 6; ++x) {
      const bool overwritten = x == 3 && std::string(operation.name) == "copy";
      EXPECT_EQ(std::isnan(target(x, 0)), x >= 1 && x <= 3 && !overwritten) << operation.name << ", " << x;
    }
  }
}

TEST(HeightMapOperations, OfALerpAreExactAtBothEndsAndOfEqualMapsAndBetweenThem) {
  const HeightMap low = randomMap(42, 30, 30, 0.0, 1e-10), high = randomMap(43, 30, 30, 0.0, 1e10);
  HeightMap map = high;
  lerpHeights(low.view(), 0.0, map.view());
  EXPECT_TRUE(test::sameBits(map.view(), high.view()));
  lerpHeights(low.view(), 1.0, map.view());
  EXPECT_TRUE(test::sameBits(map.view(), low.view()));
  for (const double t : {0.1, 1.0 / 3.0, 0.7, 0.999}) {
    map = high;
    lerpHeights(high.view(), t, map.view());
    EXPECT_TRUE(test::sameBits(map.view(), high.view())) << t;
    const HeightMap other = randomMap(54, 30, 30, 0.0, 1e10);
    lerpHeights(other.view(), t, map.view());
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 30; ++x) {
        ASSERT_GE(map(x, y), std::min(high(x, y), other(x, y))) << t;
        ASSERT_LE(map(x, y), std::max(high(x, y), other(x, y))) << t;
      }
    }
  }
}

TEST(HeightMapOperations, ShiftScaleAndFillARectangleWithOneRounding) {
  const HeightMap before = randomMap(44, 9, 8, 1000.0, 3.0);
  HeightMap map = before;
  shiftHeights(map.view().part(2, 1, 4, 6), -999.9);
  scaleHeights(map.view().part(2, 1, 4, 6), 1.0 / 3.0);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 9; ++x) {
      const bool inside = x >= 2 && x < 6 && y >= 1 && y < 7;
      const auto shifted = static_cast<float>(static_cast<double>(before(x, y)) - 999.9);
      const auto expected = static_cast<float>(static_cast<double>(shifted) * (1.0 / 3.0));
      EXPECT_EQ(map(x, y), inside ? expected : before(x, y)) << x << ", " << y;
    }
  }
  scaleHeights(map.view(), 1e39);
  EXPECT_TRUE(std::isinf(map(0, 0)));
  fillHeights(map.view().part(0, 0, 9, 1), -2.5F);
  EXPECT_EQ(statistics(map.view().part(0, 0, 9, 1)).max, -2.5);
  EXPECT_TRUE(std::isinf(map(0, 1)));
}

TEST(HeightMapOperations, SumSeveralMapsInTheOrderOfTheTermsRoundedOnce) {
  std::vector<HeightMap> maps;
  std::vector<WeightedHeights> terms;
  for (std::uint64_t seed = 45; seed < 45 + kMostTerms; ++seed)
    maps.push_back(randomMap(seed, 7, 5, 0.0, 100.0));
  for (const HeightMap& map : maps)
    terms.push_back({map.view(), 1.0 / (1.0 + static_cast<double>(terms.size()))});
  HeightMap target = randomMap(44, 7, 5, 0.0, 1.0);
  weightedSum(terms, target.view());
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) {
      long double exact = 0.0L, size = 0.0L;
      double ordered = 0.0;
      for (const WeightedHeights& term : terms) {
        exact += static_cast<long double>(term.weight) * term.heights(x, y);
        size += std::fabs(static_cast<long double>(term.weight) * term.heights(x, y));
        ordered += term.weight * static_cast<double>(term.heights(x, y));
      }
      EXPECT_EQ(target(x, y), static_cast<float>(ordered));
      EXPECT_LE(std::fabs(target(x, y) - exact), kHeightRounding * std::fabs(exact) + kTermRounding * size);
    }
  }
  weightedSum({}, target.view());
  EXPECT_TRUE(test::sameBits(target.view(), HeightMap(7, 5).view()));
}

// ---- Rectangles that stick out ----

TEST(HeightMapOperations, MatchWhatTwoMapsShareOfARectangleAndNothingElse) {
  constexpr int kLeast = std::numeric_limits<int>::min(), kMost = std::numeric_limits<int>::max();
  HeightMap source(6, 5), target(4, 7);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 6; ++x) source(x, y) = static_cast<float>(100 + 10 * y + x);
  }
  RandomSequence random(53);
  const auto draw = [&] { return static_cast<int>(random.next() % 17) - 6; };
  int shared = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    const HeightRectangle from{draw(), draw(), draw(), draw()};
    const int column = draw(), row = draw();
    const MatchedParts parts = matchedParts(source.view(), from, target.view(), column, row);
    fillHeights(target.view(), 0.0F);
    copyHeights(parts.source, parts.target);
    for (int y = 0; y < 7; ++y) {
      for (int x = 0; x < 4; ++x) {
        const int dx = x - column, dy = y - row, sx = from.column + dx, sy = from.row + dy;
        const bool inRectangle = dx >= 0 && dy >= 0 && dx < from.columns && dy < from.rows;
        const bool inSource = sx >= 0 && sy >= 0 && sx < 6 && sy < 5;
        shared += inRectangle && inSource ? 1 : 0;
        ASSERT_EQ(target(x, y), inRectangle && inSource ? source(sx, sy) : 0.0F)
            << "rectangle " << from.column << " " << from.row << " " << from.columns << " " << from.rows
            << " at " << column << " " << row << ", sample " << x << " " << y;
      }
    }
  }
  EXPECT_GT(shared, 1000);
  for (const int odd : {kLeast, kMost}) {
    EXPECT_TRUE(matchedParts(source.view(), {odd, odd, odd, odd}, target.view(), odd, odd).target.empty());
    EXPECT_TRUE(matchedParts(source.view(), target.view(), odd, 0).source.empty());
  }
  const MatchedParts all = matchedParts(source.view(), {-3, 0, kMost, kMost}, target.view(), -3, 0);
  EXPECT_EQ(all.target.columns(), 4);
  EXPECT_EQ(all.target.rows(), 5);
}

TEST(HeightMapOperations, LeaveEmptyRectanglesAlone) {
  HeightMap target(3, 3);
  for (const Operation& operation : operations()) {
    operation.apply(HeightMap(0, 3).view(), target.view().part(0, 0, 0, 3));
    operation.apply(HeightMap().view(), HeightMap().view());
  }
  EXPECT_EQ(statistics(target.view()).max, 0.0);
}

}  // namespace
}  // namespace teren
