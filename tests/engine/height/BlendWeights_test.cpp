#include "height/BlendWeights.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

constexpr std::array kKernels = {BlendKernel::linear, BlendKernel::smooth};

/// Places in [0, 1] where rounding could go wrong: the ends, both sides of the middle, tiny and almost one,
/// dyadic ones (where the grid's samples lie) and random ones.
std::vector<double> places(std::uint64_t seed) {
  std::vector<double> result = {0.0, 1.0, 0.5, std::nextafter(0.5, 0.0), std::nextafter(0.5, 1.0)};
  for (int k = 1; k <= 60; ++k) {
    result.push_back(std::ldexp(1.0, -k));
    result.push_back(1.0 - std::ldexp(1.0, -k));
  }
  for (int k = 0; k <= 1024; ++k) result.push_back(k / 1024.0);
  result.push_back(5e-324);
  RandomSequence random(seed);
  for (int k = 0; k < 20'000; ++k)
    result.push_back(std::ldexp(static_cast<double>(random.nextBits(53)), -53));
  return result;
}

TEST(BlendWeights, AreNeverNegativeAndEachPairSumsToExactlyOne) {
  constexpr std::uint64_t kSeed = 1;
  RecordProperty("seed", static_cast<int>(kSeed));
  for (const BlendKernel kernel : kKernels) {
    for (const double t : places(kSeed)) {
      const AxisWeights pair = blendWeights(kernel, t);
      ASSERT_GE(pair.low, 0.0) << "t = " << t;
      ASSERT_GE(pair.high, 0.0) << "t = " << t;
      ASSERT_EQ(pair.low + pair.high, 1.0) << "t = " << t;
    }
  }
}

TEST(BlendWeights, AreExactAtTheEndsAndInTheMiddle) {
  for (const BlendKernel kernel : kKernels) {
    EXPECT_EQ(blendWeights(kernel, 0.0).low, 1.0);
    EXPECT_EQ(blendWeights(kernel, 0.0).high, 0.0);
    EXPECT_EQ(blendWeights(kernel, 0.5).low, 0.5);
    EXPECT_EQ(blendWeights(kernel, 0.5).high, 0.5);
    EXPECT_EQ(blendWeights(kernel, 1.0).low, 0.0);
    EXPECT_EQ(blendWeights(kernel, 1.0).high, 1.0);
    EXPECT_FALSE(std::signbit(blendWeights(kernel, 0.0).high));
    EXPECT_FALSE(std::signbit(blendWeights(kernel, 1.0).low));
  }
}

TEST(BlendWeights, AreMirroredBitForBitWhereverTheMirroredPlaceIsExact) {
  constexpr std::uint64_t kSeed = 2;
  RecordProperty("seed", static_cast<int>(kSeed));
  for (const BlendKernel kernel : kKernels) {
    for (const double t : places(kSeed)) {
      const double mirrored = 1.0 - t;
      if (1.0 - mirrored != t) continue;  // 1 - t was rounded
      ASSERT_EQ(blendWeights(kernel, t).low, blendWeights(kernel, mirrored).high) << "t = " << t;
      ASSERT_EQ(blendWeights(kernel, t).high, blendWeights(kernel, mirrored).low) << "t = " << t;
    }
  }
}

TEST(BlendWeights, HaveFourProductsThatSumToOneWithinTheNamedError) {
  constexpr std::uint64_t kSeed = 3;
  RecordProperty("seed", static_cast<int>(kSeed));
  const std::vector<double> all = places(kSeed);
  RandomSequence random(kSeed);
  for (const BlendKernel kernel : kKernels) {
    for (const double t : all) {
      const AxisWeights x = blendWeights(kernel, t),
                        y = blendWeights(kernel, all[random.next() % all.size()]);
      const double sum = ((x.low * y.low + x.high * y.low) + x.low * y.high) + x.high * y.high;
      ASSERT_LE(std::fabs(sum - 1.0), kPartitionError) << "t = " << t;
    }
  }
}

TEST(BlendWeights, SumTheirSquaresAsTheProductOfBothAxes) {
  const AxisWeights x = blendWeights(BlendKernel::smooth, 0.3), y = blendWeights(BlendKernel::linear, 0.8);
  double squares = 0.0;
  for (const double u : {x.low, x.high}) {
    for (const double v : {y.low, y.high}) squares += u * v * u * v;
  }
  EXPECT_NEAR(x.squares() * y.squares(), squares, 1e-15);
}

TEST(BlendWeights, GrowFromOneLatticePointToTheNext) {
  for (const BlendKernel kernel : kKernels) {
    double before = -1.0;
    for (int k = 0; k <= 100'000; ++k) {
      const double high = blendWeights(kernel, k / 100'000.0).high;
      ASSERT_GT(high, before) << "step " << k;
      before = high;
    }
  }
}

TEST(BlendWeights, FollowTheQuinticWithinAFewUnitsInTheLastPlace) {
  constexpr std::uint64_t kSeed = 4;
  RecordProperty("seed", static_cast<int>(kSeed));
  for (const double t : places(kSeed)) {
    const long double x = t;
    const long double exact = x * x * x * (x * (x * 6.0L - 15.0L) + 10.0L);
    const AxisWeights pair = blendWeights(BlendKernel::smooth, t);
    ASSERT_NEAR(pair.high, static_cast<double>(exact), 4 * 0x1p-53) << "t = " << t;
    if (t <= 0.5) {  // relative: nothing is lost near 0 ...
      ASSERT_NEAR(pair.high, static_cast<double>(exact), 8 * 0x1p-53 * pair.high) << "t = " << t;
    } else {  // ... nor near 1
      const long double y = 1.0L - x;
      const auto rest = static_cast<double>(y * y * y * (y * (y * 6.0L - 15.0L) + 10.0L));
      ASSERT_NEAR(pair.low, rest, 8 * 0x1p-53 * pair.low) << "t = " << t;
    }
  }
}

/// One-sided difference quotients of the upper weight at the ends of a cell.
struct EndDerivatives {
  double first = 0.0, second = 0.0;
};
EndDerivatives atEnd(BlendKernel kernel, double end, double h) {
  const double inwards = end == 0.0 ? h : -h;
  const double w0 = blendWeights(kernel, end).high, w1 = blendWeights(kernel, end + inwards).high,
               w2 = blendWeights(kernel, end + 2.0 * inwards).high;
  return {(w1 - w0) / inwards, ((w2 - w1) - (w1 - w0)) / (h * h)};
}

TEST(BlendWeights, OfTheSmoothKernelHaveNoFirstAndSecondDerivativeAtTheEnds) {
  constexpr double h = 0x1p-10;
  for (const double end : {0.0, 1.0}) {
    const EndDerivatives smooth = atEnd(BlendKernel::smooth, end, h);
    EXPECT_LE(std::fabs(smooth.first), 11.0 * h * h);                   // 10 t^3 / t
    EXPECT_LE(std::fabs(smooth.second), 61.0 * h);                      // 60 t
    EXPECT_NEAR(atEnd(BlendKernel::linear, end, h).first, 1.0, 1e-12);  // the crease that smooth avoids
  }
}

TEST(BlendWeights, OfTheLinearKernelAreThePublishedOnesForSideNine) {
  // Thesis A (2005), weight matrix of a map of side 9, two decimals.
  constexpr double kPublished[5][5] = {{0.0, 0.0, 0.0, 0.0, 0.0},
                                       {0.0, 0.06, 0.13, 0.19, 0.25},
                                       {0.0, 0.13, 0.25, 0.38, 0.50},
                                       {0.0, 0.19, 0.38, 0.56, 0.75},
                                       {0.0, 0.25, 0.50, 0.75, 1.0}};
  const auto along = [](int sample) {  // of the map's own weight, from rim over centre to rim
    return sample <= 4 ? blendWeights(BlendKernel::linear, sample / 4.0).high
                       : blendWeights(BlendKernel::linear, (sample - 4) / 4.0).low;
  };
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) {
      const double published = kPublished[y <= 4 ? y : 8 - y][x <= 4 ? x : 8 - x];
      EXPECT_NEAR(along(x) * along(y), published, 0.005 + 1e-12) << "column " << x << ", row " << y;
    }
  }
}

}  // namespace
}  // namespace teren
