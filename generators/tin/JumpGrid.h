// Where to begin a search for a point: one vertex near it, from a coarse grid of cells.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "generators/tin/LatticePoint.h"
#include "generators/tin/TriangleMesh.h"

namespace teren {

/// A square grid of cells over a box, or over a window of it where the vertices are, each holding one vertex
/// that was seen in it or near it, or none; places beyond belong to the nearest cell. With one to four
/// vertices a cell a search that starts there passes a handful of triangles. 1 to 4 bytes a vertex. A vertex
/// held may be gone by now, or live elsewhere under its id: so whoever asks says which ids are in use, and
/// takes the answer as a hint.
class JumpGrid {
 public:
  JumpGrid(LatticePoint corner, std::int32_t width, std::int32_t height) noexcept
      : corner_(corner), width_(width), height_(height) {}

  /// A vertex near p for which isInUse(vertex) holds, or kNoVertex: the one of p's cell, else of the nearest
  /// of a few cells to the four sides at doubling distances.
  template <class IsInUse>
  VertexId near(LatticePoint place, IsInUse&& isInUse) const noexcept {
    if (cells_.size() == 0) return kNoVertex;
    const LatticePoint p = inWindow(place);
    if (const VertexId v = cells_[cell(p)]; isInUse(v)) return v;
    for (std::int64_t step = std::int64_t{1} << shift_; step < width_ + std::int64_t{height_}; step *= 2) {
      for (const auto& [x, y] :
           {std::pair(p.x + step, std::int64_t{p.y}), std::pair(p.x - step, std::int64_t{p.y}),
            std::pair(std::int64_t{p.x}, p.y + step), std::pair(std::int64_t{p.x}, p.y - step)}) {
        if (x < 0 || y < 0 || x > width_ || y > height_) continue;
        const VertexId v = cells_[cell({static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)})];
        if (isInUse(v)) return v;
      }
    }
    return kNoVertex;
  }
  void add(LatticePoint p, VertexId v) noexcept {
    if (cells_.size() != 0) cells_[cell(inWindow(p))] = v;
  }
  /// v, at p, is about to go; the other one, next to it, stays.
  void replace(LatticePoint p, VertexId v, VertexId other) noexcept {
    if (cells_.size() != 0 && cells_[cell(inWindow(p))] == v) cells_[cell(inWindow(p))] = other;
  }
  /// True when cells are too few for so many vertices: then rebuild, and add() every vertex.
  bool isCoarseFor(std::size_t vertices) const noexcept { return vertices > 4 * cells_.size(); }
  void rebuildFor(std::size_t vertices);
  std::size_t bytes() const noexcept { return cells_.bytes(); }

 private:
  friend class SandState;  // archives

  /// From the window's corner on.
  LatticePoint inWindow(LatticePoint p) const noexcept {
    return {std::clamp(p.x - corner_.x, 0, width_), std::clamp(p.y - corner_.y, 0, height_)};
  }
  std::size_t cell(LatticePoint p) const noexcept {
    return static_cast<std::size_t>(p.y >> shift_) * columns_ + static_cast<std::size_t>(p.x >> shift_);
  }

  LatticePoint corner_;
  std::int32_t width_;
  std::int32_t height_;
  int shift_ = 0;  // a cell's side is 2^shift
  std::size_t columns_ = 0;
  CompactArray<VertexId> cells_;
};

}  // namespace teren
