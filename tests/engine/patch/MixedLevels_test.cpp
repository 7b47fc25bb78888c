// Law 2 between levels: nodes of any levels side by side are one surface.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"
#include "teren/HeightSampling.h"
#include "teren/SceneQuery.h"

#include "height/Surface.h"
#include "patch/CoarserSurface.h"
#include "stream/JoinTask.h"
#include "stream/NodeStore.h"

namespace teren {
namespace {

using Place = std::pair<std::int64_t, std::int64_t>;  // column, row in level-0 samples

/// A height [m] that depends on a place and a level, and on nothing else in any way one could guess.
float heightAt(int level, std::int64_t column, std::int64_t row, std::uint64_t seed) {
  const std::uint64_t place = hashWith(
      hashWith(hashWith(seed, static_cast<std::uint64_t>(level)), static_cast<std::uint64_t>(column)),
      static_cast<std::uint64_t>(row));
  return static_cast<float>(place >> 40) * 0x1p-14F;
}

/// Heights that no two nodes agree on anywhere, but equals of a level on the line they share; with those of
/// the next coarser level around them.
NodeHeights heightsOf(const NodeKey& key, int intervals, std::uint64_t seed) {
  auto heights = std::make_shared<HeightMap>(intervals + 1, intervals + 1);
  for (int row = 0; row <= intervals; ++row) {
    for (int column = 0; column <= intervals; ++column) {
      (*heights)(column, row) =
          heightAt(key.level, key.i * intervals + column, key.j * intervals + row, seed);
    }
  }
  const int side = CoarserSurface::side(intervals);
  auto coarser = std::make_shared<HeightMap>(side, side);
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      (*coarser)(column, row) =
          heightAt(key.level + 1, key.i * intervals / 2 + column - 1, key.j * intervals / 2 + row - 1, seed);
    }
  }
  return {std::move(heights), std::move(coarser)};
}

/// A square of `side` x `side` nodes of level `top`, split at random down to level 0.
class MixedSurface {
 public:
  MixedSurface(int intervals, int top, int side, std::int64_t i, std::int64_t j, std::uint64_t seed)
      : intervals_(intervals), seed_(seed), random_(seed), store_(1.0, intervals) {
    for (std::int64_t dj = 0; dj < side; ++dj) {
      for (std::int64_t di = 0; di < side; ++di) split({top, i + di, j + dj});
    }
    for (std::size_t left = leaves_.size(); left > 1; --left) {
      std::swap(leaves_[left - 1], leaves_[random_.next() % left]);
    }
  }
  const std::vector<NodeKey>& leaves() const { return leaves_; }
  std::uint64_t seed() const { return seed_; }
  NodeStore& store() { return store_; }
  NodeHeights hold(const NodeKey& key) {
    if (!store_.heights(key)) store_.insert(key, heightsOf(key, intervals_, seed_));
    return store_.heights(key);
  }
  void change(const DrawnChange& change) {
    for (const NodeKey& key : change.add) hold(key);
    JoinTask join(store_, change);
    while (!join.step(Slice::until(Slice::Clock::time_point::min()))) {
    }
    ASSERT_TRUE(store_.apply(join.change(), join.pieces()));
  }
  /// In random order, a few at a time.
  void drawAll() {
    for (std::size_t next = 0; next < leaves_.size();) {
      const std::size_t last = std::min(leaves_.size(), next + 1 + random_.next() % 5);
      change({{},
              {leaves_.begin() + static_cast<std::ptrdiff_t>(next),
               leaves_.begin() + static_cast<std::ptrdiff_t>(last)}});
      next = last;
    }
  }

 private:
  void split(const NodeKey& key) {
    if (key.level == 0 || random_.next() % 3 == 0) {
      leaves_.push_back(key);
      return;
    }
    for (int child = 0; child < 4; ++child)
      split({key.level - 1, key.i * 2 + (child & 1), key.j * 2 + child / 2});
  }

  int intervals_;
  std::uint64_t seed_;
  RandomSequence random_;
  NodeStore store_;
  std::vector<NodeKey> leaves_;
};

