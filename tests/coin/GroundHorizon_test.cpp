#include "coin/GroundHorizon.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"
#include "teren/SceneQuery.h"

#include "tests/coin/Stage.h"

namespace teren {
namespace {

constexpr double kSpacing = 2.0;
constexpr int kSide = 24, kIntervals = 8;

/// [low, high)
double uniform(RandomSequence& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.nextBits(53)) * 0x1p-53;
}

double hills(double x, double y) {
  return 25.0 * std::sin(x / 9.0) * std::cos(y / 13.0) + 8.0 * std::sin((x + 2.0 * y) / 7.0) +
         std::fabs(std::remainder(x * 7.0 + y * 13.0, 5.0));
}

std::vector<const Mesh*> meshesOf(const Scene& scene) {
  std::vector<const Mesh*> meshes;
  for (const auto& mesh : scene.meshes()) meshes.push_back(mesh.get());
  return meshes;
}

/// From one point of a scene to another.
Ray between(const SbVec3d& from, const SbVec3d& to, int intervals) {
  const double x = from[0] / (kSpacing * intervals), y = from[1] / (kSpacing * intervals);
  Ray ray;
  ray.from = {static_cast<std::int64_t>(std::floor(x)), static_cast<std::int64_t>(std::floor(y)),
              x - std::floor(x), y - std::floor(y)};
  ray.height = from[2];
  ray.direction = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  ray.length = 1.0;
  return ray;
}

/// Looks at ground from many places at random and asks lines of sight to each vertex of what is left out.
/// Returns the share of meshes that is.
double leftOut(const HandMade& plan, double lowest, double highest, std::uint64_t seed) {
  constexpr int kEyes = 150;
  const auto scene = makeScene(plan);
  const SceneQuery query(scene, plan.intervals);
  const ScenePlacement placement(SbVec3d(0.0, 0.0, 0.0), kSpacing);
  GroundHorizon horizon;
  RandomSequence random(seed);
  std::size_t meshes = 0;
  for (int trial = 0; trial < kEyes; ++trial) {
    const double x = uniform(random, 2.0, plan.side * plan.intervals - 2.0),
                 y = uniform(random, 2.0, plan.side * plan.intervals - 2.0);
    const SbVec3d eye(x * kSpacing, y * kSpacing, plan.height(x, y) + uniform(random, lowest, highest));
    std::vector<const Mesh*> seen = meshesOf(*scene);
    horizon.leaveOutHidden(seen, *scene, {}, placement, eye, 0.5);
    for (const auto& mesh : scene->meshes()) {
      if (std::find(seen.begin(), seen.end(), mesh.get()) != seen.end()) continue;
      ++meshes;
      for (const SurfaceVertex& vertex : mesh->vertices) {
        const SbVec3d place(kSpacing * static_cast<double>(mesh->originColumn + vertex.column),
                            kSpacing * static_cast<double>(mesh->originRow + vertex.row),
                            static_cast<double>(vertex.height));
        const Ray ray = between(eye, place, plan.intervals);
        RayHit hit;
        query.firstHits({&ray, 1}, {&hit, 1});
        EXPECT_EQ(hit.end, RayEnd::ground);
        EXPECT_LT(hit.way, 1.0 - 1e-6) << "trial " << trial << ", mesh " << mesh->id;
        if (::testing::Test::HasFailure()) return 0.0;
      }
    }
  }
  return static_cast<double>(meshes) / (static_cast<double>(scene->meshes().size()) * kEyes);
}

TEST(GroundHorizon, LeavesOutOnlyWhatNoLineOfSightReaches) {
  constexpr std::uint64_t kSeed = 84;
  RecordProperty("seed", static_cast<int>(kSeed));
  EXPECT_GT(leftOut({.side = kSide, .intervals = kIntervals, .spacing = kSpacing, .height = hills}, 6.0, 45.0,
                    kSeed),
            0.2);
}

TEST(GroundHorizon, SeesPastTheEdgesOfTowers) {
  constexpr std::uint64_t kSeed = 85;
  RecordProperty("seed", static_cast<int>(kSeed));
  const auto towers = [](double x, double y) {
    const auto isInside = [](double place) { return place - 32.0 * std::floor(place / 32.0) <= 8.0; };
    return isInside(x) && isInside(y) ? 60.0 : 0.0;
  };
  EXPECT_GT(leftOut({.side = 32, .intervals = 4, .spacing = kSpacing, .height = towers}, 5.0, 9.0, kSeed),
            0.1);
}

TEST(GroundHorizon, KeepsTheOrderOfTheOthers) {
  const auto scene =
      makeScene({.side = kSide, .intervals = kIntervals, .spacing = kSpacing, .height = hills});
  std::vector<const Mesh*> meshes = meshesOf(*scene);
  std::reverse(meshes.begin(), meshes.end());
  const std::vector<const Mesh*> all = meshes;
  GroundHorizon horizon;
  horizon.leaveOutHidden(meshes, *scene, {}, {SbVec3d(0.0, 0.0, 0.0), kSpacing}, SbVec3d(100.0, 120.0, 60.0),
                         0.5);
  EXPECT_LT(meshes.size(), all.size());
  auto at = all.begin();
  for (const Mesh* mesh : meshes) {
    at = std::find(at, all.end(), mesh);
    ASSERT_NE(at, all.end());
  }
}

TEST(GroundHorizon, LeavesOutNothingWhereTheNearPlaneMayCutAwayWhatHides) {
  const auto scene =
      makeScene({.side = kSide, .intervals = kIntervals, .spacing = kSpacing, .height = hills});
  GroundHorizon horizon;
  const SbVec3d eye(100.0, 120.0, 60.0);
  std::vector<const Mesh*> near = meshesOf(*scene), cut = near;
  horizon.leaveOutHidden(near, *scene, {}, {SbVec3d(0.0, 0.0, 0.0), kSpacing}, eye, 0.5);
  horizon.leaveOutHidden(cut, *scene, {}, {SbVec3d(0.0, 0.0, 0.0), kSpacing}, eye, 40.0);
  EXPECT_LT(near.size(), scene->meshes().size());
  EXPECT_EQ(cut.size(), scene->meshes().size());
}

TEST(GroundHorizon, CountsOnNoHeightThatAVertexMayLose) {
  const auto towers = [](double x, double) { return 16.0 <= x && x <= 20.0 ? 60.0 : 0.0; };
  const auto scene = makeScene({.side = 8, .intervals = 4, .spacing = kSpacing, .height = towers});
  const SbVec3d eye(3.0, 30.0, 9.0);
  const auto drawn = [&](float coarser) {
    std::vector<std::shared_ptr<const Mesh>> moved;
    std::vector<const Mesh*> meshes;
    for (const auto& mesh : scene->meshes()) {
      auto copy = std::make_shared<Mesh>(*mesh);
      for (SurfaceVertex& vertex : copy->vertices)
        vertex.setCoarser(0, vertex.height > 0.0F ? coarser : 0.0F, 0, 0);
      meshes.push_back(copy.get());
      moved.push_back(std::move(copy));
    }
    GroundHorizon horizon;
    horizon.leaveOutHidden(meshes, *scene, {}, {SbVec3d(0.0, 0.0, 0.0), kSpacing}, eye, 0.5);
    return meshes.size();
  };
  EXPECT_LT(drawn(60.0F), scene->meshes().size());
  EXPECT_EQ(drawn(0.0F), scene->meshes().size());
}

TEST(GroundHorizon, LeavesOutNothingForAnEyeThatMaySeeTheLandFromBelow) {
  // A valley behind a high rim in the west, and a slope behind the valley.
  const auto valley = [](double x, double) { return x < 24.0 ? 100.0 : std::max(0.0, 0.5 * (x - 120.0)); };
  const auto scene =
      makeScene({.side = kSide, .intervals = kIntervals, .spacing = kSpacing, .height = valley});
  const auto drawn = [&](const SbVec3d& eye) {
    GroundHorizon horizon;
    std::vector<const Mesh*> meshes = meshesOf(*scene);
    horizon.leaveOutHidden(meshes, *scene, {}, {SbVec3d(0.0, 0.0, 0.0), kSpacing}, eye, 0.5);
    return meshes.size();
  };
  const std::size_t all = scene->meshes().size();
  EXPECT_LT(drawn(SbVec3d(20.0, 150.0, 110.0)), all) << "from the rim, the valley's near side is hidden";
  EXPECT_EQ(drawn(SbVec3d(20.0, 150.0, 50.0)), all) << "under the rim";
  EXPECT_EQ(drawn(SbVec3d(-30.0, 150.0, 5.0)), all) << "before it, beyond the land's end";
  EXPECT_EQ(drawn(SbVec3d(-30.0, 150.0, 110.0)), all) << "where a lower line may begin under the rim";
}

TEST(GroundHorizon, SeesAllOfAPlain) {
  const auto scene = makeScene({.side = kSide, .intervals = kIntervals, .spacing = kSpacing});
  GroundHorizon horizon;
  std::vector<const Mesh*> seen = meshesOf(*scene);
  horizon.leaveOutHidden(seen, *scene, {}, {SbVec3d(0.0, 0.0, 0.0), kSpacing}, SbVec3d(100.0, 120.0, 3.0),
                         0.5);
  EXPECT_EQ(seen.size(), scene->meshes().size());
}

}  // namespace
}  // namespace teren
