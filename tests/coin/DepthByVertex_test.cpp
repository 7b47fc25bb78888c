#include "coin/DepthByVertex.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "coin/OpenGL.h"
#include "coin/SoTerrain.h"
#include "tests/coin/OffscreenView.h"
#include "tests/coin/Stage.h"

namespace teren {
namespace {

/// [low, high)
double uniform(RandomSequence& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.nextBits(53)) * 0x1p-53;
}

/// An eye that looks along -z, as matrices of Inventor have it: w is the distance along that.
SbDPMatrix alongZ() {
  SbDPMatrix matrix = SbDPMatrix::identity();
  matrix[2][3] = -1.0;
  matrix[3][3] = 0.0;
  return matrix;
}

TEST(DepthByVertex, IsFartherByItsBoundAtMostAndNeverNearer) {
  RandomSequence random(82);
  double most = 0.0;
  for (int trial = 0; trial < 100'000; ++trial) {
    const double wider = 1.0 + DepthByVertex::kWidest * uniform(random, 0.0, 1.0);
    const double u = 1.0, v = 1.0 / wider, share = uniform(random, 0.0, 1.0);  // inverse distances
    const double truth = -std::log(u + (v - u) * share), drawn = -share * std::log(v);
    most = std::max(most, std::exp(drawn - truth) - 1.0);
    ASSERT_GE(drawn - truth, -1e-15);
  }
  EXPECT_LE(most, DepthByVertex::kFarther);
  EXPECT_GT(most, 0.9 * DepthByVertex::kFarther);
}

TEST(DepthByVertex, KnowsTheLongestSideOfAMesh) {
  const auto scene = makeScene({.side = 1, .intervals = 4, .level = 1, .spacing = 3.0});
  EXPECT_DOUBLE_EQ(longestSide(*scene->meshes().front(), 3.0), 6.0 * std::numbers::sqrt2);
  const auto steep = makeScene({.side = 1, .intervals = 2, .spacing = 3.0, .height = [](double x, double) {
                                  return x == 1.0 ? 4.0 : 0.0;
                                }});
  EXPECT_DOUBLE_EQ(longestSide(*steep->meshes().front(), 3.0), std::sqrt(9.0 + 9.0 + 16.0));
}

TEST(DepthByVertex, KnowsTheLongestSideWhereverVerticesMove) {
  auto triangle = std::make_shared<Mesh>();
  triangle->indices = std::make_shared<const TriangleIndices>(TriangleIndices{0, 1, 2});
  triangle->vertices = {{0, 0, 5.0F}, {1, 0, 5.0F}, {0, 1, 5.0F}};
  EXPECT_DOUBLE_EQ(longestSide(*triangle, 3.0), std::sqrt(18.0)) << "all fixed";
  triangle->vertices[0].setCoarser(0, 12.0F, 0, 0);
  triangle->vertices[1].setCoarser(0, 1.0F, 0, 0);
  EXPECT_DOUBLE_EQ(longestSide(*triangle, 3.0), std::sqrt(9.0 + 11.0 * 11.0)) << "each by its own share";
}

TEST(DepthByVertex, KnowsHowNearABoxComes) {
  RandomSequence random(83);
  for (int trial = 0; trial < 1000; ++trial) {
    SbDPMatrix matrix;
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) matrix[row][column] = uniform(random, -1.0, 1.0);
    }
    const SbVec3d eye(uniform(random, -9.0, 9.0), uniform(random, -9.0, 9.0), uniform(random, -9.0, 9.0));
    const SbBox3f box(-1.0F, -2.0F, -3.0F, 3.0F, 2.0F, 1.0F);
    double least = 1e9;
    for (int corner = 0; corner < 8; ++corner) {
      const double x = (corner & 1) != 0 ? 3.0 : -1.0, y = (corner & 2) != 0 ? 2.0 : -2.0,
                   z = (corner & 4) != 0 ? 1.0 : -3.0;
      least = std::min(least, (x - eye[0]) * matrix[0][3] + (y - eye[1]) * matrix[1][3] +
                                  (z - eye[2]) * matrix[2][3] + matrix[3][3]);
    }
    EXPECT_NEAR(nearestDepth(box, eye, matrix), least, 1e-12);
  }
}