Place placeOf(const Mesh& mesh, const SurfaceVertex& vertex) {
  const std::int64_t stride = std::int64_t{1} << mesh.level;
  return {mesh.originColumn + vertex.column * stride, mesh.originRow + vertex.row * stride};
}

template <class Visit>  // visit(the three vertices' places, the mesh)
void forEachTriangle(const Scene& scene, Visit&& visit) {
  for (const auto& mesh : scene.meshes()) {
    for (std::size_t k = 0; k < mesh->indices->size(); k += 3) {
      std::array<Place, 3> places;
      for (std::size_t c = 0; c < 3; ++c) places[c] = placeOf(*mesh, mesh->vertices[(*mesh->indices)[k + c]]);
      visit(places, *mesh);
    }
  }
}

std::int64_t twiceArea(const std::array<Place, 3>& t) {
  return (t[1].first - t[0].first) * (t[2].second - t[0].second) -
         (t[2].first - t[0].first) * (t[1].second - t[0].second);
}

/// The ground on the inner side of whatever nothing is drawn beyond, counted node by node: all squares of all
/// nodes, but of those in a ring the ones at a side, or at a corner, where nothing lies across.
std::int64_t expectedArea(const std::vector<NodeKey>& leaves, int intervals, std::int64_t low,
                          std::int64_t high, std::int64_t south, std::int64_t north) {
  std::int64_t area = 0;
  for (const NodeKey& key : leaves) {
    const std::int64_t step = std::int64_t{1} << key.level, side = intervals * step;
    const std::int64_t x = key.i * side, y = key.j * side;
    for (std::int64_t row = 0; row < intervals; ++row) {
      for (std::int64_t column = 0; column < intervals; ++column) {
        const bool atRim = (x + column * step == low) || (x + (column + 1) * step == high) ||
                           (y + row * step == south) || (y + (row + 1) * step == north);
        if (!atRim) area += step * step;
      }
    }
  }
  return area;
}

struct MixCase {
  int intervals, top, side;
  std::int64_t i, j;
};

class MixedLevels : public testing::TestWithParam<MixCase> {
 protected:
  static constexpr int kMixes = 12;
  template <class Check>
  void forEachMix(Check&& check) {
    const auto [intervals, top, side, i, j] = GetParam();
    for (std::uint64_t seed = 1; seed <= kMixes; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      MixedSurface surface(intervals, top, side, i, j, seed);
      surface.drawAll();
      check(surface);
      if (HasFatalFailure()) return;
    }
  }
};

TEST_P(MixedLevels, EveryEdgeIsSharedByTwoTrianglesButOnTheRimAndNoneIsDegenerateOrTurnedOver) {
  const auto [intervals, top, side, i, j] = GetParam();
  const std::int64_t length = std::int64_t{intervals} << top;
  const Place low{i * length, j * length}, high{(i + side) * length, (j + side) * length};
  forEachMix([&](MixedSurface& surface) {
    std::map<std::pair<Place, Place>, int> directed;
    std::int64_t area = 0;
    forEachTriangle(*surface.store().snapshot(), [&](const std::array<Place, 3>& places, const Mesh&) {
      ASSERT_GT(twiceArea(places), 0);
      area += twiceArea(places);
      for (std::size_t c = 0; c < 3; ++c) ++directed[{places[c], places[(c + 1) % 3]}];
    });
    ASSERT_EQ(area,
              2 * expectedArea(surface.leaves(), intervals, low.first, high.first, low.second, high.second));
    // A rim edge belongs to a square that touches the region's end: none is farther from it than a step.
    const std::int64_t most = std::int64_t{1} << top;
    const auto nearRim = [&](const Place& place) {
      return place.first <= low.first + most || place.second <= low.second + most ||
             place.first >= high.first - most || place.second >= high.second - most;
    };
    for (const auto& [edge, count] : directed) {
      ASSERT_EQ(count, 1) << "two triangles on one side of an edge";
      if (directed.contains({edge.second, edge.first})) continue;
      ASSERT_TRUE(nearRim(edge.first) && nearRim(edge.second))
          << "an open edge from (" << edge.first.first << ", " << edge.first.second << ") to ("
          << edge.second.first << ", " << edge.second.second << ")";
    }
  });
}

