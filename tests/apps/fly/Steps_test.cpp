#include "apps/fly/Steps.h"

#include <gtest/gtest.h>

#include "teren/Engine.h"

namespace teren {
namespace {

TEST(Steps, GoUpAndDownOneByOneAndStopAtTheirEnds) {
  for (const Steps& steps :
       {Steps::distances(), Steps::pixelErrors(), Steps::toolSizes(), Steps::toolDepths()}) {
    double value = steps.at(0);
    for (int index = 1; index < steps.count(); ++index) {
      ASSERT_GT(steps.at(index), value);
      EXPECT_EQ(steps.next(value, 1), steps.at(index));
      EXPECT_EQ(steps.next(steps.at(index), -1), value);
      value = steps.at(index);
    }
    EXPECT_EQ(steps.next(value, 1), value);
    EXPECT_EQ(steps.next(steps.at(0), -1), steps.at(0));
    EXPECT_EQ(steps.at(-5), steps.at(0));
    EXPECT_EQ(steps.at(1000), value);
  }
}

TEST(Steps, TakeAValueBetweenTwoToItsNeighbours) {
  const Steps steps = Steps::distances();
  EXPECT_EQ(steps.next(17e3, 1), 20e3);
  EXPECT_EQ(steps.next(17e3, -1), 15e3);
  EXPECT_EQ(steps.next(5e5, 1), 5e5) << "a step farther is never nearer";
  EXPECT_EQ(steps.next(5e5, -1), 100e3);
  EXPECT_EQ(steps.next(3.0, -1), 3.0);
  EXPECT_EQ(steps.next(3.0, 1), 1e3);
}

TEST(Steps, FindTheNearestByRatio) {
  const Steps steps = Steps::pixelErrors();
  for (int index = 0; index < steps.count(); ++index) EXPECT_EQ(steps.nearest(steps.at(index)), index);
  EXPECT_EQ(steps.at(steps.nearest(9.0)), 8.0);
  EXPECT_EQ(steps.at(steps.nearest(9.9)), 11.0);
  EXPECT_EQ(steps.at(steps.nearest(0.001)), steps.at(0));
  EXPECT_EQ(steps.at(steps.nearest(1e9)), 64.0);
}

TEST(Steps, AreAllWhatAnEngineTakes) {
  for (int index = 0; index < Steps::distances().count(); ++index) {
    EXPECT_LE(Steps::distances().at(index), DetailSettings::kMostDistance);
  }
  for (int index = 0; index < Steps::pixelErrors().count(); ++index) {
    EXPECT_GE(Steps::pixelErrors().at(index), DetailSettings::kLeastError);
    EXPECT_LE(Steps::pixelErrors().at(index), DetailSettings::kMostError);
  }
}

}  // namespace
}  // namespace teren
