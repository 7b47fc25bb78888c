#include "apps/fly/LandColours.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace teren {
namespace {

bool isGreen(const SbColor& colour) {
  return colour[1] > colour[0] + 0.1F && colour[1] > colour[2] + 0.1F;
}
bool isRed(const SbColor& colour) {
  return colour[0] > colour[1] + 0.3F && colour[0] > colour[2] + 0.3F;
}

TEST(LandColours, GoInACircle) {
  EXPECT_EQ(after(LandColours::natural), LandColours::levels);
  EXPECT_EQ(after(LandColours::levels), LandColours::errors);
  EXPECT_EQ(after(LandColours::errors), LandColours::natural);
}

TEST(LandColours, TellAnyTwoOfTenLevelsApart) {
  for (int one = 0; one < 10; ++one) {
    for (int other = 0; other < one; ++other) {
      const SbColor difference = levelColour(one) - levelColour(other);
      EXPECT_GT(difference.length(), 0.25F) << one << " and " << other;
    }
  }
  EXPECT_EQ(levelColour(12), levelColour(2));
  EXPECT_EQ(levelColour(-1), levelColour(0));
}

TEST(LandColours, AreGreenUpToTheErrorWantedAndRedBeyond) {
  for (const double share : {0.0, 0.3, 0.7, 0.99, 1.0, -1.0})
    EXPECT_TRUE(isGreen(errorColour(share))) << share;
  for (const double share : {1.0 + 1e-9, 1.2, 2.0, 50.0, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_TRUE(isRed(errorColour(share))) << share;
  }
  EXPECT_LT(errorColour(3.0)[1], errorColour(1.1)[1]) << "the redder the worse";
}

TEST(LandColours, HaveALegendThatNamesWhatIsThere) {
  const std::vector<std::size_t> nodes{3, 0, 1, 1200};
  const std::vector<LegendLine> levels = levelLegend(nodes);
  ASSERT_EQ(levels.size(), 3U);
  EXPECT_EQ(levels[0].says, "level 0:  3 nodes");
  EXPECT_EQ(levels[1].says, "level 2:  1 node");
  EXPECT_EQ(levels[2].says, "level 3:  1 200 nodes");
  EXPECT_EQ(levels[2].colour, levelColour(3));
  const std::vector<LegendLine> errors = errorLegend(16.0);
  ASSERT_EQ(errors.size(), 5U);
  EXPECT_EQ(errors[2].says, "16 px, as wanted");
  EXPECT_TRUE(isGreen(errors[2].colour));
  EXPECT_EQ(errors[4].says, "32 px and more");
  EXPECT_TRUE(isRed(errors[3].colour));
}

}  // namespace
}  // namespace teren
