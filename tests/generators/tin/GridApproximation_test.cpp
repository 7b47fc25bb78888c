#include "generators/tin/GridApproximation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "generators/numbers/RandomNumber.h"

namespace teren {
namespace {

LatticeFrame frameOf(int columns, int rows, std::int32_t stride) {
  return {.step = 0.5, .width = (columns - 1) * stride, .height = (rows - 1) * stride};
}

/// Hills of several sizes and noise, in [-1.5, 1.5].
HeightMap hills(int columns, int rows, std::uint64_t seed) {
  RandomSequence random(seed);
  HeightMap map(columns, rows);
  for (int n = 0; n < 30; ++n) {
    const double x = columns * uniform(random.next()), y = rows * uniform(random.next());
    const double radius = 2.0 + 20.0 * uniform(random.next()),
                 top = radius / 20.0 * uniformAroundZero(random.next());
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) {
        const double distance = ((c - x) * (c - x) + (r - y) * (r - y)) / (radius * radius);
        map(c, r) += static_cast<float>(top / (1.0 + distance * distance));
      }
    }
  }
  return map;
}

/// The largest vertical distance, the slow and independent way: each triangle asks each sample whether it
/// holds it.
double worstByTriangles(const Triangulation& mesh, ConstHeightView grid, std::int32_t stride) {
  std::vector<double> distance(static_cast<std::size_t>(grid.columns()) * grid.rows(), HUGE_VAL);
  for (TriangleId t = 0; t < mesh.triangleSlots(); ++t) {
    if (!mesh.isTriangle(t)) continue;
    const auto& [a, b, c] = mesh.corners(t);
    const LatticePoint p = mesh.point(a), q = mesh.point(b), r = mesh.point(c);
    for (int y = 0; y < grid.rows(); ++y) {
      for (int x = 0; x < grid.columns(); ++x) {
        const LatticePoint s{x * stride, y * stride};
        const auto u = static_cast<long double>(orientation(q, r, s));
        const auto v = static_cast<long double>(orientation(r, p, s));
        const auto w = static_cast<long double>(orientation(p, q, s));
        if (u < 0 || v < 0 || w < 0) continue;
        const long double height =
            (u * mesh.height(a) + v * mesh.height(b) + w * mesh.height(c)) / (u + v + w);
        distance[static_cast<std::size_t>(y) * grid.columns() + x] =
            static_cast<double>(std::fabs(grid(x, y) - height));
      }
    }
  }
  return *std::max_element(distance.begin(), distance.end());
}

TEST(GridApproximation, KeepsItsPromiseAtEverySample) {
  const HeightMap maps[] = {hills(65, 65, 1), hills(33, 47, 2), hills(2, 129, 3), hills(50, 2, 4),
                            hills(2, 2, 5)};
  for (const HeightMap& map : maps) {
    for (const std::int32_t stride : {1, 1024}) {
      for (const double error : {0.3, 0.05, 0.01, 1e-3, 1e-9}) {
        const Result<Triangulation> mesh =
            approximateGrid(map.view(), frameOf(map.columns(), map.rows(), stride), error);
        ASSERT_TRUE(mesh.ok()) << mesh.error().message;
        ASSERT_TRUE(mesh->validate().ok());
        EXPECT_LE(worstErrorAtSamples(*mesh, map.view()), error);
        EXPECT_LE(worstByTriangles(*mesh, map.view(), stride), error);
      }
    }
  }
}

TEST(GridApproximation, NoErrorAtAllIsAPromiseUpToRounding) {
  const HeightMap map = hills(40, 30, 6);
  const Result<Triangulation> mesh = approximateGrid(map.view(), frameOf(40, 30, 4), 0.0);
  ASSERT_TRUE(mesh.ok());
  EXPECT_LE(worstByTriangles(*mesh, map.view(), 4), 0x1p-48 * 1.5);
}

TEST(GridApproximation, APlaneTakesTwoTriangles) {
  HeightMap map(129, 65);
  for (int y = 0; y < 65; ++y) {
    for (int x = 0; x < 129; ++x) map(x, y) = static_cast<float>(3 * x - 5 * y + 1000);
  }
  for (const double error : {1.0, 0.0}) {
    const Result<Triangulation> mesh = approximateGrid(map.view(), frameOf(129, 65, 2), error);
    ASSERT_TRUE(mesh.ok());
    EXPECT_EQ(mesh->triangleCount(), 2U);
  }
}

