#include "coin/TerrainBuffers.h"

#include <Inventor/nodes/SoSeparator.h>
#include <gtest/gtest.h>

#include "tests/coin/OffscreenView.h"
#include "tests/coin/Stage.h"

namespace teren {
namespace {

constexpr int kIntervals = 16;
constexpr std::size_t kVertexBytes = (kIntervals + 1) * (kIntervals + 1) * sizeof(SurfaceVertex);
constexpr std::size_t kIndexBytes = kIntervals * kIntervals * 6 * sizeof(std::uint32_t);

/// A context, current for as long as it lives, and sixteen meshes with one index list.
class TerrainBuffersTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto* empty = new SoSeparator;
    view_.picture(empty, kMagenta);
  }
  const Mesh& mesh(std::size_t index) const { return *scene_->meshes()[index]; }

  OffscreenView view_{8, 8};
  std::shared_ptr<const Scene> scene_ = makeScene({.intervals = kIntervals});
};

TEST_F(TerrainBuffersTest, MeshesOfOneShapeShareTheirIndexBuffer) {
  TerrainBuffers buffers;
  buffers.frame();
  for (std::size_t index = 0; index < 3; ++index) {
    EXPECT_EQ(buffers.bind(mesh(index)).vertices, nullptr);
    EXPECT_EQ(buffers.bind(mesh(index)).indices, nullptr);
  }
  EXPECT_EQ(buffers.bytes(), 3 * kVertexBytes + kIndexBytes);
  buffers.clear();
}

TEST_F(TerrainBuffersTest, WhatIsOverTheQuotaIsDrawnFromItsOwnMemoryAndUploadedInAFrameToCome) {
  TerrainBuffers buffers(kVertexBytes + kIndexBytes);
  buffers.frame();
  EXPECT_EQ(buffers.bind(mesh(0)).vertices, nullptr);
  const TerrainBuffers::Start start = buffers.bind(mesh(1));
  EXPECT_EQ(static_cast<const void*>(start.vertices), mesh(1).vertices.data());
  EXPECT_EQ(start.indices, mesh(1).indices->data());
  EXPECT_EQ(buffers.bytes(), kVertexBytes + kIndexBytes);
  buffers.frame();
  EXPECT_EQ(buffers.bind(mesh(1)).vertices, nullptr);
  EXPECT_EQ(buffers.bytes(), 2 * kVertexBytes + kIndexBytes);
  buffers.clear();
}

TEST_F(TerrainBuffersTest, AMeshLargerThanTheQuotaIsUploadedAlone) {
  TerrainBuffers buffers(1);
  buffers.frame();
  EXPECT_EQ(buffers.bind(mesh(0)).vertices, nullptr);
  EXPECT_NE(buffers.bind(mesh(1)).vertices, nullptr);
  buffers.clear();
}

TEST_F(TerrainBuffersTest, ForgottenMeshesAreFreedUnderTheQuotaAndTheIndicesWithTheLastOfThem) {
  TerrainBuffers buffers(2 * kVertexBytes + kIndexBytes);
  for (std::size_t index = 0; index < 4; ++index) {
    buffers.frame();
    buffers.bind(mesh(index));
  }
  for (std::size_t index = 0; index < 3; ++index) buffers.forget(mesh(index));
  buffers.forget(mesh(7));  // never bound
  const std::size_t before = 4 * kVertexBytes + kIndexBytes;
  EXPECT_EQ(buffers.bytes(), before);
  buffers.frame();
  EXPECT_LT(buffers.bytes(), before);
  EXPECT_GE(buffers.bytes(), before - 2 * kVertexBytes - kIndexBytes);
  buffers.frame();
  EXPECT_EQ(buffers.bytes(), kVertexBytes + kIndexBytes);
  buffers.forget(mesh(3));
  buffers.frame();
  EXPECT_EQ(buffers.bytes(), 0U);
}

}  // namespace
}  // namespace teren
