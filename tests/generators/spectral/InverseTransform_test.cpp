#include "generators/spectral/InverseTransform.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "generators/numbers/RandomNumber.h"
#include "tests/support/AllocationCount.h"
#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

using test::finish;
using test::sameBits;

/// Harmonics written down in advance.
class WrittenHarmonics final : public HarmonicSource {
 public:
  explicit WrittenHarmonics(int largest)
      : largest_(largest), rows_(static_cast<std::size_t>((largest + 1) * (2 * largest + 1))) {}

  static WrittenHarmonics random(int largest, std::uint64_t seed) {
    WrittenHarmonics harmonics(largest);
    RandomSequence words(seed);
    for (Harmonic& harmonic : harmonics.rows_) {
      harmonic = {static_cast<float>(uniformAroundZero(words.next())),
                  static_cast<float>(uniformAroundZero(words.next()))};
    }
    return harmonics;
  }

  Harmonic& at(int k, int l) {
    return rows_[static_cast<std::size_t>(l * (2 * largest_ + 1) + largest_ + k)];
  }
  const Harmonic& at(int k, int l) const { return const_cast<WrittenHarmonics*>(this)->at(k, l); }

  int largest() const noexcept override { return largest_; }
  void row(int l, Harmonic* row) const noexcept override {
    std::copy_n(&at(-largest_, l), 2 * largest_ + 1, row);
  }

 private:
  int largest_;
  std::vector<Harmonic> rows_;
};

HeightMap transformed(const HarmonicSource& source, int side, const Slice& slice = Slice::unlimited(),
                      float scale = 1.0f) {
  HeightMap map(side, side);
  InverseTransform task(source, side, scale, map.view());
  finish(task, slice);
  return map;
}

/// The definition, in long double.
long double heightAt(const WrittenHarmonics& harmonics, int side, int x, int y) {
  long double sum = 0.0L;
  for (int l = 0; l <= harmonics.largest(); ++l) {
    for (int k = -harmonics.largest(); k <= harmonics.largest(); ++k) {
      const int part = (k * x + l * y) % side;
      const long double angle = 2.0L * std::numbers::pi_v<long double> * part / side;
      sum += harmonics.at(k, l).re * std::cos(angle) - harmonics.at(k, l).im * std::sin(angle);
    }
  }
  return sum;
}

double sumOfSizes(const WrittenHarmonics& harmonics) {
  double sum = 0.0;
  for (int l = 0; l <= harmonics.largest(); ++l) {
    for (int k = -harmonics.largest(); k <= harmonics.largest(); ++k) {
      sum += std::hypot(harmonics.at(k, l).re, harmonics.at(k, l).im);
    }
  }
  return sum;
}

TEST(InverseTransform, IsTheSumOfItsHarmonicsForAnyNumberOfThem) {
  for (int side : {2, 4, 8, 16, 32, 64}) {
    for (int largest : {0, 1, 2, 3, 4, 7, 8, 15, 16, 17, 31, 32, 40}) {
      const WrittenHarmonics harmonics = WrittenHarmonics::random(largest, static_cast<std::uint64_t>(side));
      const HeightMap map = transformed(harmonics, side);
      double largestError = 0.0;
      for (int n = 0; n < 40; ++n) {  // some 40 samples of the map, in all rows and columns
        const int x = (n * 13 + 5) % side, y = (n * 29 + n * n) % side;
        const double error = static_cast<double>(std::fabs(map(x, y) - heightAt(harmonics, side, x, y)));
        largestError = std::max(largestError, error);
      }
      const double bound = 0.05 * kTransformError * sumOfSizes(harmonics);
      EXPECT_LE(largestError, bound) << "side " << side << ", K = " << largest;
    }
  }
}

TEST(InverseTransform, PutsEveryWaveInItsPlace) {
  constexpr int side = 32;
  for (int l : {0, 1, 5, 15}) {
    for (int k : {-15, -8, -1, 0, 1, 3, 15}) {
      WrittenHarmonics harmonics(15);
      harmonics.at(k, l) = {0.75f, -0.5f};
      const HeightMap map = transformed(harmonics, side);
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          const double angle = 2.0 * std::numbers::pi * (k * x + l * y) / side;
          ASSERT_NEAR(map(x, y), 0.75 * std::cos(angle) + 0.5 * std::sin(angle), 1e-6)
              << "wave " << k << ", " << l << " at " << x << ", " << y;
        }
      }
    }
  }
}

TEST(InverseTransform, EqualsEverySecondSampleOfTwiceTheSide) {
  for (int largest : {0, 1, 3, 12, 16, 31, 32, 100}) {
    const WrittenHarmonics harmonics = WrittenHarmonics::random(largest, 7);
    HeightMap finest = transformed(harmonics, 256);
    for (int side = 128; side >= 2; side /= 2) {
      const HeightMap map = transformed(harmonics, side);
      HeightMap strided(side, side);
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) strided(x, y) = finest(x * (256 / side), y * (256 / side));
      }
      EXPECT_TRUE(sameBits(map.view(), strided.view())) << "side " << side << ", K = " << largest;
    }
  }
}

TEST(InverseTransform, RepeatsItsFirstColumnAndRowWhereTheMapIsClosed) {
  const WrittenHarmonics harmonics = WrittenHarmonics::random(9, 3);
  for (int side : {2, 8, 64}) {
    const HeightMap open = transformed(harmonics, side);
    HeightMap closed(side + 1, side + 1);
    InverseTransform task(harmonics, side, 1.0f, closed.view());
    finish(task);
    for (int y = 0; y <= side; ++y) {
      for (int x = 0; x <= side; ++x) ASSERT_EQ(closed(x, y), open(x % side, y % side)) << x << ", " << y;
    }
  }
}

TEST(InverseTransform, ScalesByOneMultiplication) {
  const WrittenHarmonics harmonics = WrittenHarmonics::random(9, 3);
  const HeightMap one = transformed(harmonics, 32),
                  many = transformed(harmonics, 32, Slice::unlimited(), 3.7f);
  for (std::size_t n = 0; n < one.samples().size(); ++n)
    ASSERT_EQ(many.samples()[n], 3.7f * one.samples()[n]);
}

TEST(InverseTransform, DoesNotDependOnSlicing) {
  for (int largest : {0, 16, 31, 60}) {
    const WrittenHarmonics harmonics = WrittenHarmonics::random(largest, 11);
    for (int side : {2, 16, 128}) {
      EXPECT_TRUE(sameBits(transformed(harmonics, side, test::shortestSlice()).view(),
                           transformed(harmonics, side).view()))
          << "side " << side << ", K = " << largest;
    }
  }
}

TEST(InverseTransform, DoesNotAllocateInItsSteps) {
  const WrittenHarmonics harmonics = WrittenHarmonics::random(20, 1);
  HeightMap map(65, 65);
  InverseTransform task(harmonics, 64, 1.0f, map.view());
  const long before = test::allocationCount();
  finish(task, test::shortestSlice());
  EXPECT_EQ(test::allocationCount(), before);
}

}  // namespace
}  // namespace teren
