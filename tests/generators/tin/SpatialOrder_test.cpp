#include "generators/tin/SpatialOrder.h"

#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

TEST(SpatialOrder, TheCurveVisitsEveryCellOnceAndStepsToANeighbour) {
  constexpr int kSide = 128;
  std::vector<LatticePoint> points;
  for (std::int32_t y = 0; y < kSide; ++y) {
    for (std::int32_t x = 0; x < kSide; ++x) points.push_back({x, y});
  }
  const std::vector<std::uint32_t> order = hilbertOrder(points);
  std::vector<std::uint32_t> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (std::uint32_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], i);
  for (std::size_t i = 1; i < order.size(); ++i) {
    const LatticePoint a = points[order[i - 1]], b = points[order[i]];
    ASSERT_EQ(std::abs(a.x - b.x) + std::abs(a.y - b.y), 1);
  }
}

TEST(SpatialOrder, FollowsTheCurveOnTheWholeLatticeAndKeepsTheOrderWithinACell) {
  RandomSequence random(1);
  std::vector<LatticePoint> points{{kLatticeSide, kLatticeSide}, {0, 0}, {kLatticeSide, 0}};
  for (int i = 0; i < 5000; ++i) {
    points.push_back(
        {static_cast<std::int32_t>(random.nextBits(28)), static_cast<std::int32_t>(random.nextBits(28))});
    if (i % 7 == 0) points.push_back(points.back());
  }
  const std::vector<std::uint32_t> order = hilbertOrder(points);
  ASSERT_EQ(order.size(), points.size());
  for (std::size_t i = 1; i < order.size(); ++i) {
    const std::uint32_t before = hilbertPlace(points[order[i - 1]], 29),
                        after = hilbertPlace(points[order[i]], 29);
    ASSERT_TRUE(before < after || (before == after && order[i - 1] < order[i]));
  }
}

TEST(SpatialOrder, TakesNoPointsAndEqualPoints) {
  EXPECT_TRUE(hilbertOrder({}).empty());
  const std::vector<LatticePoint> same(3, {0, 0});
  EXPECT_EQ(hilbertOrder(same), (std::vector<std::uint32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace teren
