// Law 2: nodes, seams and corner pieces together are one surface, equal to one monolithic map.
#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Bake.h"
#include "teren/World.h"

#include "height/Surface.h"
#include "patch/MeshTask.h"
#include "patch/NodeTask.h"
#include "stream/JoinTask.h"
#include "stream/NodeStore.h"
#include "tests/engine/world/TestWorld.h"

namespace teren {
namespace {

/// Two layers of maps and one that is a field.
std::shared_ptr<const World> threeLayers(int samples, std::uint64_t seed = 7) {
  WorldDescription description;
  description.seed = seed;
  description.samples = samples;
  for (const double pitch : {8192.0, 512.0, 64.0}) {
    LayerDescription layer;
    layer.generator = "fault";
    layer.parameters = {{"faults", std::int64_t{40}}, {"deviation", pitch / 16.0}};
    layer.pitch = pitch;
    description.layers.push_back(layer);
  }
  description.layers[1].generator = "value-noise";
  description.layers[1].parameters = {{"height", 80.0}, {"cell", 256.0}};
  return makeTestWorld(description);
}

using Place = std::pair<std::int64_t, std::int64_t>;  // column, row in level-0 samples
using Triangle = std::array<Place, 3>;

/// The triangle with its first corner the smallest, so that equal triangles compare equal; orientation is
/// kept.
Triangle normalised(Triangle triangle) {
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  return triangle;
}

/// A block of nodes, drawn one after the other through the engine's own store.
class BlockSurface {
 public:
  BlockSurface(const World& world, int level, std::int64_t i, std::int64_t j, int side)
      : world_(world), store_(world.spacing(0), world.intervals()), maps_(std::size_t{64} << 20) {
    for (int dj = 0; dj < side; ++dj) {
      for (int di = 0; di < side; ++di) add({level, i + di, j + dj});
    }
    scene_ = store_.snapshot();
  }
  const Scene& scene() const { return *scene_; }

