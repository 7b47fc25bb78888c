// Residuals and slopes of maps that are known.
#include "apps/report/GeneratorTable.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "teren/RowTask.h"

#include "apps/report/MapRoughness.h"
#include "apps/report/Statistics.h"
#include "tests/apps/report/SmallWorld.h"

namespace teren {
namespace {

using test::always;

/// Heights by a formula of the sample of the finest map.
template <class Formula>
class FormulaGenerator final : public Generator {
 public:
  explicit FormulaGenerator(Formula formula) : formula_(formula) {}
  HeightRange range() const override { return {0.0, 1.0, -1e6, 1e6}; }
  double residual(int level, int, double) const override { return 10.0 * level; }
  std::unique_ptr<GenerationTask> begin(const MapRequest& request, HeightView out) const override {
    const int stride = 1 << request.level;
    return makeRowTask(out, [this, out, stride](int row) {
      for (int x = 0; x < out.columns(); ++x) out(x, row) = formula_(x * stride, row * stride);
    });
  }

 private:
  Formula formula_;
};

TEST(Residual, OfAPlaneIsNone) {
  const FormulaGenerator plane(
      [](int x, int y) { return 0.5F * static_cast<float>(x) - 2.0F * static_cast<float>(y); });
  for (int level = 0; level < kResidualLevels; ++level) {
    const LevelResidual residual = *residualOf(plane, level, 3, always);
    EXPECT_EQ(residual.promised, 10.0 * level);
    ASSERT_EQ(residual.ofMaps.size(), 3U);
    EXPECT_EQ(rootMeanSquare(residual.ofMaps), 0.0) << level;
    EXPECT_NEAR(residual.slope, std::hypot(0.5, 2.0) / 2.0, 1e-6) << "samples are 2 m apart";
  }
}

TEST(Residual, OfAHatIsItsRootMeanSquare) {
  // Ridges of height 1 on every second column: level 1 has the columns between them alone, at height 0.
  const FormulaGenerator ridges([](int x, int) { return x % 2 == 0 ? 0.0F : 1.0F; });
  const LevelResidual residual = *residualOf(ridges, 1, 2, always);
  EXPECT_NEAR(rootMeanSquare(residual.ofMaps), std::sqrt(32.0 / 65.0), 1e-12);
  EXPECT_EQ(residual.slope, 0.0);
  EXPECT_NEAR(residualOf(ridges, 0, 2, always)->slope, 0.5, 1e-12);
  // Ridges on every fourth column: level 1 has them, as tents as wide as its squares; the finest map is
  // off by half a ridge on both sides of each.
  const FormulaGenerator tents([](int x, int) { return x % 4 == 2 ? 1.0F : 0.0F; });
  EXPECT_NEAR(rootMeanSquare(residualOf(tents, 1, 2, always)->ofMaps), std::sqrt(32.0 * 0.25 / 65.0), 1e-12);
  EXPECT_EQ(residualOf(tents, 0, 2, always)->ofMaps[0], 0.0);
}

TEST(Residual, StopsBeforeTheNextMapWhenAskedTo) {
  const FormulaGenerator plane([](int x, int) { return static_cast<float>(x); });
  int asked = 0;
  const auto residual = residualOf(plane, 1, 1'000'000, [&] { return ++asked < 3; });
  ASSERT_FALSE(residual);
  EXPECT_EQ(residual.error().message, "interrupted");
  EXPECT_EQ(asked, 3);
}

TEST(Slope, OfTrianglesIsThatOfTheirPlanes) {
  HeightMap map(3, 3);
  map(1, 1) = 1.0F;  // a pyramid; six of the eight triangles have a corner on top
  // Slopes squared: one side of 1 in four of them, both sides in two; 2 m apart.
  EXPECT_NEAR(slopeOfTriangles(map.view(), 2.0), std::sqrt((4.0 * 1.0 + 2.0 * 2.0) / 8.0) / 2.0, 1e-12);
}

}  // namespace
}  // namespace teren
