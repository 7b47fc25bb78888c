#include "teren/PixelError.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Engine.h"
#include "teren/Hash.h"

#include "patch/ErrorCalibration.h"
#include "tests/engine/stream/FaultWorld.h"
#include "world/NodeErrors.h"

namespace teren {
namespace {

/// A square of a level with its south-west corner at a level-0 sample, at height 0.
std::shared_ptr<Mesh> square(std::int64_t column, std::int64_t row, int level, std::uint64_t id = 1) {
  auto mesh = std::make_shared<Mesh>();
  mesh->id = id;
  mesh->level = mesh->nodeLevel = level;
  mesh->originColumn = column;
  mesh->originRow = row;
  mesh->columns = mesh->rows = 1;
  mesh->vertices = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh->indices = std::make_shared<const TriangleIndices>(TriangleIndices{0, 1, 2, 0, 2, 3});
  return mesh;
}

class PixelErrorTest : public testing::Test {
 protected:
  static Scene sceneOf(std::vector<std::shared_ptr<const Mesh>> meshes) {
    return {1, 4.0, std::move(meshes)};
  }

  // 16 intervals of 4 m a patch.
  const std::shared_ptr<const World> world_ = test::faultWorld(3, 33, {64.0}, 40);
  const Eye eye_{{0, 0, 0.0, 0.0}, 30.0, 500.0};
};

TEST_F(PixelErrorTest, IsTheErrorDividedByTheDistanceInThreeDimensions) {
  const auto mesh = square(10, 0, 1);  // 40 m to the east, 30 m below
  const double error = drawnError(*world_, *mesh);
  ASSERT_GT(error, 0.0);
  const PixelError seen = pixelError(*world_, sceneOf({mesh}), eye_);
  EXPECT_DOUBLE_EQ(seen.max, error / 50.0 * 500.0);
  EXPECT_EQ(seen.p99, seen.max);
}

TEST_F(PixelErrorTest, IsNothingForLevelZeroAndForEmptyScenes) {
  const PixelError finest = pixelError(*world_, sceneOf({square(10, 0, 0)}), eye_);
  EXPECT_EQ(finest.max, 0.0);
  EXPECT_EQ(finest.p99, 0.0);
  EXPECT_EQ(pixelError(*world_, Scene(), eye_).max, 0.0);
}

TEST_F(PixelErrorTest, IsTheSameFarFromTheWorldsMiddle) {
  Eye there = eye_;
  there.position.i = -(std::int64_t{1} << 50);
  const PixelError here = pixelError(*world_, sceneOf({square(10, 0, 1)}), eye_);
  const PixelError far = pixelError(*world_, sceneOf({square(10 + there.position.i * 16, 0, 1)}), there);
  EXPECT_EQ(here.max, far.max);
}

TEST_F(PixelErrorTest, TellsTheNinetyNinthPercentileFromTheLargest) {
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (std::uint64_t k = 0; k < 200; ++k)
    meshes.push_back(square(static_cast<std::int64_t>(k) * 100 + 10, 0, 1, k));
  const PixelError seen = pixelError(*world_, sceneOf(meshes), eye_);
  const double error = drawnError(*world_, *meshes[0]);
  EXPECT_DOUBLE_EQ(seen.max, error / 50.0 * 500.0);
  // All but two of 200: the third nearest lies 210 samples to the east.
  EXPECT_DOUBLE_EQ(seen.p99, error / std::sqrt(840.0 * 840.0 + 900.0) * 500.0);
}

TEST_F(PixelErrorTest, NeverTakesNearGroundForFartherThanItIs) {
  EngineOptions options;
  options.view = {.level = 1, .radius = 2};
  auto engine = Engine::create(world_, options);
  ASSERT_TRUE(engine.ok());
  class Standing final : public Object {
   public:
    void update(double, const Ground&) override {}
    Motion motion() const override { return {}; }
  };
  (*engine)->add(std::make_unique<Standing>());
  (*engine)->settle();
  const auto scene = (*engine)->scene();
  RandomSequence random(9);
  for (int trial = 0; trial < 30; ++trial) {
    Eye eye = eye_;
    eye.position.u = static_cast<double>(random.next() >> 44) / (1 << 20);
    eye.position.v = static_cast<double>(random.next() >> 44) / (1 << 20);
    eye.height = static_cast<double>(random.next() % 60) - 20.0;
    double wanted = 0.0;
    for (const auto& mesh : scene->meshes()) {
      const double spacing = world_->spacing(mesh->level);
      for (const SurfaceVertex& vertex : mesh->vertices) {
        const double east =
            static_cast<double>(mesh->originColumn) * 4.0 + vertex.column * spacing - eye.position.u * 64.0;
        const double north =
            static_cast<double>(mesh->originRow) * 4.0 + vertex.row * spacing - eye.position.v * 64.0;
        const double up = static_cast<double>(vertex.height) - eye.height;
        const double distance = std::max(std::sqrt(east * east + north * north + up * up), kNearestGround);
        wanted = std::max(wanted, drawnError(*world_, *mesh) / distance * eye.lensPixels);
      }
    }
    const PixelError seen = pixelError(*world_, *scene, eye);
    EXPECT_GE(seen.max, wanted * (1.0 - 1e-12)) << "trial " << trial;
    EXPECT_LE(seen.p99, seen.max);
  }
}

TEST_F(PixelErrorTest, GoesByLevelAndBendOfTheNodes) {
  ErrorCalibration calibration(*world_);
  while (!calibration.step(Slice::unlimited())) {
  }
  const auto flat = square(0, 0, 2), bent = square(0, 0, 2);
  bent->bend = 1e4F;
  EXPECT_DOUBLE_EQ(drawnError(*world_, *flat), world_->nodeErrors().estimate(2, 0.0));
  EXPECT_DOUBLE_EQ(drawnError(*world_, *bent), world_->nodeErrors().estimate(2, 1e4));
}

TEST(LensPixels, AreThoseOfTheTangent) {
  EXPECT_NEAR(lensPixels(720, 2.0 * std::atan(1.0)), 360.0, 1e-9);
}

}  // namespace
}  // namespace teren
