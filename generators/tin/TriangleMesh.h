// The arrays of a triangulation and the ways around in them: 16 bytes a vertex, 24 a triangle, 32-bit
// indices.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "generators/tin/CompactArray.h"
#include "generators/tin/LatticePoint.h"

namespace teren {

using VertexId = std::uint32_t;
using TriangleId = std::uint32_t;
inline constexpr VertexId kNoVertex = 0xffffffffU;
inline constexpr TriangleId kNoTriangle = 0xffffffffU;

/// The corner, or side, after and before i in a triangle, counter-clockwise.
constexpr int following(int i) noexcept {
  return (0x09 >> (2 * i)) & 3;
}
constexpr int preceding(int i) noexcept {
  return (0x12 >> (2 * i)) & 3;
}

/// One side of one triangle, or one corner of it (side i lies opposite corner i), in 32 bits: the triangle, a
/// flag, the side. In a triangle it names the same edge as the neighbour sees it, and the flag says that
/// nothing may be flipped across: a constraint, or the border, beyond which there is no triangle.
class Link {
 public:
  constexpr Link() = default;
  constexpr Link(TriangleId triangle, int side, bool barrier = false) noexcept
      : word_((triangle << 3) | (barrier ? 4U : 0U) | static_cast<std::uint32_t>(side)) {}
  /// Beyond the border.
  static constexpr Link outside() noexcept { return Link(kOutside, 3, true); }

  constexpr TriangleId triangle() const noexcept { return word_ >> 3; }
  constexpr int side() const noexcept { return static_cast<int>(word_ & 3U); }
  constexpr bool isBarrier() const noexcept { return (word_ & 4U) != 0; }
  constexpr bool isOutside() const noexcept { return word_ >= (kOutside << 3); }
  /// The same side, with the flag set or not; where it is outside, unchanged.
  constexpr Link withBarrier(bool barrier) const noexcept {
    return isOutside() ? *this : Link(triangle(), side(), barrier);
  }
  friend constexpr bool operator==(Link, Link) = default;

  /// As many triangles as there can be.
  static constexpr TriangleId kOutside = 0x1fffffffU;

 private:
  std::uint32_t word_ = 0xffffffffU;
};

/// Topology and places, no geometry's decisions: Triangulation makes those. Vertices and triangles keep their
/// ids; those of removed ones are given out again, last removed first. Triangles turn to the left.
class TriangleMesh {
 public:
  struct Triangle {
    std::array<VertexId, 3> vertex{kNoVertex, kNoVertex, kNoVertex};  // the first is kNoVertex in a free one
    std::array<Link, 3> link;  // across the side opposite that vertex; the first chains free triangles
  };

  /// A vertex with an id that is the next above all others, or that of one removed.
  VertexId appendVertex(LatticePoint p) {
    vertices_.push_back({p, Link::outside(), 0});
    return static_cast<VertexId>(vertices_.size() - 1);
  }
  VertexId addVertex(LatticePoint p) {
    if (freeVertex_ == kNoVertex) return appendVertex(p);
    const VertexId v = freeVertex_;
    freeVertex_ = static_cast<VertexId>(vertices_[v].point.x);
    --freeVertices_;
    vertices_[v] = {p, Link::outside(), 0};
    return v;
  }
  void freeVertex(VertexId v) noexcept {
    vertices_[v] = {{static_cast<std::int32_t>(freeVertex_), 0}, Link::outside(), kFree};
    freeVertex_ = v;
    ++freeVertices_;
  }
  TriangleId addTriangle() {
    if (freeTriangle_ == kNoTriangle) {
      assert(triangles_.size() < Link::kOutside);
      triangles_.push_back({});
      return static_cast<TriangleId>(triangles_.size() - 1);
    }
    const TriangleId t = freeTriangle_;
    freeTriangle_ = triangles_[t].vertex[1];
    --freeTriangles_;
    return t;
  }
  void freeTriangle(TriangleId t) noexcept {
    triangles_[t].vertex = {kNoVertex, freeTriangle_, kNoVertex};
    freeTriangle_ = t;
    ++freeTriangles_;
  }
  void reserve(std::size_t vertices, std::size_t triangles) {
    vertices_.reserve(vertices);
    triangles_.reserve(triangles);
  }

