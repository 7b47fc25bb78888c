#include "generators/sand/OutlineClip.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "generators/numbers/RandomNumber.h"
#include "tests/generators/sand/Heaps.h"

namespace teren {
namespace {

const LatticeFrame kFrame = boxOf(20, 0x1p-20);

double distanceToSide(const ToolPoint& p, const ToolPoint& a, const ToolPoint& b) {
  const double x = b.x - a.x, y = b.y - a.y;
  const double part = std::clamp(((p.x - a.x) * x + (p.y - a.y) * y) / (x * x + y * y), 0.0, 1.0);
  const double offX = p.x - a.x - part * x, offY = p.y - a.y - part * y;
  return std::sqrt(offX * offX + offY * offY);
}

double distanceTo(const ToolOutline& outline, LatticePoint p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    least = std::min(least, distanceToSide({kFrame.placeX(p), kFrame.placeY(p)}, outline[i],
                                           outline[(i + 1) % outline.size()]));
  }
  return least;
}

TEST(OutlineClip, FollowsTheOutlineInTheBoxFromBorderToBorder) {
  RandomSequence random(71);
  const ToolShape disc = *ToolShape::disc(1.0, 0.1, 9);
  int whole = 0, cut = 0, none = 0;
  for (int n = 0; n < 2'000; ++n) {
    ToolOutline star;  // around a place in or near the box, with spikes
    const double x = 1.6 * uniform(random.next()) - 0.3, y = 1.6 * uniform(random.next()) - 0.3;
    for (const ToolPoint& p : disc.parts().front().outer) {
      const double reach = 0.05 + 0.3 * uniform(random.next());
      star.push_back({x + reach * p.x, y + reach * p.y});
    }
    const double margin = n % 2 == 0 ? 0.0 : 0.003;
    const std::vector<LatticeChain> chains = clippedOutline(kFrame, star, margin);
    for (const LatticeChain& chain : chains) {
      ASSERT_FALSE(chain.points.empty());
      if (!chain.closed) {
        EXPECT_TRUE(kFrame.isOnBorder(chain.points.front()) && kFrame.isOnBorder(chain.points.back())) << n;
      }
      for (const LatticePoint p : chain.points) {
        ASSERT_TRUE(kFrame.contains(p)) << n;
        ASSERT_LE(distanceTo(star, p), 1.5 * margin + kFrame.step) << n;
      }
    }
    const bool inside = std::all_of(star.begin(), star.end(), [](const ToolPoint& p) {
      return 0.0 <= p.x && p.x <= 1.0 && 0.0 <= p.y && p.y <= 1.0;
    });
    ASSERT_EQ(inside, chains.size() == 1 && chains.front().closed) << n;
    ++(inside ? whole : chains.empty() ? none : cut);
  }
  EXPECT_GT(whole, 200);
  EXPECT_GT(cut, 200);
  EXPECT_GT(none, 20);
}

TEST(OutlineClip, FindsNothingBeyondTheBoxHoweverFar) {
  constexpr double kFar = std::numeric_limits<double>::max();
  const ToolOutline around{{-3.0, -3.0}, {4.0, -3.0}, {4.0, 4.0}, {-3.0, 4.0}};
  const ToolOutline far{{kFar, 0.5}, {kFar, kFar}, {2.0, kFar}};
  const ToolOutline point{{1.5, 0.5}};
  for (const ToolOutline& outline : {around, far, point, ToolOutline{}}) {
    const std::vector<LatticeChain> chains = clippedOutline(kFrame, outline, 0.01);
    EXPECT_TRUE(chains.empty() || chains.front().points.empty());
  }
  const ToolOutline across{{0.5, 0.5}, {kFar, 0.25}, {kFar, 0.75}};
  const std::vector<LatticeChain> chains = clippedOutline(kFrame, across, 0.01);
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_EQ(chains.front().points.size(), 3U);
}

TEST(OutlineClip, KeepsASinglePointAndDropsEqualNeighbours) {
  const ToolOutline point{{0.5, 0.25}};
  const std::vector<LatticeChain> one = clippedOutline(kFrame, point, 0.0);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one.front().points, (std::vector<LatticePoint>{{1 << 19, 1 << 18}}));
  const double half = 0.3 * kFrame.step;
  const ToolOutline tiny{{0.5, 0.5}, {0.5 + half, 0.5}, {0.5, 0.5 + half}};
  EXPECT_EQ(clippedOutline(kFrame, tiny, 0.0).front().points.size(), 1U);
}

}  // namespace
}  // namespace teren
