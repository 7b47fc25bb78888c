#include "coin/ScenePlacement.h"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

namespace teren {
namespace {

constexpr std::int64_t kFar = std::int64_t{1} << 50;

TEST(ScenePlacement, PutsASampleWhereItLiesInTheWorld) {
  const ScenePlacement placement(SbVec3d(100.0, -50.0, 20.0), 2.0);
  EXPECT_EQ(placement.position(Sample{60, -30}), SbVec3d(20.0, -10.0, -20.0));
}

TEST(ScenePlacement, IsExactNearAnOriginFarFromTheWorldsZero) {
  const double spacing = 2.0;
  const ScenePlacement placement(SbVec3d(kFar * spacing + 0.5, -kFar * spacing, 0.0), spacing);
  EXPECT_EQ(placement.position(Sample{kFar + 3, -kFar - 7}), SbVec3d(5.5, -14.0, 0.0));
}

TEST(ScenePlacement, TakesAnOriginThatIsTheDoubleNearestToASampleForThatSample) {
  const double pitch = 44.7;  // doubles near 10^12 cannot hold its multiples
  const double spacing = pitch / 1024.0;
  int rounded = 0;
  for (std::int64_t patch = 22'000'000'000; patch < 22'000'000'100; ++patch) {
    const double east = static_cast<double>(patch) * pitch;
    rounded += std::fma(static_cast<double>(patch), pitch, -east) != 0.0 ? 1 : 0;
    const ScenePlacement placement(SbVec3d(east, -east, 0.0), spacing);
    EXPECT_EQ(placement.position(Sample{patch * 1024, -patch * 1024}), SbVec3d(0.0, 0.0, 0.0));
  }
  EXPECT_GT(rounded, 50) << "nothing is tested";
}

TEST(ScenePlacement, CountsFromAnAnchorOfItsGridNearThePoint) {
  for (const std::int64_t far : {std::int64_t{0}, kFar + 5, -kFar - 5}) {
    const ScenePlacement placement(SbVec3d(static_cast<double>(far) * 0.5, 0.0, 40.25), 0.5);
    for (const double x : {-3000.3, -512.5, 0.0, 511.0, 7777.7}) {
      const SbVec3d point(x, -x, 100.0 + x);
      const Anchor anchor = placement.anchorNear(point, 50.0);
      EXPECT_EQ(anchor.sample.column % 64, 0) << "32 m are the largest power of two within 50 m";
      EXPECT_EQ(anchor.sample.row % 64, 0);
      EXPECT_EQ(std::remainder(anchor.height, 50.0F), 0.0F);
      const SbVec3d away = placement.position(anchor) - point;
      EXPECT_LE(std::abs(away[0]), 16.0);
      EXPECT_LE(std::abs(away[1]), 16.0);
      EXPECT_LE(std::abs(away[2]), 25.0);
      const SbVec3d nearest = placement.position(placement.anchorNear(point, 0.1)) - point;
      EXPECT_LE(std::abs(nearest[0]), 0.25) << "a sample at least";
      EXPECT_LE(std::abs(nearest[2]), 0.05 + 1e-4);
    }
  }
}

TEST(ScenePlacement, TakesAnOriginBeyondAllWorldsForTheLastSampleThereIs) {
  const ScenePlacement placement(SbVec3d(1e300, -1e300, 0.0), 1.0);
  EXPECT_EQ(placement.position(Sample{ScenePlacement::kFarthest, -ScenePlacement::kFarthest}),
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
