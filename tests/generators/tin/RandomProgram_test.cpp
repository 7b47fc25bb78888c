#include "tests/generators/tin/RandomProgram.h"

#include <cstdlib>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "tests/generators/tin/CgalOracle.h"

namespace teren {
namespace {

using test::kAllPointKinds;
using test::PointKind;
using test::RandomProgram;

bool longVersion() {
  return std::getenv("TEREN_FULL") != nullptr;
}

class RandomPrograms : public testing::TestWithParam<PointKind> {};

INSTANTIATE_TEST_SUITE_P(OnPoints, RandomPrograms, testing::ValuesIn(kAllPointKinds),
                         [](const auto& kind) { return std::string(test::nameOf(kind.param)); });

/// Runs a program of so many steps and proves the whole mesh after each.
void runProved(PointKind kind, std::uint64_t seed, std::size_t vertices, std::int32_t side, int steps) {
  RandomProgram program(seed, kind, vertices, side);
  for (int n = 0; n < steps; ++n) {
    program.step();
    const std::string where =
        "step " + std::to_string(n) + " of seed " + std::to_string(seed) + ", side " + std::to_string(side);
    ASSERT_EQ(program.complaint(), "") << where;
    const Result<void> proof = program.mesh().validate();
    ASSERT_TRUE(proof.ok()) << where << ": " << proof.error().message;
    if (n % 20 == 0 || n == steps - 1) {
      ASSERT_EQ(test::differenceFromCgal(program.mesh()), "") << where;
    }
  }
}

TEST_P(RandomPrograms, LeaveAMeshThatCanBeProvedAfterEveryOperationAndEqualsCgals) {
  const int steps = longVersion() ? 10000 : 500;
  // A box of few steps is full of equal points, and of crossings that are rounded onto something.
  for (const std::int32_t side : {20, 300, 1 << 24, kLatticeSide}) {
    for (const std::size_t vertices : {20, 250}) {
      runProved(GetParam(), 100 + vertices, vertices, side, steps);
      if (HasFatalFailure()) return;
    }
  }
}

TEST_P(RandomPrograms, LeaveALargeMeshThatCanBeProvedAroundEveryOperationAndEqualsCgals) {
  constexpr std::uint64_t kSeed = 7;
  RandomProgram program(kSeed, GetParam(), 5000);
  std::vector<LatticePoint> points(4000);
  for (LatticePoint& p : points) p = program.randomPoint();
  program.mesh().insert(points, std::vector<double>(points.size()));
  for (int n = 0; n < (longVersion() ? 200000 : 1000); ++n) {
    program.step();
    ASSERT_EQ(program.complaint(), "") << "step " << n << " of seed " << kSeed;
    for (const VertexId v : program.touched()) {
      if (!program.mesh().isVertex(v)) continue;
      const Result<void> proof = program.mesh().validateAround(v);
      ASSERT_TRUE(proof.ok()) << "step " << n << " of seed " << kSeed << ": " << proof.error().message;
    }
  }
  const Result<void> proof = program.mesh().validate();
  EXPECT_TRUE(proof.ok()) << "seed " << kSeed << ": " << proof.error().message;
  EXPECT_EQ(test::differenceFromCgal(program.mesh()), "") << "seed " << kSeed;
}

TEST_P(RandomPrograms, ReportEveryTriangleThatComesOrGoes) {
  constexpr std::uint64_t kSeed = 11;
  using Corners = std::array<VertexId, 3>;
  const auto turned = [](Corners corners) {  // the smallest first, so that equal triangles are equal
    while (corners[0] > corners[1] || corners[0] > corners[2]) {
      corners = {corners[1], corners[2], corners[0]};
    }
    return corners;
  };
  RandomProgram program(kSeed, GetParam(), 100);
  std::vector<TriangleChange> changes;
  program.mesh().recordChanges(&changes);
  std::map<Corners, int> surface;
  for (TriangleId t = 0; t < program.mesh().triangleSlots(); ++t)
    ++surface[turned(program.mesh().corners(t))];
  for (int n = 0; n < 1000; ++n) {
    changes.clear();
    program.step();
    for (const TriangleChange& change : changes) {
      int& count = surface[turned(change.corners)];
      count += change.created ? 1 : -1;
      ASSERT_TRUE(count == 0 || count == 1) << "step " << n << " of seed " << kSeed;
    }
    std::erase_if(surface, [](const auto& triangle) { return triangle.second == 0; });
    ASSERT_EQ(surface.size(), program.mesh().triangleCount()) << "step " << n << " of seed " << kSeed;
    for (TriangleId t = 0; t < program.mesh().triangleSlots(); ++t) {
      if (!program.mesh().isTriangle(t)) continue;
      ASSERT_TRUE(surface.contains(turned(program.mesh().corners(t))))
          << "step " << n << " of seed " << kSeed;
    }
  }
}

}  // namespace
}  // namespace teren