 private:
  void add(const NodeKey& key) {
    NodeTask task(world_, key, maps_);
    while (!task.step(Slice::unlimited())) {
    }
    store_.insert(key, std::make_shared<const HeightMap>(task.takeHeights()));
    JoinTask join(store_, {{}, {key}});
    while (!join.step(Slice::unlimited())) {
    }
    EXPECT_TRUE(store_.apply(join.change(), join.pieces()));
  }
  const World& world_;
  NodeStore store_;
  BaseMapStore maps_;
  std::shared_ptr<const Scene> scene_;
};

Place placeOf(const Mesh& mesh, const SurfaceVertex& vertex) {
  const std::int64_t stride = std::int64_t{1} << mesh.level;
  return {mesh.originColumn + vertex.column * stride, mesh.originRow + vertex.row * stride};
}

std::vector<Triangle> trianglesOf(const Scene& scene) {
  std::vector<Triangle> triangles;
  for (const auto& mesh : scene.meshes()) {
    const TriangleIndices& indices = *mesh->indices;
    for (std::size_t k = 0; k < indices.size(); k += 3) {
      Triangle triangle;
      for (std::size_t c = 0; c < 3; ++c) triangle[c] = placeOf(*mesh, mesh->vertices[indices[k + c]]);
      triangles.push_back(normalised(triangle));
    }
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

std::vector<Triangle> monolithicTriangles(std::int64_t column, std::int64_t row, int squares,
                                          std::int64_t stride) {
  std::vector<Triangle> triangles;
  for (int y = 0; y < squares; ++y) {
    for (int x = 0; x < squares; ++x) {
      const auto at = [&](int dx, int dy) {
        return Place{column + (x + dx) * stride, row + (y + dy) * stride};
      };
      triangles.push_back(normalised({at(0, 0), at(1, 0), at(1, 1)}));
      triangles.push_back(normalised({at(0, 0), at(1, 1), at(0, 1)}));
    }
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

struct BlockCase {
  int level;
  std::int64_t i, j;
  int samples;
};

class Watertight : public testing::TestWithParam<BlockCase> {};

constexpr int kSide = 5;

TEST_P(Watertight, FiveByFiveNodesAreTheTrianglesOfOneMonolithicMapWithoutItsRim) {
  const auto [level, i, j, samples] = GetParam();
  const auto world = threeLayers(samples);
  const BlockSurface block(*world, level, i, j, kSide);
  // The outermost ring of squares belongs to seams with nodes outside the block.
  const std::int64_t stride = std::int64_t{1} << level;
  const std::int64_t n = world->intervals();
  const auto expected = monolithicTriangles((i * n + 1) * stride, (j * n + 1) * stride,
                                            static_cast<int>(kSide * n - 2), stride);
  EXPECT_EQ(trianglesOf(block.scene()), expected);
}

TEST_P(Watertight, EveryEdgeIsSharedByExactlyTwoTrianglesButOnTheOuterRim) {
  const auto [level, i, j, samples] = GetParam();
  const auto world = threeLayers(samples);
  const BlockSurface block(*world, level, i, j, kSide);
  std::map<std::pair<Place, Place>, int> uses;  // +1 in one direction, counted apart from the other
  std::map<std::pair<Place, Place>, int> directed;
  for (const Triangle& triangle : trianglesOf(block.scene())) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Place a = triangle[c], b = triangle[(c + 1) % 3];
      ++uses[std::minmax(a, b)];
      ++directed[{a, b}];
    }
  }
  const std::int64_t stride = std::int64_t{1} << level;
  const std::int64_t n = world->intervals();
  const Place low{(i * n + 1) * stride, (j * n + 1) * stride};
  const Place high{((i + kSide) * n - 1) * stride, ((j + kSide) * n - 1) * stride};
  const auto onRim = [&](const Place& a, const Place& b) {
    return (a.first == b.first && (a.first == low.first || a.first == high.first)) ||
           (a.second == b.second && (a.second == low.second || a.second == high.second));
  };
  ASSERT_FALSE(uses.empty());
  for (const auto& [edge, count] : uses) ASSERT_EQ(count, onRim(edge.first, edge.second) ? 1 : 2);
  for (const auto& [edge, count] : directed)
    ASSERT_EQ(count, 1) << "two triangles of opposite orientation overlap";
}

TEST_P(Watertight, PositionsAndNormalsEqualTheMonolithicMapBitForBit) {
  const auto [level, i, j, samples] = GetParam();
  const auto world = threeLayers(samples);
  const BlockSurface block(*world, level, i, j, kSide);
  const std::int64_t patches = std::int64_t{1} << level;
  const auto baked = bake(*world, {i * patches, j * patches, kSide * patches, kSide * patches, level});
  ASSERT_TRUE(baked.ok()) << baked.error().message;
  const std::int64_t n = world->intervals();
  std::map<Place, SurfaceVertex> seen;
  for (const auto& mesh : block.scene().meshes()) {
    for (const SurfaceVertex& vertex : mesh->vertices) {
      const auto [column, row] = placeOf(*mesh, vertex);
      const auto x = static_cast<int>((column >> level) - i * n),
                 y = static_cast<int>((row >> level) - j * n);
      const HeightMap& map = *baked;
      ASSERT_EQ(vertex.height, map(x, y)) << x << ", " << y;
      const PackedNormal normal =
          vertexNormal(map(x - 1, y), map(x + 1, y), map(x, y - 1), map(x, y + 1), world->spacing(level));
      ASSERT_EQ(vertex.normalX, normal.x) << x << ", " << y;
      ASSERT_EQ(vertex.normalY, normal.y) << x << ", " << y;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Blocks, Watertight,
                         testing::Values(BlockCase{0, -2, -3, 65}, BlockCase{2, -2, -3, 65},
                                         BlockCase{2, 0, 0, 65}, BlockCase{4, -1, 5, 33},
                                         BlockCase{0, (std::int64_t{1} << 40) - 2, -(std::int64_t{1} << 40),
                                                   65},
                                         BlockCase{2, std::int64_t{1} << 40, 3, 17}, BlockCase{0, -1, -1, 5},
                                         BlockCase{3, -1, -1, 5}),
                         [](const testing::TestParamInfo<BlockCase>& block) {
                           return "level" + std::to_string(block.param.level) + "samples" +
                                  std::to_string(block.param.samples) + "number" +
                                  std::to_string(block.index);
                         });

TEST(PieceExtent, CoversThePlaneOnceForEverySide) {
  for (const int n : {2, 4, 32}) {
    // Squares of one period: interior, one seam of each direction and one corner piece.
    int squares = 0;
    for (const Piece piece : {Piece::interior, Piece::eastSeam, Piece::northSeam, Piece::cornerPiece}) {
      const PieceExtent extent = pieceExtent(piece, n);
      squares += extent.columns * extent.rows;
    }
    EXPECT_EQ(squares, n * n);
  }
}

TEST(GridIndices, AreSharedByMeshesOfTheSameShapeAndFaceUpwards) {
  GridIndices indices;
  const auto list = indices.get(3, 2);
  EXPECT_EQ(list, indices.get(3, 2));
  EXPECT_NE(list, indices.get(2, 3));
  ASSERT_EQ(list->size(), 36U);
  for (std::size_t k = 0; k < list->size(); k += 3) {
    const auto x = [&](std::size_t c) { return static_cast<int>((*list)[k + c] % 4); };
    const auto y = [&](std::size_t c) { return static_cast<int>((*list)[k + c] / 4); };
    EXPECT_EQ((x(1) - x(0)) * (y(2) - y(0)) - (x(2) - x(0)) * (y(1) - y(0)), 1);
  }
}

}  // namespace
}  // namespace teren