  /// Renumbers all triangles so that they lie in memory as their first vertices do; none is free afterwards.
  /// Where ids of vertices follow a space-filling curve, what is near on the plane is then near in memory.
  /// O(n).
  void sortTriangles();

  std::size_t vertexSlots() const noexcept { return vertices_.size(); }
  std::size_t triangleSlots() const noexcept { return triangles_.size(); }
  std::size_t vertexCount() const noexcept { return vertices_.size() - freeVertices_; }
  std::size_t triangleCount() const noexcept { return triangles_.size() - freeTriangles_; }
  std::size_t bytes() const noexcept { return vertices_.bytes() + triangles_.bytes(); }
  bool isVertex(VertexId v) const noexcept {
    return v < vertices_.size() && vertices_[v].constraints != kFree;
  }
  bool isTriangle(TriangleId t) const noexcept {
    return t < triangles_.size() && triangles_[t].vertex[0] != kNoVertex;
  }

  LatticePoint point(VertexId v) const noexcept { return vertices_[v].point; }
  /// A corner of a triangle at v.
  Link star(VertexId v) const noexcept { return vertices_[v].star; }
  void setStar(VertexId v, Link corner) noexcept { vertices_[v].star = corner; }
  /// How many constrained edges end at v.
  std::uint32_t constraints(VertexId v) const noexcept { return vertices_[v].constraints; }
  void changeConstraints(VertexId v, int by) noexcept {
    vertices_[v].constraints += static_cast<std::uint32_t>(by);
  }

  const Triangle& triangle(TriangleId t) const noexcept { return triangles_[t]; }
  Triangle& triangle(TriangleId t) noexcept { return triangles_[t]; }
  VertexId corner(Link at) const noexcept { return triangles_[at.triangle()].vertex[at.side()]; }
  Link across(Link side) const noexcept { return triangles_[side.triangle()].link[side.side()]; }
  /// Makes two sides neighbours; the flag is the second one's. The second may be outside.
  void join(Link one, Link other) noexcept {
    triangles_[one.triangle()].link[one.side()] = other;
    if (!other.isOutside()) {
      triangles_[other.triangle()].link[other.side()] = one.withBarrier(other.isBarrier());
    }
  }

  /// From a corner at a vertex to the next triangle's corner there, counter-clockwise or clockwise.
  Link nextAround(Link at) const noexcept {
    const Link over = triangles_[at.triangle()].link[following(at.side())];
    return over.isOutside() ? over : Link(over.triangle(), following(over.side()));
  }
  Link previousAround(Link at) const noexcept {
    const Link over = triangles_[at.triangle()].link[preceding(at.side())];
    return over.isOutside() ? over : Link(over.triangle(), preceding(over.side()));
  }
  /// The corner from which nextAround() meets every triangle at v: on the border the clockwise last.
  Link firstAround(VertexId v, bool onBorder) const noexcept {
    Link at = vertices_[v].star;
    if (!onBorder) return Link(at.triangle(), at.side());
    for (Link before = previousAround(at); !before.isOutside(); before = previousAround(at)) at = before;
    return Link(at.triangle(), at.side());
  }

 private:
  friend class SandState;  // archives

  static constexpr std::uint32_t kFree = 0xffffffffU;

  struct Vertex {
    LatticePoint point;
    Link star;
    std::uint32_t constraints = 0;
  };
  static_assert(sizeof(Vertex) == 16 && sizeof(Triangle) == 24);

  CompactArray<Vertex> vertices_;
  CompactArray<Triangle> triangles_;
  VertexId freeVertex_ = kNoVertex;
  TriangleId freeTriangle_ = kNoTriangle;
  std::size_t freeVertices_ = 0;
  std::size_t freeTriangles_ = 0;
};

}  // namespace teren
