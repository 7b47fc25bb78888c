#include "qt/TerrainStage.h"

#include <Inventor/SbVec2f.h>
#include <Inventor/SbVec2s.h>
#include <QWidget>
#include <gtest/gtest.h>

#include "qt/TerrainWidget.h"

namespace teren {
namespace {

TEST(TerrainStage, PlacesTheEyeToAMillimetreHoweverHighTheLandIs) {
  const TerrainWidget starter;  // sets Inventor up
  TerrainStage stage;
  stage.setViewDistance(1000.0);
  const Viewer viewer{.position = {std::int64_t{1} << 34, 7, 0.3, 0.9}, .pitch = 0.0};
  for (const double height : {-5000.3, 12.7, 1e6 + 0.3, -9e8 + 0.3}) {
    stage.look(viewer, height, 64.0);
    const Ray sight = stage.sight(SbVec2f(0.5F, 0.5F), SbVec2s(64, 64));  // from the near plane, level
    EXPECT_NEAR(sight.height, height, 1e-3) << height;
    EXPECT_NEAR(sight.direction[2], 0.0, 1e-6);
    const Offset away = offset(viewer.position, sight.from, 64.0);
    EXPECT_NEAR(away.east, 0.0, 1e-3);
    EXPECT_NEAR(away.north, 0.3, 1e-3);
  }
}

}  // namespace
}  // namespace teren
