#include "coin/ScenePlacement.h"

#include <cstdint>

#include <gtest/gtest.h>

namespace teren {
namespace {

constexpr std::int64_t kFar = std::int64_t{1} << 50;

TEST(ScenePlacement, PutsASampleWhereItLiesInTheWorld) {
  const ScenePlacement placement(SbVec3d(100.0, -50.0, 20.0), 2.0);
  EXPECT_EQ(placement.position({60, -30}), SbVec3d(20.0, -10.0, -20.0));
}

TEST(ScenePlacement, IsExactNearAnOriginFarFromTheWorldsZero) {
  const double spacing = 2.0;
  const ScenePlacement placement(SbVec3d(kFar * spacing + 0.5, -kFar * spacing, 0.0), spacing);
  EXPECT_EQ(placement.position({kFar + 3, -kFar - 7}), SbVec3d(5.5, -14.0, 0.0));
}

TEST(ScenePlacement, CountsFromAWholePeriodOfTheTextureNearThePoint) {
  for (const std::int64_t far : {std::int64_t{0}, kFar + 5, -kFar - 5}) {
    const ScenePlacement placement(SbVec3d(static_cast<double>(far), 0.0, 0.0), 1.0);
    for (const float x : {-3000.0F, -512.5F, 0.0F, 511.0F, 7777.0F}) {
      const Sample reference = placement.referenceNear(SbVec3f(x, -x, 100.0F));
      EXPECT_EQ(reference.column % ScenePlacement::kReferenceStep, 0);
      EXPECT_EQ(reference.row % ScenePlacement::kReferenceStep, 0);
      const SbVec3d away = placement.position(reference) - SbVec3d(x, -x, 0.0);
      EXPECT_LE(std::abs(away[0]), 513.0);
      EXPECT_LE(std::abs(away[1]), 513.0);
    }
  }
}

TEST(ScenePlacement, TakesAnOriginBeyondAllWorldsForTheLastSampleThereIs) {
  const ScenePlacement placement(SbVec3d(1e300, -1e300, 0.0), 1.0);
  EXPECT_EQ(placement.position({ScenePlacement::kFarthest, -ScenePlacement::kFarthest}),
            SbVec3d(0.0, 0.0, 0.0));
}

TEST(ScenePlacement, BoxesAMeshOnItsMeasuredHeights) {
  Mesh mesh;
  mesh.level = 3;
  mesh.originColumn = 10;
  mesh.originRow = -10;
  mesh.columns = 4;
  mesh.rows = 2;
  mesh.minHeight = -5.0F;
  mesh.maxHeight = 7.0F;
  const SbBox3f box = ScenePlacement(SbVec3d(0.0, 0.0, 1.0), 2.0).box(mesh);
  EXPECT_EQ(box.getMin(), SbVec3f(20.0F, -20.0F, -6.0F));
  EXPECT_EQ(box.getMax(), SbVec3f(84.0F, 12.0F, 6.0F));
}

}  // namespace
}  // namespace teren
