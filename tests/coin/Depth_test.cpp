// Which of two surfaces that nearly touch is in front, near and far, by logarithmic depth and by the ordinary
// one.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <ostream>

#include <Inventor/nodes/SoOrthographicCamera.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <QColor>
#include <QImage>
#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "coin/SoTerrain.h"
#include "tests/coin/OffscreenView.h"
#include "tests/coin/Stage.h"

namespace teren {
namespace {

constexpr double kApart = 4e-6;                       // of the distance from which the surfaces are seen
constexpr float kNearest = 0.5F, kFarthest = 130e3F;  // [m] of the camera, as far as its turns need

/// [low, high)
double uniform(RandomSequence& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.nextBits(53)) * 0x1p-53;
}

/// Level ground in one colour: it is lost in its own haze.
void addGround(const Stage& stage, SoTerrain& terrain, const HandMade& plan, const SbColor& colour) {
  terrain.waterLevel = -2e6F;
  terrain.hazeColor = colour;
  terrain.viewDistance = 1e-3F;
  terrain.setScene(makeScene(plan));
  if (&terrain != stage.terrain) stage.root->addChild(&terrain);
}

struct Seen {
  int wrong = 0;  // pixels that show the surface behind
  int pixels = 0;
};

/// Moves a camera about, about `distance` metres from two level surfaces, one a little above the other.
Seen seenFrom(double distance, bool logarithmic, bool upperFirst, std::uint64_t seed) {
  constexpr int kFrames = 40, kSide = 128;
  const Stage stage;
  auto* other = new SoTerrain;
  HandMade plan;
  plan.spacing = 0.05 * distance;
  plan.column = plan.row = -32;
  const SbColor green(0.0F, 1.0F, 0.0F), red(1.0F, 0.0F, 0.0F);
  HandMade above = plan;
  above.height = [distance](double, double) { return kApart * distance; };
  addGround(stage, upperFirst ? *stage.terrain : *other, above, green);
  addGround(stage, upperFirst ? *other : *stage.terrain, plan, red);
  stage.terrain->logarithmicDepth = other->logarithmicDepth = logarithmic;
  stage.camera->nearDistance = kNearest;
  stage.camera->farDistance = kFarthest;
  stage.camera->heightAngle = 0.2F;
  OffscreenView view(kSide, kSide);
  RandomSequence random(seed);
  Seen seen;
  for (int frame = 0; frame < kFrames; ++frame) {
    const double down = uniform(random, 25.0, 90.0), heading = uniform(random, 0.0, 360.0);
    const double angle = down * std::numbers::pi / 180.0, turn = heading * std::numbers::pi / 180.0;
    stage.look(SbVec3f(static_cast<float>(-distance * std::cos(angle) * std::sin(turn)),
                       static_cast<float>(-distance * std::cos(angle) * std::cos(turn)),
                       static_cast<float>(distance * std::sin(angle))),
               heading, -down);
    const QImage picture = view.picture(stage.root, kMagenta);
    EXPECT_EQ(stage.terrain->drewLogarithmicDepth() != FALSE, logarithmic);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const QRgb pixel = picture.pixel(x, y);
        EXPECT_TRUE(pixel == qRgb(0, 255, 0) || pixel == qRgb(255, 0, 0))
            << QColor(pixel).name().toStdString();
        seen.wrong += pixel == qRgb(255, 0, 0) ? 1 : 0;
        ++seen.pixels;
      }
    }
  }
  return seen;
}

class DepthAt : public ::testing::TestWithParam<double> {};

TEST_P(DepthAt, NearlyTouchingSurfacesNeverErrWhereDepthIsLogarithmic) {
  for (const bool upperFirst : {false, true}) {
    EXPECT_EQ(seenFrom(GetParam(), true, upperFirst, 71).wrong, 0)
        << (upperFirst ? "drawn first" : "drawn last");
  }
}

TEST_P(DepthAt, NearlyTouchingSurfacesFlickerWhereDepthIsOrdinary) {
  int wrong = 0;
  for (const bool upperFirst : {false, true}) wrong += seenFrom(GetParam(), false, upperFirst, 71).wrong;
  EXPECT_GT(wrong, 100);
}

INSTANTIATE_TEST_SUITE_P(SomeKilometres, DepthAt, ::testing::Values(1e3, 1e4, 5e4, 1e5));

TEST(Depth, IsOrdinaryWithoutShadersAndWithoutPerspective) {
  const Stage stage;
  stage.terrain->logarithmicDepth = TRUE;
  stage.terrain->setScene(makeScene({}));
  stage.look(SbVec3f(64.0F, 64.0F, 100.0F), 0.0, -90.0);
  EXPECT_FALSE(stage.terrain->drewLogarithmicDepth());
  OffscreenView view(32, 32);
  view.draw(stage.root, kMagenta);
  EXPECT_TRUE(stage.terrain->drewLogarithmicDepth());
  setenv("TEREN_NO_SHADERS", "1", 1);
  OffscreenView plain(32, 32);
  plain.draw(stage.root, kMagenta);
  unsetenv("TEREN_NO_SHADERS");
  EXPECT_FALSE(stage.terrain->drewLogarithmicDepth());
  auto* parallel = new SoOrthographicCamera;
  parallel->position = SbVec3f(64.0F, 64.0F, 100.0F);
  parallel->height = 20.0F;
  parallel->farDistance = 200.0F;
  stage.root->replaceChild(stage.camera, parallel);
  view.draw(stage.root, kMagenta);
  EXPECT_FALSE(stage.terrain->drewLogarithmicDepth());
  EXPECT_EQ(backgroundPixels(view.picture(stage.root, kMagenta)), 0);
}

}  // namespace
}  // namespace teren
