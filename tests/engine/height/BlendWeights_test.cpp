#include "height/BlendWeights.h"

#include <array>
#include <cmath>
#include <string>
#include <string_view>
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

/// The weight of a map at its sample (column, row): the product of two tents over the pitch on either side of
/// its centre.
double weightAt(BlendKernel kernel, int side, int column, int row) {
  const int pitch = (side - 1) / 2;
  const auto along = [&](int sample) {  // from rim over centre to rim
    return sample <= pitch ? blendWeights(kernel, static_cast<double>(sample) / pitch).high
                           : blendWeights(kernel, static_cast<double>(sample - pitch) / pitch).low;
  };
  return along(column) * along(row);
}

/// A weight as the thesis prints it: 0, 1, or two decimals, halves rounded up, without the leading zero.
std::string printed(double weight) {
  const int hundredths = static_cast<int>(std::floor(100.0 * weight + 0.5));
  if (hundredths % 100 == 0) return std::to_string(hundredths / 100);
  return std::string(".") + static_cast<char>('0' + hundredths / 10) +
         static_cast<char>('0' + hundredths % 10);
}

TEST(BlendWeights, OfTheLinearKernelAreDigitForDigitThePublishedMatrixOfSideNine) {
  // Thesis A (2005): the weight matrix of a map of side 9.
  constexpr std::array<std::string_view, 9> kPublished = {"0 0 0 0 0 0 0 0 0",                //
                                                          "0 .06 .13 .19 .25 .19 .13 .06 0",  //
                                                          "0 .13 .25 .38 .50 .38 .25 .13 0",  //
                                                          "0 .19 .38 .56 .75 .56 .38 .19 0",  //
                                                          "0 .25 .50 .75 1 .75 .50 .25 0",    //
                                                          "0 .19 .38 .56 .75 .56 .38 .19 0",  //
                                                          "0 .13 .25 .38 .50 .38 .25 .13 0",  //
                                                          "0 .06 .13 .19 .25 .19 .13 .06 0",  //
                                                          "0 0 0 0 0 0 0 0 0"};
  for (int row = 0; row < 9; ++row) {
    std::string line;
    for (int column = 0; column < 9; ++column) {
      line += (column == 0 ? "" : " ") + printed(weightAt(BlendKernel::linear, 9, column, row));
    }
    EXPECT_EQ(line, kPublished[static_cast<std::size_t>(row)]) << "row " << row;
  }
}

TEST(BlendWeights, OfTheLinearKernelAreExactAsPublishedAlsoForTheDefaultSide) {
  // 1 in the middle, 0 on the rim, 1/4 in the middles of the quadrants, 1/2 half way along the arms;
  // quadrants laid over each other sum to one.
  const auto weight = [](int column, int row) { return weightAt(BlendKernel::linear, 65, column, row); };
  EXPECT_EQ(weight(32, 32), 1.0);
  for (const int k : {16, 48}) {
    EXPECT_EQ(weight(k, 32), 0.5);
    EXPECT_EQ(weight(32, k), 0.5);
    EXPECT_EQ(weight(k, k), 0.25);
    EXPECT_EQ(weight(64 - k, k), 0.25);
  }
  for (int k = 0; k < 65; ++k) {
    for (const int rim : {0, 64}) {
      EXPECT_EQ(weight(k, rim), 0.0);
      EXPECT_EQ(weight(rim, k), 0.0);
    }
  }
  for (int y = 0; y <= 32; ++y) {
    for (int x = 0; x <= 32; ++x) {
      EXPECT_EQ(weight(x, y) + weight(x + 32, y) + weight(x, y + 32) + weight(x + 32, y + 32), 1.0);
      EXPECT_EQ(weight(x, y), x * y / 1024.0);
    }
  }
}

}  // namespace
}  // namespace teren