TEST_P(MixedLevels, SharedVerticesAreEqualBitForBitAndStoredInTheFinestNodeThere) {
  const int intervals = GetParam().intervals;
  forEachMix([&](MixedSurface& surface) {
    std::map<Place, SurfaceVertex> seen;
    std::map<Place, float> finest;
    for (int level = GetParam().top; level >= 0; --level) {
      for (const NodeKey& key : surface.leaves()) {
        if (key.level != level) continue;
        const NodeHeights heights = surface.hold(key);
        for (int row = 0; row <= intervals; ++row) {
          for (int column = 0; column <= intervals; ++column) {
            const Place place{(key.i * intervals + column) << level, (key.j * intervals + row) << level};
            finest.insert_or_assign(place, (*heights)(column, row));
          }
        }
      }
    }
    const auto scene = surface.store().snapshot();
    for (const auto& mesh : scene->meshes()) {
      for (SurfaceVertex vertex : mesh->vertices) {
        const Place place = placeOf(*mesh, vertex);
        ASSERT_EQ(vertex.height, finest.at(place));
        vertex.column = vertex.row = 0;
        const auto [before, isNew] = seen.emplace(place, vertex);
        ASSERT_TRUE(isNew || before->second == vertex) << place.first << ", " << place.second;
      }
    }
  });
}

TEST_P(MixedLevels, EveryVertexDrawsNearToTheNextCoarserSurfaceOfTheFinestNodeThere) {
  const int intervals = GetParam().intervals;
  forEachMix([&](MixedSurface& surface) {
    struct Target {
      int level;
      double height;
    };
    std::map<Place, Target> finest;
    for (int level = GetParam().top; level >= 0; --level) {
      for (const NodeKey& key : surface.leaves()) {
        if (key.level != level) continue;
        const NodeKey above = key.parent();
        const NodeHeights heights = heightsOf(above, intervals, surface.seed());
        const auto west = static_cast<double>((key.i - 2 * above.i) * intervals);
        const auto south = static_cast<double>((key.j - 2 * above.j) * intervals);
        for (int row = 0; row <= intervals; ++row) {
          for (int column = 0; column <= intervals; ++column) {
            const Place place{(key.i * intervals + column) << level, (key.j * intervals + row) << level};
            finest.insert_or_assign(place, Target{level, triangleHeight(heights->view(), (west + column) / 2,
                                                                        (south + row) / 2)});
          }
        }
      }
    }
    const auto scene = surface.store().snapshot();
    for (const auto& mesh : scene->meshes()) {
      for (const SurfaceVertex& vertex : mesh->vertices) {
        const Target& target = finest.at(placeOf(*mesh, vertex));
        ASSERT_EQ(vertex.level(), target.level);
        ASSERT_NEAR(vertex.coarserHeight, target.height, 1e-4);
        ASSERT_GE(vertex.coarserHeight, mesh->minHeight);
        ASSERT_LE(vertex.coarserHeight, mesh->maxHeight);
      }
    }
  });
}

TEST_P(MixedLevels, TheDrawnHeightIsThatOfTheTriangleOverThePlace) {
  const int intervals = GetParam().intervals;
  forEachMix([&](MixedSurface& surface) {
    const auto scene = surface.store().snapshot();
    const SceneQuery query(scene, intervals);
    for (const auto& mesh : scene->meshes()) {
      const TriangleIndices& indices = *mesh->indices;
      for (std::size_t k = 0; k < indices.size(); k += 3 * (1 + k / 24)) {
        double x = 0.0, y = 0.0, height = 0.0;  // of the middle
        for (std::size_t c = 0; c < 3; ++c) {
          const SurfaceVertex& vertex = mesh->vertices[indices[k + c]];
          const auto [column, row] = placeOf(*mesh, vertex);
          x += static_cast<double>(column) / 3.0;
          y += static_cast<double>(row) / 3.0;
          height += static_cast<double>(vertex.height) / 3.0;
        }
        const double i = std::floor(x / intervals), j = std::floor(y / intervals);
        const Position place{static_cast<std::int64_t>(i), static_cast<std::int64_t>(j), x / intervals - i,
                             y / intervals - j};
        DrawnPoint drawn;
        query.points({&place, 1}, {&drawn, 1});
        ASSERT_TRUE(drawn.there);
        ASSERT_NEAR(drawn.height, height, 1e-3) << x << ", " << y;
      }
    }
  });
}

