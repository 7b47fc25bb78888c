#include "generators/sand/ToolShape.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace teren {
namespace {

const std::vector<ToolPoint> kCross{{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}};
const std::vector<ToolPoint> kHook{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 3}, {3, 3}, {3, 1}, {0, 1}};

void expectRefusal(const Result<ToolShape>& shape, const std::string& part) {
  ASSERT_FALSE(shape);
  EXPECT_NE(shape.error().message.find(part), std::string::npos) << shape.error().message;
}

TEST(ToolShape, HasAnInnerOutlineInsideTheOuterOneWhateverTheShape) {
  for (const Result<ToolShape>& shape :
       {ToolShape::disc(0.04, 0.1), ToolShape::square(0.1, 0.1), ToolShape::wedge(0.1, 0.1),
        ToolShape::ball(0.1, 0.05), ToolShape::rake(0.5, 0.1, 5), ToolShape::polygon(kHook, 0.5)}) {
    ASSERT_TRUE(shape) << shape.error().message;
    for (const ToolPart& part : shape->parts()) {
      ASSERT_FALSE(part.inner.empty());
      ASSERT_EQ(part.inner.front().size(), part.outer.size());
      for (const ToolPoint& p : part.outer) {
        EXPECT_LE(p.x * p.x + p.y * p.y, shape->reach() * shape->reach() * (1 + 1e-15));
      }
    }
  }
  EXPECT_EQ(ToolShape::rake(0.5, 0.1, 5)->parts().size(), 5U);
}

TEST(ToolShape, TakesAnOutlineInEitherDirection) {
  std::vector<ToolPoint> other(kHook.rbegin(), kHook.rend());
  const Result<ToolShape> one = ToolShape::polygon(kHook, 0.5), two = ToolShape::polygon(other, 0.5);
  ASSERT_TRUE(one && two);
  EXPECT_EQ(two->parts()[0].outer.size(), kHook.size());
  EXPECT_EQ(one->reach(), two->reach());
}

TEST(ToolShape, ReachesDownByItsDepth) {
  EXPECT_EQ(ToolShape::disc(0.04, 0.1)->parts()[0].depth.at({0.01, 0.02}), 0.1);
  const Result<ToolShape> wedge = ToolShape::wedge(0.5, 0.1);
  EXPECT_NEAR(wedge->parts()[0].depth.at({-0.25, 0.1}), 0.0, 1e-16);
  EXPECT_NEAR(wedge->parts()[0].depth.at({0.25, 0.1}), 0.1, 1e-16);
  const Result<ToolShape> ball = ToolShape::ball(0.1, 0.04);
  EXPECT_NEAR(ball->parts()[0].depth.at({0.0, 0.0}), 0.04, 1e-16);
  EXPECT_NEAR(ball->parts()[0].depth.at({ball->reach(), 0.0}), 0.0, 1e-15);
}

TEST(ToolShape, RefusesWhatIsNoToolWithOneSentence) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  expectRefusal(ToolShape::polygon(kCross, 0.1), "cross or touch itself");
  expectRefusal(ToolShape::polygon({}, 0.1), "3 to 256 points, not 0");
  expectRefusal(ToolShape::polygon(std::vector<ToolPoint>{{0, 0}, {1, 0}, {0, nan}}, 0.1), "numbers");
  expectRefusal(ToolShape::polygon(std::vector<ToolPoint>{{0, 0}, {1, 0}, {2, 0}}, 0.1), "touch itself");
  expectRefusal(ToolShape::polygon(std::vector<ToolPoint>{{0, 0}, {1, 0}, {1, 1}, {1, 0}}, 0.1),
                "touch itself");
  expectRefusal(ToolShape::polygon(std::vector<ToolPoint>{{0, 0}, {10, 0}, {10, 0.1}}, 0.1), "too narrow");
  expectRefusal(ToolShape::polygon(std::vector<ToolPoint>(257, {0.0, 0.0}), 0.1), "not 257");
  expectRefusal(ToolShape::disc(nan, 0.1), "radius");
  expectRefusal(ToolShape::disc(infinity, 0.1), "radius");
  expectRefusal(ToolShape::disc(0.1, -1.0), "depth");
  expectRefusal(ToolShape::disc(0.1, 0.1, 2), "points");
  expectRefusal(ToolShape::square(0.0, 0.1), "side");
  expectRefusal(ToolShape::rake(1.0, 0.1, 0), "teeth");
  expectRefusal(ToolShape::ball(0.1, 0.2), "radius");
}

}  // namespace
}  // namespace teren
