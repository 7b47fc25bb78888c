// Snapshots for tests, of nodes of any levels side by side, watertight by construction, and every triangle of
// a snapshot in exact numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "teren/Scene.h"

#include "patch/MeshTask.h"

namespace teren {

/// A square of the plane: `side` = intervals 2^level samples, its south-west corner at (west, south).
struct PatchworkNode {
  std::int64_t west = 0, south = 0;
  int level = 0;
};

/// Scenes of nodes over a height that is a function of the level-0 sample. A node's inside is a regular mesh;
/// its outermost ring of squares is a bag of triangles with the density of the finer neighbour on every line.
class Patchwork {
 public:
  using Shape = std::function<float(std::int64_t column, std::int64_t row)>;

  Patchwork(int intervals, double spacing, Shape shape)
      : intervals_(intervals), spacing_(spacing), shape_(std::move(shape)) {}

  void add(const PatchworkNode& node) { nodes_.push_back(node); }
  /// Gives every vertex a next coarser surface, and a level: both functions of its place, so that neighbours
  /// agree. `morph` says how they move to it.
  void letMove(Shape coarser, std::function<int(std::int64_t column, std::int64_t row)> level,
               const Morph& morph) {
    coarser_ = std::move(coarser);
    level_ = std::move(level);
    morph_ = morph;
  }
  /// Divides the square of a node at random, down to level 0.
  template <class Dice>
  void addDivided(const PatchworkNode& node, Dice& dice) {
    if (node.level == 0 || dice.whole(0, 3) == 0) return add(node);
    const std::int64_t half = side(node) / 2;
    for (const std::int64_t y : {std::int64_t{0}, half}) {
      for (const std::int64_t x : {std::int64_t{0}, half}) {
        addDivided(PatchworkNode{node.west + x, node.south + y, node.level - 1}, dice);
      }
    }
  }
  /// So many nodes of one level to the east and to the north, joined as an engine joins them: by seams two
  /// squares wide and corner pieces.
  void addEven(const PatchworkNode& southWest, int columns, int rows) {
    const std::int64_t step = std::int64_t{1} << southWest.level;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        for (const Piece piece : {Piece::interior, Piece::eastSeam, Piece::northSeam, Piece::cornerPiece}) {
          const PieceExtent extent = pieceExtent(piece, intervals_);
          if (extent.firstColumn > 1 && column == columns - 1) continue;
          if (extent.firstRow > 1 && row == rows - 1) continue;
          grounds_.push_back(grid(southWest.west + (column * intervals_ + extent.firstColumn) * step,
                                  southWest.south + (row * intervals_ + extent.firstRow) * step,
                                  southWest.level, extent.columns, extent.rows));
        }
      }
    }
  }
  std::int64_t side(const PatchworkNode& node) const { return std::int64_t{intervals_} << node.level; }

  /// Meshes are numbered from `firstId`.
  std::shared_ptr<const Scene> scene(std::uint64_t firstId = 1) {
    std::vector<std::shared_ptr<Mesh>> meshes = grounds_;
    for (const PatchworkNode& node : nodes_) {
      const std::int64_t step = std::int64_t{1} << node.level;
      meshes.push_back(grid(node.west + step, node.south + step, node.level, intervals_ - 2, intervals_ - 2));
      meshes.push_back(ring(node));
    }
    std::vector<std::shared_ptr<const Mesh>> numbered;
    for (const std::shared_ptr<Mesh>& mesh : meshes) {
      mesh->id = firstId++;
      mesh->minHeight = mesh->maxHeight = mesh->vertices.front().height;
      for (const SurfaceVertex& vertex : mesh->vertices) {
        mesh->minHeight = std::min({mesh->minHeight, vertex.height, vertex.coarserHeight});
        mesh->maxHeight = std::max({mesh->maxHeight, vertex.height, vertex.coarserHeight});
      }
      numbered.push_back(mesh);
    }
    return std::make_shared<const Scene>(1, spacing_, std::move(numbered), morph_);
  }

 private:
  std::shared_ptr<Mesh> grid(std::int64_t west, std::int64_t south, int level, int columns, int rows) {
    auto mesh = std::make_shared<Mesh>();
    mesh->level = level;
    mesh->originColumn = west;
    mesh->originRow = south;
    mesh->columns = columns;
    mesh->rows = rows;
    mesh->indices = grids_.get(columns, rows);
    for (int row = 0; row <= rows; ++row) {
      for (int column = 0; column <= columns; ++column) addVertex(*mesh, column, row);
    }
    return mesh;
  }

  std::shared_ptr<Mesh> ring(const PatchworkNode& node) {
    auto mesh = std::make_shared<Mesh>();
    for (const PatchworkNode& other : nodes_) finest_ = std::min(finest_, other.level);
    mesh->level = finest_;
    mesh->originColumn = node.west;
    mesh->originRow = node.south;
    mesh->columns = mesh->rows = static_cast<int>(side(node) >> finest_);
    TriangleIndices indices;
    for (int row = 0; row < intervals_; ++row) {
      for (int column = 0; column < intervals_; ++column) {
        if (column == 0 || row == 0 || column == intervals_ - 1 || row == intervals_ - 1) {
          fan(node, column, row, *mesh, indices);
        }
      }
    }
    mesh->indices = std::make_shared<const TriangleIndices>(std::move(indices));
    return mesh;
  }

  /// One square of the ring: triangles from its innermost corner to every stretch of its outline.
  void fan(const PatchworkNode& node, int column, int row, Mesh& mesh, TriangleIndices& indices) {
    const std::int64_t step = std::int64_t{1} << node.level;
    const std::int64_t x = node.west + column * step, y = node.south + row * step;
    std::vector<std::pair<std::int64_t, std::int64_t>> outline;
    const auto along = [&](std::int64_t fromX, std::int64_t fromY, std::int64_t toX, std::int64_t toY) {
      const std::int64_t dx = (toX > fromX) - (toX < fromX), dy = (toY > fromY) - (toY < fromY);
      while (fromX != toX || fromY != toY) {
        outline.emplace_back(fromX, fromY);
        const std::int64_t stride = strideAt(node, fromX, fromY, dx, dy);
        fromX += dx * stride;
        fromY += dy * stride;
      }
    };
    along(x, y, x + step, y);
    along(x + step, y, x + step, y + step);
    along(x + step, y + step, x, y + step);
    along(x, y + step, x, y);
    const std::pair inner{column == 0 ? x + step : x, row == 0 ? y + step : y};
    const auto number = [&](const std::pair<std::int64_t, std::int64_t>& place) {
      const auto at = static_cast<std::uint32_t>(mesh.vertices.size());
      addVertex(mesh, static_cast<int>((place.first - mesh.originColumn) >> mesh.level),
                static_cast<int>((place.second - mesh.originRow) >> mesh.level));
      return at;
    };
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const auto &a = outline[k], &b = outline[(k + 1) % outline.size()];
      const std::int64_t twice = (a.first - inner.first) * (b.second - inner.second) -
                                 (b.first - inner.first) * (a.second - inner.second);
      if (twice > 0) indices.insert(indices.end(), {number(inner), number(a), number(b)});
    }
  }

  /// To the next vertex on a line from a vertex: the finest of the nodes on both sides of it.
  std::int64_t strideAt(const PatchworkNode& node, std::int64_t x, std::int64_t y, std::int64_t dx,
                        std::int64_t dy) const {
    int level = node.level;
    for (const PatchworkNode& other : nodes_) {
      const auto holds = [&](std::int64_t place, std::int64_t way, std::int64_t low) {
        if (way == 0) return low <= place && place <= low + side(other);
        return way > 0 ? low <= place && place < low + side(other)
                       : low < place && place <= low + side(other);
      };
      if (holds(x, dx, other.west) && holds(y, dy, other.south)) level = std::min(level, other.level);
    }
    return std::int64_t{1} << level;
  }

  void addVertex(Mesh& mesh, int column, int row) const {
    SurfaceVertex vertex;
    vertex.column = static_cast<std::int16_t>(column);
    vertex.row = static_cast<std::int16_t>(row);
    const std::int64_t x = mesh.originColumn + (std::int64_t{column} << mesh.level);
    const std::int64_t y = mesh.originRow + (std::int64_t{row} << mesh.level);
    vertex.height = shape_(x, y);
    vertex.coarserHeight = vertex.height;
    if (level_ && level_(x, y) < SurfaceVertex::kFixed) vertex.setCoarser(level_(x, y), coarser_(x, y), 0, 0);
    mesh.vertices.push_back(vertex);
  }

  int intervals_, finest_ = 64;
  double spacing_;
  Shape shape_, coarser_;
  std::function<int(std::int64_t, std::int64_t)> level_;
  Morph morph_;
  std::vector<PatchworkNode> nodes_;
  std::vector<std::shared_ptr<Mesh>> grounds_;
  GridIndices grids_;
};

/// Corners in level-0 samples and metres of height.
struct SampleTriangle {
  std::array<std::int64_t, 3> column, row;
  std::array<float, 3> height;
};

inline std::vector<SampleTriangle> trianglesOf(const Scene& scene) {
  std::vector<SampleTriangle> triangles;
  for (const auto& mesh : scene.meshes()) {
    for (std::size_t at = 0; at + 2 < mesh->indices->size(); at += 3) {
      SampleTriangle& triangle = triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const SurfaceVertex& vertex = mesh->vertices[(*mesh->indices)[at + k]];
        triangle.column[k] = mesh->originColumn + (std::int64_t{vertex.column} << mesh->level);
        triangle.row[k] = mesh->originRow + (std::int64_t{vertex.row} << mesh->level);
        triangle.height[k] = vertex.height;
      }
    }
  }
  return triangles;
}

}  // namespace teren
