#include "generators/crater/CraterShape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace teren {
namespace {

/// Around the middle at this distance [m].
template <class Look>
void around(double distance, const Look& look) {
  for (int k = 0; k < 720; ++k) {
    const double azimuth = 2.0 * std::numbers::pi * k / 720.0;
    look(azimuth, distance * std::cos(azimuth), distance * std::sin(azimuth));
  }
}

TEST(CraterShape, HasThePublishedProportionsOfSimpleCraters) {
  // Pike 1977: of a crater 100 m wide the rim is 3.6 m above the ground and 19.6 m above the floor.
  const CraterShape crater(50.0, 16.0, kCraterRim, 0.0, 1);
  EXPECT_EQ(crater.height(0.0, 0.0), -16.0);
  EXPECT_NEAR(crater.height(50.0, 0.0), 3.6, 1e-12);
  EXPECT_NEAR(crater.height(0.0, -25.0), -16.0 + 19.6 / 4.0, 1e-12);  // a paraboloid
  // McGetchin et al. 1973: r^-3, here lowered so that it ends.
  const double end = 1.0 / 64.0;
  EXPECT_NEAR(crater.height(-100.0, 0.0), 3.6 * (1.0 / 8.0 - end) / (1.0 - end), 1e-12);
  EXPECT_NEAR(crater.height(0.0, 150.0), 3.6 * (1.0 / 27.0 - end) / (1.0 - end), 1e-12);
  EXPECT_EQ(crater.height(200.0, 0.0), 0.0);
}

TEST(CraterShape, HasNoStepAtTheRimNorWhereTheBlanketEnds) {
  const CraterShape crater(10.0, 4.0, 0.5, 0.25, 7);
  around(1.0, [&](double, double east, double north) {
    double before = crater.height(0.0, 0.0);
    for (double distance = 0.0; distance < 55.0; distance += 0.01) {
      const double height = crater.height(distance * east, distance * north);
      ASSERT_LT(std::fabs(height - before), 0.02) << distance;
      before = height;
    }
    EXPECT_EQ(before, 0.0);
  });
}

TEST(CraterShape, VariesItsOutlineWithTheSeedAndStaysWithinWhatItSays) {
  double least = 1e9, most = 0.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const CraterShape crater(10.0, 4.0, kCraterRim, 0.25, seed);
    around(CraterShape::reach(10.0, kCraterRim, 0.25), [&](double, double east, double north) {
      ASSERT_EQ(crater.height(east, north), 0.0);
      // Where the ground is highest along a ray, there is the rim.
      double rim = 0.0, highest = -9.0;
      for (double part = 0.1; part < 0.4; part += 0.005) {
        const double height = crater.height(part * east, part * north);
        ASSERT_LE(height, 4.0 * kCraterRim);
        ASSERT_GE(height, -4.0);
        if (height > highest) {
          highest = height;
          rim = part * CraterShape::reach(10.0, kCraterRim, 0.25);
        }
      }
      least = std::min(least, rim);
      most = std::max(most, rim);
    });
  }
  EXPECT_GT(least, 7.5);
  EXPECT_LT(least, 9.2);
  EXPECT_LT(most, 12.5);
  EXPECT_GT(most, 11.0);
}

TEST(CraterShape, EndsWhereTheBowlDoesIfItHasNoRim) {
  EXPECT_EQ(CraterShape::reach(10.0, 0.0, 0.25), 12.5);
  EXPECT_EQ(CraterShape::reach(10.0, 0.01, 0.25), 50.0);
  for (const double irregularity : {0.0, 0.25}) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      const CraterShape bowl(10.0, 4.0, 0.0, irregularity, seed);
      const double reach = CraterShape::reach(10.0, 0.0, irregularity);
      for (const double distance : {reach, 1.5 * reach, 3.0 * reach}) {
        around(distance, [&](double, double east, double north) {
          ASSERT_NEAR(bowl.height(east, north), 0.0, 1e-14);  // to the last bit of a level outline
        });
      }
    }
  }
}

TEST(CraterShape, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const CraterShape one(10.0, 4.0, kCraterRim, 0.1, 3), same(10.0, 4.0, kCraterRim, 0.1, 3);
  const CraterShape other(10.0, 4.0, kCraterRim, 0.1, 4);
  int differences = 0;
  around(9.0, [&](double, double east, double north) {
    EXPECT_EQ(one.height(east, north), same.height(east, north));
    differences += one.height(east, north) != other.height(east, north) ? 1 : 0;
  });
  EXPECT_GT(differences, 700);
}

TEST(CraterShape, TurnsItsAzimuthLikeTheTrigonometricFunctions) {
  // The outline is the level where r is 1: there the shape is as high as the rim.
  const CraterShape crater(10.0, 4.0, kCraterRim, 0.2, 11);
  // Waves of 2 to 5 periods around and no other: the mean radius of the outline is the radius, and so is the
  // mean of its first wave.
  double mean = 0.0, firstCosine = 0.0, firstSine = 0.0, sixth = 0.0;
  around(1.0, [&](double azimuth, double east, double north) {
    // In the bowl, the height tells r: -d + (d + h) r^2.
    const double r = std::sqrt((crater.height(4.0 * east, 4.0 * north) + 4.0) / (4.0 + 4.0 * kCraterRim));
    const double radius = 4.0 / r;
    mean += radius / 720.0;
    firstCosine += radius * std::cos(azimuth) / 720.0;
    firstSine += radius * std::sin(azimuth) / 720.0;
    sixth += radius * std::cos(6.0 * azimuth) / 720.0;
  });
  EXPECT_NEAR(mean, 10.0, 1e-12);
  EXPECT_NEAR(firstCosine, 0.0, 1e-12);
  EXPECT_NEAR(firstSine, 0.0, 1e-12);
  EXPECT_NEAR(sixth, 0.0, 1e-12);
}

TEST(CraterShape, IsTurnedOverByANegativeDepth) {
  const CraterShape bowl(10.0, 4.0, 0.3, 0.2, 5), mound(10.0, -4.0, 0.3, 0.2, 5);
  for (double distance : {0.0, 3.0, 9.0, 10.0, 11.0, 25.0, 60.0}) {
    around(distance, [&](double, double east, double north) {
      EXPECT_EQ(mound.height(east, north), -bowl.height(east, north));
    });
  }
}

}  // namespace
}  // namespace teren
