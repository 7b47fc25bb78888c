#include "generators/sand/Merging.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "generators/sand/Opening.h"

namespace teren {
namespace {

using Corners = std::array<VertexId, 3>;

/// One merging, step by step.
class Merging {
 public:
  Merging(SandSurface& surface, const SandSurface& other) noexcept
      : surface_(surface), other_(other), taken_(other.mesh().vertexSlots(), kNoVertex) {}

  void collect();
  void enterVertices(int column, int row);
  void enterEdges(std::uint32_t ids);
  void forgetPast();
  std::vector<VertexId> taken() && { return std::move(taken_); }

 private:
  void enterEdge(VertexId a, VertexId b, std::uint32_t id) { surface_.enterEdge(taken_[a], taken_[b], id); }

  SandSurface& surface_;
  const SandSurface& other_;
  std::vector<Corners> triangles_;                    // of the other, from their first vertex on
  std::vector<std::pair<VertexId, VertexId>> edges_;  // of these, each once
  std::vector<VertexId> taken_;
};

/// In an order that is that of the vertices alone.
void Merging::collect() {
  const Triangulation& mesh = other_.mesh();
  for (TriangleId t = 0; t < mesh.triangleSlots(); ++t) {
    if (!mesh.isTriangle(t) || !other_.isOpen(t)) continue;
    Corners corners = mesh.corners(t);
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    triangles_.push_back(corners);
    for (int i = 0; i < 3; ++i) edges_.push_back(std::minmax(corners[i], corners[following(i)]));
  }
  std::sort(triangles_.begin(), triangles_.end());
  std::sort(edges_.begin(), edges_.end());
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
}

void Merging::enterVertices(int column, int row) {
  const LatticePoint from = other_.cells().corner(), to = surface_.cells().point(column, row);
  for (const Corners& corners : triangles_) {
    for (const VertexId v : corners) taken_[v] = 0;
  }
  TriangleId near = kNoTriangle;
  for (VertexId v = 0; v < taken_.size(); ++v) {
    if (taken_[v] == kNoVertex) continue;
    const LatticePoint p = other_.mesh().point(v);
    taken_[v] =
        surface_.enter({p.x - from.x + to.x, p.y - from.y + to.y}, other_.height(v), near, other_.loose(v));
    near = surface_.mesh().triangleAt(taken_[v]);
  }
}

/// Within constraints triangles are given by Delaunay's rule but for vertices on one circle.
void Merging::enterEdges(std::uint32_t ids) {
  for (const auto& [a, b] : edges_) {
    const auto id = other_.mesh().constraint(a, b);
    if (id) enterEdge(a, b, *id == Opening::kFenceId ? *id : *id + ids);
  }
  for (const auto& [a, b] : edges_) {
    if (surface_.mesh().isEdge(taken_[a], taken_[b])) continue;
    enterEdge(a, b, Opening::kFenceId);
    surface_.unconstrain(taken_[a], taken_[b]);
  }
}

void Merging::forgetPast() {
  const Triangulation& mesh = surface_.mesh();
  for (const Corners& corners : triangles_) {
    TriangleId same = kNoTriangle;
    mesh.forEachCorner(taken_[corners[0]], [&](Link at) {
      const Corners& here = mesh.corners(at.triangle());
      const bool isSame = here[following(at.side())] == taken_[corners[1]] &&
                          here[preceding(at.side())] == taken_[corners[2]];
      if (isSame) same = at.triangle();
    });
    assert(same != kNoTriangle);
    surface_.turn(same, taken_[corners[0]]);
  }
}

}  // namespace

std::vector<VertexId> mergeSand(SandSurface& surface, const SandSurface& other, int column, int row,
                                std::uint32_t ids) {
  Merging merging(surface, other);
  merging.collect();
  merging.enterVertices(column, row);
  surface.open(other.cells(), column, row);
  merging.enterEdges(ids);
  merging.forgetPast();
  surface.takeAccount(other);
  return std::move(merging).taken();
}

}  // namespace teren