TEST(GridApproximation, ASmallerErrorTakesMoreTrianglesAndFarFewerThanTheGrid) {
  const HeightMap map = hills(257, 257, 8);
  std::size_t before = 2;
  for (const double error : {0.3, 0.1, 0.03, 0.01, 0.003}) {
    const Result<Triangulation> mesh = approximateGrid(map.view(), frameOf(257, 257, 1), error);
    ASSERT_TRUE(mesh.ok());
    EXPECT_GT(mesh->triangleCount(), before);
    before = mesh->triangleCount();
  }
  EXPECT_LT(before, 2U * 256 * 256 / 10);
}

TEST(GridApproximation, TheGridComesBackWithinThePromiseAndExactlyAtVertices) {
  const HeightMap map = hills(65, 65, 7);
  const Result<Triangulation> mesh = approximateGrid(map.view(), frameOf(65, 65, 16), 0.02);
  ASSERT_TRUE(mesh.ok());
  HeightMap back(65, 65);
  sampleGrid(*mesh, back.view());
  float worst = 0.0f;
  for (int y = 0; y < 65; ++y) {
    for (int x = 0; x < 65; ++x) {
      worst = std::max(worst, std::fabs(back(x, y) - map(x, y)));
      if (mesh->vertexAt({16 * x, 16 * y}) != kNoVertex) {
        EXPECT_EQ(back(x, y), map(x, y));
      }
    }
  }
  EXPECT_LE(worst, 0.02f);
  EXPECT_GT(worst, 0.01f);
  HeightMap finer(129, 129);  // between the samples, too
  sampleGrid(*mesh, finer.view());
  EXPECT_EQ(finer(128, 64), back(64, 32));
}

TEST(GridApproximation, TakesAllOfTheBorderWhereNeighboursAreToMeetIt) {
  for (const auto& [columns, rows] : {std::pair{65, 33}, {2, 9}, {9, 2}, {2, 2}}) {
    const HeightMap map = hills(columns, rows, 9);
    for (const double error : {10.0, 0.05}) {
      const Result<Triangulation> mesh =
          approximateGrid(map.view(), frameOf(columns, rows, 16), error, GridBorder::all);
      ASSERT_TRUE(mesh.ok());
      ASSERT_TRUE(mesh->validate().ok());
      EXPECT_LE(worstErrorAtSamples(*mesh, map.view()), error);
      for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
          const bool onBorder = x == 0 || y == 0 || x == columns - 1 || y == rows - 1;
          const VertexId vertex = mesh->vertexAt({16 * x, 16 * y});
          if (onBorder) {
            ASSERT_NE(vertex, kNoVertex) << x << ", " << y;
          }
          if (vertex != kNoVertex) {
            EXPECT_EQ(static_cast<float>(mesh->height(vertex)), map(x, y));
          }
        }
      }
      const auto border = static_cast<std::size_t>(2 * (columns + rows) - 4);
      if (error > 1.0) {
        EXPECT_EQ(mesh->vertexCount(), border) << "and no more than is needed within";
      }
    }
  }
}

TEST(GridApproximation, RefusesWhatItCannotApproximate) {
  HeightMap map(5, 5);
  EXPECT_FALSE(approximateGrid(map.view(), frameOf(5, 5, 3), 0.1).ok());
  EXPECT_FALSE(approximateGrid(map.view(), frameOf(5, 4, 1), 0.1).ok());
  EXPECT_FALSE(approximateGrid(map.view().part(0, 0, 1, 5), frameOf(5, 5, 1), 0.1).ok());
  EXPECT_FALSE(approximateGrid(map.view(), frameOf(5, 5, 1), -0.1).ok());
  EXPECT_FALSE(approximateGrid(map.view(), frameOf(5, 5, 1), std::nan("")).ok());
  map(3, 2) = std::numeric_limits<float>::infinity();
  EXPECT_EQ(approximateGrid(map.view(), frameOf(5, 5, 1), 0.1).error().message,
            "the height of sample (3, 2) is not finite");
}

}  // namespace
}  // namespace teren