TEST(DepthByVertex, DoesForMeshesFarFromTheEyeForTheirTriangles) {
  const ScenePlacement placement(SbVec3d(0.0, 0.0, 0.0), 1.0);
  const auto flat = makeScene({.side = 1, .intervals = 4, .spacing = 1.0});
  const auto steep =
      makeScene({.side = 1, .intervals = 4, .spacing = 1.0, .firstId = 2, .height = [](double x, double) {
                   return x == 2.0 ? -3.0 : 0.0;
                 }});
  const Mesh &even = *flat->meshes().front(), &rough = *steep->meshes().front();
  const double away = std::numbers::sqrt2 / DepthByVertex::kWidest;
  DepthByVertex depth;
  const auto does = [&](const Mesh& mesh, double above) {
    return depth.does(mesh, placement, SbVec3d(0.0, 0.0, above), alongZ());
  };
  EXPECT_TRUE(does(even, 1.01 * away));
  EXPECT_FALSE(does(even, 0.99 * away));
  EXPECT_FALSE(does(even, 0.0));
  EXPECT_FALSE(does(even, -2.0 * away)) << "behind the eye";
  EXPECT_FALSE(does(rough, 1.5 * away));
  EXPECT_TRUE(does(rough, 3.5 * away));
  SbDPMatrix scaled = alongZ();
  for (int row = 0; row < 4; ++row) scaled[row][3] *= 10.0;
  EXPECT_TRUE(depth.does(even, placement, SbVec3d(0.0, 0.0, 1.01 * away), scaled));
  EXPECT_FALSE(depth.does(even, placement, SbVec3d(0.0, 0.0, 0.99 * away), scaled))
      << "in a scaled scene, too";
}

/// What OpenGL's depth buffer holds of level ground, in shares by which it lies farther than the ground is.
std::vector<double> fartherDrawn(double distance, double spacing, double down) {
  constexpr int kSide = 256;
  constexpr double kNearest = 0.5, kFarthest = 130e3, kAngle = 0.6;  // [m] [m] [rad]
  const Stage stage;
  stage.terrain->waterLevel = -2e6F;
  stage.terrain->logarithmicDepth = TRUE;
  stage.terrain->setScene(
      makeScene({.side = 8, .intervals = 16, .column = -64, .row = -64, .spacing = spacing}));
  stage.camera->nearDistance = static_cast<float>(kNearest);
  stage.camera->farDistance = static_cast<float>(kFarthest);
  stage.camera->heightAngle = static_cast<float>(kAngle);
  const double pitch = down * std::numbers::pi / 180.0;
  stage.look(SbVec3f(0.0F, static_cast<float>(-distance * std::cos(pitch)),
                     static_cast<float>(distance * std::sin(pitch))),
             0.0, -down);
  OffscreenView view(kSide, kSide);
  view.draw(stage.root, kMagenta);
  std::vector<float> depths(static_cast<std::size_t>(kSide) * kSide);
  glReadPixels(0, 0, kSide, kSide, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
  std::vector<double> farther;
  for (int y = 0; y < kSide; ++y) {
    const double slope = std::tan(0.5 * kAngle) * (2.0 * (y + 0.5) / kSide - 1.0);
    const double truth = distance * std::sin(pitch) / (std::sin(pitch) - slope * std::cos(pitch));
    for (int x = 0; x < kSide; ++x) {
      const auto depth = static_cast<double>(depths[static_cast<std::size_t>(y * kSide + x)]);
      if (depth == 1.0) continue;  // the ground's end
      farther.push_back(kNearest * std::pow(kFarthest / kNearest, depth) / truth - 1.0);
    }
  }
  return farther;
}

TEST(DepthByVertex, OfWhatIsDrawnKeepsItsBoundFromNearToFar) {
  constexpr double kRounded = 2e-5;  // of floats and 24 bits
  for (const double distance : {20.0, 300.0, 5e3, 1e5}) {
    for (const double share : {0.001, 0.01, 0.03, 0.1}) {
      const std::vector<double> farther = fartherDrawn(distance, share * distance, 30.0);
      ASSERT_GT(farther.size(), 500U);
      EXPECT_GT(*std::min_element(farther.begin(), farther.end()), -kRounded)
          << distance << " m, triangles of " << share << " of that";
      EXPECT_LT(*std::max_element(farther.begin(), farther.end()), DepthByVertex::kFarther + kRounded)
          << distance << " m, triangles of " << share << " of that";
    }
  }
}

TEST(DepthByVertex, IsThatOfFarGroundSoThatHiddenFragmentsAreLeftOut) {
  const std::vector<double> far = fartherDrawn(5e3, 0.03 * 5e3, 30.0),
                            near = fartherDrawn(5e3, 0.1 * 5e3, 30.0);
  EXPECT_GT(*std::max_element(far.begin(), far.end()), 4e-5);
  EXPECT_LT(*std::max_element(near.begin(), near.end()), 2e-5);
}

}  // namespace
}  // namespace teren