TEST_P(MixedLevels, TheOrderInWhichNodesCameAndWhatWasThereBeforeLeaveNoTrace) {
  forEachMix([&](MixedSurface& surface) {
    const auto [intervals, top, side, i, j] = GetParam();
    NodeStore& store = surface.store();
    const auto content = [&] {
      std::map<std::pair<Place, int>, std::vector<SurfaceVertex>> meshes;
      const auto scene = store.snapshot();
      for (const auto& mesh : scene->meshes()) {
        auto& vertices = meshes[{{mesh->originColumn, mesh->originRow}, mesh->columns * 1000 + mesh->level}];
        vertices.insert(vertices.end(), mesh->vertices.begin(), mesh->vertices.end());
      }
      return meshes;
    };
    const auto before = content();
    const std::size_t bytes = store.meshBytes();
    for (std::int64_t dj = 0; dj < side; ++dj) {
      for (std::int64_t di = 0; di < side; ++di) {
        const NodeKey whole{top, i + di, j + dj};
        const std::vector<NodeKey> parts = store.drawnIn(whole);
        if (parts.size() == 1) continue;
        surface.change({parts, {whole}});
        ASSERT_EQ(store.drawnIn(whole), std::vector{whole});
        surface.change({{whole}, parts});
      }
    }
    ASSERT_EQ(store.meshBytes(), bytes);
    ASSERT_EQ(content(), before);
  });
}

INSTANTIATE_TEST_SUITE_P(Mixes, MixedLevels,
                         testing::Values(MixCase{8, 3, 3, -1, -1}, MixCase{2, 4, 3, -2, 5},
                                         MixCase{4, 4, 2, 1 << 20, -1}, MixCase{32, 2, 2, 0, -2},
                                         MixCase{2, 1, 4, -2, -2}),
                         [](const testing::TestParamInfo<MixCase>& mix) {
                           return "intervals" + std::to_string(mix.param.intervals) + "levels" +
                                  std::to_string(mix.param.top + 1);
                         });

TEST(CoarserSurface, AtACoarserSampleIsTheVertexThatNodesOfThatLevelHaveThere) {
  constexpr int kIntervals = 8;
  constexpr std::uint64_t kSeed = 3;
  const auto drawn = [&](int level, std::int64_t side) {
    NodeStore store(0.5, kIntervals, true);
    DrawnChange change;
    for (std::int64_t j = 0; j < side; ++j) {
      for (std::int64_t i = 0; i < side; ++i) {
        store.insert(change.add.emplace_back(NodeKey{level, i, j}),
                     heightsOf({level, i, j}, kIntervals, kSeed));
      }
    }
    JoinTask join(store, change);
    while (!join.step(Slice::unlimited())) {
    }
    EXPECT_TRUE(store.apply(join.change(), join.pieces()));
    std::map<Place, SurfaceVertex> vertices;
    const auto scene = store.snapshot();
    for (const auto& mesh : scene->meshes()) {
      for (const SurfaceVertex& vertex : mesh->vertices) vertices.emplace(placeOf(*mesh, vertex), vertex);
    }
    return vertices;
  };
  const std::map<Place, SurfaceVertex> fine = drawn(0, 6), coarse = drawn(1, 3);
  int compared = 0, between = 0;
  for (const auto& [place, vertex] : fine) {
    const auto [column, row] = place;
    const bool alongX = column % 2 != 0, alongY = row % 2 != 0;
    const auto a = coarse.find({column - alongX, row - alongY}),
               b = coarse.find({column + alongX, row + alongY});
    if (a == coarse.end() || b == coarse.end()) continue;
    ++(alongX || alongY ? between : compared);
    const auto middle = [](int x, int y) { return (x + y) / 2.0; };
    EXPECT_EQ(vertex.coarserHeight, 0.5F * (a->second.height + b->second.height));
    EXPECT_NEAR(vertex.coarserX(), middle(a->second.normalX, b->second.normalX), 8.5);
    EXPECT_NEAR(vertex.coarserNormalY, middle(a->second.normalY, b->second.normalY), 0.5);
    EXPECT_EQ(vertex.level(), 0);
  }
  EXPECT_GT(compared, 400);
  EXPECT_GT(between, 1200);
}

