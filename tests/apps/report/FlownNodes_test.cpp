// How many nodes are chosen, and anew, over ground that is known.
#include "apps/report/FlownNodes.h"

#include <numbers>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace teren {
namespace {

TEST(FlownNodes, OfOneLevelAreThoseWithinTheDistanceAndComeAsFastAsTheGroundPasses) {
  const FlownView view{.nodeSide = 10.0, .distance = 1000.0, .speed = 100.0, .seconds = 20.0};
  const std::vector<double> errors{0.0};
  const FlownNodes flown = flownNodes(errors, view);
  ASSERT_EQ(flown.inView.size(), 1U);
  // A disc, and half of the nodes on its rim more: they are taken where they begin within it.
  EXPECT_NEAR(flown.inView[0], std::numbers::pi * 1e4 + 400.0, 0.01 * std::numbers::pi * 1e4);
  EXPECT_NEAR(flown.newASecond[0], 201.0 * 10.0, 20.0) << "201 columns, 10 rows a second";
}

TEST(FlownNodes, AreSplitWhereTheirErrorIsSeen) {
  // 1 m is seen as 8 px at 100 m of distance, straight below, and as 1 px at 800 m.
  FlownView view{.nodeSide = 64.0, .distance = 4000.0, .lensPixels = 800.0, .pixelError = 1.0};
  const FlownNodes one = flownNodes(std::vector<double>{0.0, 1.0}, view);
  const double fine = one.inView[0] * 64.0 * 64.0;
  EXPECT_GT(fine, std::numbers::pi * 790.0 * 790.0);
  EXPECT_LT(fine, std::numbers::pi * 980.0 * 980.0) << "with nodes that reach beyond";
  view.pixelError = 8.1;
  const FlownNodes none = flownNodes(std::vector<double>{0.0, 1.0}, view);
  EXPECT_EQ(none.inView[0], 0.0);
  EXPECT_LT(none.newASecond[1], one.newASecond[0] + one.newASecond[1]);
  view.speed = 0.0;
  EXPECT_EQ(flownNodes(std::vector<double>{0.0, 1.0}, view).newASecond[1], 0.0);
}

TEST(FlownNodes, OfNoLevelsAreNone) {
  EXPECT_TRUE(flownNodes({}, {}).inView.empty());
}

}  // namespace
}  // namespace teren
