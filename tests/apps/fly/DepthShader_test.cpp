#include "apps/fly/DepthShader.h"

#include <cmath>

#include <Inventor/nodes/SoBaseColor.h>
#include <Inventor/nodes/SoLightModel.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSphere.h>
#include <QImage>
#include <gtest/gtest.h>

#include "coin/SoTerrain.h"
#include "tests/coin/OffscreenView.h"
#include "tests/coin/Stage.h"

namespace teren {
namespace {

/// A red ball half sunk into level green ground, seen slantwise from `distance` metres.
class HalfSunkBall {
 public:
  explicit HalfSunkBall(double distance) : distance_(distance) {
    SoTerrain& ground = *stage_.terrain;
    ground.waterLevel = -2e6F;
    ground.hazeColor = SbColor(0.0F, 1.0F, 0.0F);
    ground.viewDistance = 1e-3F;
    ground.setScene(makeScene({.column = -32, .row = -32, .spacing = 0.05 * distance}));
    stage_.root->addChild(depth_.node());
    auto* flat = new SoLightModel;
    flat->model = SoLightModel::BASE_COLOR;
    auto* red = new SoBaseColor;
    red->rgb = SbColor(1.0F, 0.0F, 0.0F);
    auto* ball = new SoSphere;
    ball->radius = static_cast<float>(0.1 * distance);
    for (SoNode* node : {static_cast<SoNode*>(flat), static_cast<SoNode*>(red), static_cast<SoNode*>(ball)}) {
      depth_.node()->addChild(node);
    }
    const auto aside = static_cast<float>(distance * std::sqrt(0.5));
    stage_.look(SbVec3f(0.0F, -aside, aside), 0.0, -45.0);
    stage_.camera->heightAngle = 0.4F;
  }

  QImage picture(bool logarithmic, float nearest, float farthest) {
    stage_.camera->nearDistance = nearest;
    stage_.camera->farDistance = farthest;
    stage_.terrain->logarithmicDepth = logarithmic;
    depth_.setPlanes(nearest, farthest);
    depth_.turnOn(logarithmic);
    return view_.picture(stage_.root, kMagenta);
  }
  QImage logarithmic() { return picture(true, 0.5F, 100e3F); }
  /// With clipping planes so near each other that it errs nowhere.
  QImage ordinary() {
    return picture(false, static_cast<float>(0.5 * distance_), static_cast<float>(2.0 * distance_));
  }

 private:
  double distance_;
  Stage stage_;
  DepthShader depth_;
  OffscreenView view_{128, 128};
};

int redPixels(const QImage& picture) {
  int count = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) count += picture.pixel(x, y) == qRgb(255, 0, 0) ? 1 : 0;
  }
  return count;
}

TEST(DepthShader, LetsShapesAndTheLandHideEachOtherAsTheOrdinaryDepthDoes) {
  for (const double distance : {5.0, 1e3, 2e4, 6e4}) {
    HalfSunkBall ball(distance);
    const QImage ordinary = ball.ordinary(), logarithmic = ball.logarithmic();
    const int visible = redPixels(ordinary);
    EXPECT_GT(visible, 1000);
    EXPECT_LT(visible, 3000) << "the lower part is not hidden: nothing is tested";
    int different = 0;
    for (int y = 0; y < ordinary.height(); ++y) {
      for (int x = 0; x < ordinary.width(); ++x) {
        different += ordinary.pixel(x, y) != logarithmic.pixel(x, y) ? 1 : 0;
      }
    }
    EXPECT_LE(different, 4) << "at " << distance << " m";
  }
}

}  // namespace
}  // namespace teren