/// A node of one level among nodes of another, by heights given as a function of the level-0 sample.
template <class Shape>
NodeHeights shaped(const NodeKey& key, int intervals, Shape&& shape) {
  auto heights = std::make_shared<HeightMap>(intervals + 1, intervals + 1);
  for (int row = 0; row <= intervals; ++row) {
    for (int column = 0; column <= intervals; ++column) {
      (*heights)(column, row) = static_cast<float>(
          shape((key.i * intervals + column) << key.level, (key.j * intervals + row) << key.level));
    }
  }
  return heights;
}

TEST(Border, OfAPlaneIsThePlaneWithItsNormalEverywhere) {
  constexpr int kIntervals = 8;
  const auto plane = [](std::int64_t x, std::int64_t y) { return 0.25 * static_cast<double>(x - 2 * y); };
  std::vector<HeldNode> nodes;
  for (const NodeKey& key : {NodeKey{2, 0, 0},
                             {0, 4, 0},
                             {0, 4, 1},
                             {1, 2, 1},
                             {2, 0, 1},
                             {1, 2, 2},
                             {2, -1, 1},
                             {1, -1, 0},
                             {1, -1, 1},
                             {3, 0, -1},
                             {2, -1, -1}}) {
    nodes.push_back({key, shaped(key, kIntervals, plane)});
  }
  BorderTask task(nodes, 1.0);
  while (!task.step(Slice::unlimited())) {
  }
  const auto mesh = task.takeResult();
  const PackedNormal normal = normalOfFalls(-0.5, 1.0, 1.0);
  ASSERT_FALSE(mesh->vertices.empty());
  for (const SurfaceVertex& vertex : mesh->vertices) {
    EXPECT_EQ(vertex.height, static_cast<float>(plane(vertex.column, vertex.row)));
    EXPECT_EQ((PackedNormal{vertex.normalX, vertex.normalY}), normal);
  }
}

TEST(Border, HasTheFinerSidesPointsAndTheCoarserSidesNormalsOnTheLine) {
  constexpr int kIntervals = 8;
  // The coarse side falls to the east by a half; the fine one has a ripple that its samples alone see.
  const NodeKey coarse{2, 0, 0};
  const auto slope = [](std::int64_t x, std::int64_t) { return -0.5 * static_cast<double>(x); };
  const auto ripple = [](std::int64_t x, std::int64_t y) {
    return -0.5 * static_cast<double>(x) + ((x + y) % 2 != 0 ? 0.25 : 0.0);
  };
  std::vector<HeldNode> nodes{{coarse, shaped(coarse, kIntervals, slope)}};
  for (std::int64_t j = 0; j < 4; ++j) {
    nodes.push_back({{0, 4, j}, shaped({0, 4, j}, kIntervals, ripple)});
  }
  BorderTask task(nodes, 1.0);
  while (!task.step(Slice::unlimited())) {
  }
  const auto mesh = task.takeResult();
  int onLine = 0;
  for (const SurfaceVertex& vertex : mesh->vertices) {
    if (vertex.column != 32) continue;
    ++onLine;
    EXPECT_EQ(vertex.height, static_cast<float>(ripple(32, vertex.row)));
    if (vertex.row % 4 != 0) continue;
    EXPECT_EQ((PackedNormal{vertex.normalX, vertex.normalY}), normalOfFalls(4.0, 0.0, 4.0)) << vertex.row;
  }
  EXPECT_EQ(onLine, 25);  // from 4 to 28: what lies beyond the corners is not there
  EXPECT_EQ(mostLevelDifference(kIntervals), 11);
}

}  // namespace
}  // namespace teren
