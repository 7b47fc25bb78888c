#include "generators/sand/Sandbox.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "generators/numbers/Tangent.h"
#include "tests/generators/sand/Heaps.h"

namespace teren {
namespace {

constexpr std::uint64_t kNoLimit = ~std::uint64_t{0};
const double kSteepestAllowed = tangentOfDegrees(kDryRepose + kReposeTolerance);

double level(double, double) {
  return 0.0;
}

bool restless(Sandbox& sandbox) {
  for (int n = 0; n < 1'000; ++n) {
    if (sandbox.iterate(kNoLimit)) return false;
  }
  return true;
}

TEST(Sandbox, LeavesAGrooveAtTheAngleOfReposeWithNothingLost) {
  Sandbox sandbox(scatteredSand(2'000, 51, 5.0, level), {});
  const SixfoldVolume all = sandbox.surface().volume();
  const ToolShape tool = *ToolShape::disc(0.04, 0.1);
  for (const StampPlace& place : stampsAlong({0.2, 0.2}, {0.8, 0.7}, 0.02)) {
    ASSERT_TRUE(sandbox.stamp(tool, place));
    sandbox.iterate(2'000);
  }
  ASSERT_FALSE(restless(sandbox));
  EXPECT_LE(steepestLooseSlope(sandbox.surface()), kSteepestAllowed);
  EXPECT_TRUE(sandbox.surface().volume() + sandbox.surface().owed() == all);
  EXPECT_GT(sandbox.cleanUp().count().removed, 15U);
  EXPECT_LE(sandbox.cleanUp().count().largestError, SandSettings{}.flatness);
  const Result<void> sound = sandbox.surface().validate();
  EXPECT_TRUE(sound) << sound.error().message;
}

TEST(Sandbox, DriftsByLessThanATrillionthOfWhatMovedInAMillionSteps) {
  Sandbox sandbox(scatteredSand(1'000, 52, 5.0, level), {});
  const SixfoldVolume all = sandbox.surface().volume();
  const ToolShape tool = *ToolShape::disc(0.05, 0.1);
  RandomSequence random(53);
  while (sandbox.slides().count().steps < 1'000'000) {
    const StampPlace place{0.1 + 0.8 * uniform(random.next()), 0.1 + 0.8 * uniform(random.next()), 0.0};
    ASSERT_TRUE(sandbox.stamp(tool, place));
    sandbox.iterate(20'000);
  }
  const SixfoldVolume drift = sandbox.surface().volume() - all;
  EXPECT_TRUE(drift == -sandbox.surface().owed());
  const double part = asDouble(drift) / asDouble(sandbox.surface().volumeMoved());
  EXPECT_LT(std::fabs(part), 1e-12);
  RecordProperty("drift", std::to_string(part * 1e15) + "e-15");
}

TEST(Sandbox, TellsWhoeverDrawsWhatToLookAt) {
  Sandbox sandbox(scatteredSand(500, 54, 0.01, level), {});
  using Vertex = std::pair<std::int64_t, std::int64_t>;
  using Triangle = std::pair<std::array<VertexId, 3>, std::array<bool, 3>>;
  std::vector<Vertex> heights;      // and loose thickness
  std::vector<Triangle> triangles;  // and which sides are constrained
  const SandSurface& surface = sandbox.surface();
  const auto look = [&](VertexId v) {
    if (v >= heights.size()) heights.resize(v + 1);
    heights[v] = surface.mesh().isVertex(v) ? Vertex{surface.height(v), surface.loose(v)} : Vertex{};
  };
  const auto lookAt = [&](TriangleId t) {
    if (t >= triangles.size()) triangles.resize(t + 1);
    triangles[t] = {};
    if (!surface.mesh().isTriangle(t)) return;
    triangles[t].first = surface.mesh().corners(t);
    for (int i = 0; i < 3; ++i) triangles[t].second[i] = surface.mesh().isConstrained(t, i);
  };
  for (VertexId v = 0; v < surface.mesh().vertexSlots(); ++v) look(v);
  for (TriangleId t = 0; t < surface.mesh().triangleSlots(); ++t) lookAt(t);
  const ToolShape tool = *ToolShape::square(0.06, 0.05);
  for (const StampPlace& place : stampsAlong({0.2, 0.5}, {0.8, 0.5}, 0.03)) {
    ASSERT_TRUE(sandbox.stamp(tool, place));
    sandbox.iterate(1'000);
    for (const VertexId v : sandbox.changedVertices().ids()) look(v);
    for (const TriangleId t : sandbox.changedTriangles().ids()) lookAt(t);
    sandbox.forgetChanges();
    const std::vector<Vertex> followed = heights;
    const std::vector<Triangle> followedTriangles = triangles;
    for (VertexId v = 0; v < surface.mesh().vertexSlots(); ++v) look(v);
    for (TriangleId t = 0; t < surface.mesh().triangleSlots(); ++t) lookAt(t);
    ASSERT_EQ(followed, heights);
    ASSERT_EQ(followedTriangles, triangles);
  }
}

TEST(Sandbox, TellsWhatAToolHasLoosenedWithoutMovingIt) {
  Sandbox sandbox(scatteredSand(500, 56, 0.0, level), {});
  const SandSurface& surface = sandbox.surface();
  const ToolShape tool = *ToolShape::square(0.06, 0.05);
  ASSERT_TRUE(sandbox.stamp(tool, {0.5, 0.5, 1.0}));  // in the air: an outline and nothing else
  sandbox.forgetChanges();
  const VertexId slots = surface.mesh().vertexSlots();
  ASSERT_TRUE(sandbox.stamp(tool, {0.5, 0.5, 0.0, 1.0, 0.0}));  // heaps nothing up behind
  int onlyLoosened = 0;
  for (VertexId v = 0; v < slots; ++v) {
    if (!surface.mesh().isVertex(v) || surface.loose(v) == 0) continue;
    EXPECT_TRUE(sandbox.changedVertices().contains(v)) << v;
    onlyLoosened += surface.height(v) == 0 ? 1 : 0;
  }
  EXPECT_GT(onlyLoosened, 0);
}

TEST(Sandbox, CountsItselfAmongItsBytes) {
  const Sandbox sandbox(scatteredSand(100, 56, 5.0, level), {});
  EXPECT_GE(sandbox.bytes(), sizeof(Sandbox) - sizeof(SandSurface) + sandbox.surface().bytes());
}

TEST(Sandbox, SlidesAgainWhenTheSandDries) {
  SandSettings moist;
  moist.moisture = 1.0;
  Sandbox sandbox(scatteredSand(800, 55, 5.0, cone), moist);
  sandbox.loosenAll();
  ASSERT_FALSE(restless(sandbox));
  EXPECT_GT(steepestLooseSlope(sandbox.surface()), tangentOfDegrees(40.0));
  sandbox.setRepose(kDryRepose, 0.0);
  ASSERT_FALSE(restless(sandbox));
  EXPECT_LE(steepestLooseSlope(sandbox.surface()), kSteepestAllowed);
}

}  // namespace
}  // namespace teren
