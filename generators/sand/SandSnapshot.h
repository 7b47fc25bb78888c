// What sand looks like at one moment, for whoever draws it or feels it while the sand goes on.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "generators/sand/PageTable.h"
#include "generators/tin/LatticeFrame.h"
#include "generators/tin/TriangleMesh.h"

namespace teren {

/// One vertex, 20 bytes, laid out for a graphics card.
struct SandVertex {
  LatticePoint place{-1, -1};                // [steps]; x < 0: no vertex is there
  float height = 0.0F;                       // [m]
  float loose = 0.0F;                        // [m] how much of it is loose, >= 0
  std::array<std::int16_t, 2> normal{0, 0};  // its east and north parts times 32767; the rest points up

  bool isThere() const noexcept { return place.x >= 0; }
  friend bool operator==(const SandVertex&, const SandVertex&) = default;
};
static_assert(sizeof(SandVertex) == 20);

/// What lies in a box: bounds of a page's triangles.
struct SandBounds {
  LatticePoint southWest{1, 1}, northEast{0, 0};  // [steps]; as here where it is empty
  float low = 0.0F, high = 0.0F;                  // [m]

  bool isEmpty() const noexcept { return southWest.x > northEast.x; }
  void extendBy(const SandVertex& vertex) noexcept {
    extendBy(SandBounds{vertex.place, vertex.place, vertex.height, vertex.height});
  }
  void extendBy(const SandBounds& other) noexcept;
  friend bool operator==(const SandBounds&, const SandBounds&) = default;
};

struct SandVertexPage {
  static constexpr std::size_t kSlots = 256;
  std::array<SandVertex, kSlots> vertices;
  friend bool operator==(const SandVertexPage&, const SandVertexPage&) = default;
};

struct SandTrianglePage {
  static constexpr std::size_t kSlots = 256;
  static constexpr std::uint8_t kIsThere = 8;
  /// Counter-clockwise; where no triangle is, three times vertex 0, which covers nothing.
  std::array<std::array<VertexId, 3>, kSlots> corners{};
  /// Bit i: the side opposite corner i is constrained; kIsThere, or all bits 0 where no triangle is.
  std::array<std::uint8_t, kSlots> flags{};
  friend bool operator==(const SandTrianglePage&, const SandTrianglePage&) = default;
};

/// The bounds of 64 pages of triangles, and of them all.
struct SandBoundsPage {
  static constexpr std::size_t kSlots = 64;
  std::array<SandBounds, kSlots> pages;
  SandBounds all;
  friend bool operator==(const SandBoundsPage&, const SandBoundsPage&) = default;
};

/// A half-line [m], in the frame's coordinates.
struct SandRay {
  std::array<double, 3> from{0.0, 0.0, 0.0};
  std::array<double, 3> direction{0.0, 0.0, -1.0};  // of any length but 0
};

/// Where a ray meets the surface.
struct SandHit {
  double x = 0.0, y = 0.0, height = 0.0;  // [m]
  double distance = 0.0;                  // [lengths of the ray's direction] >= 0
  TriangleId triangle = kNoTriangle;
};

/// A state of a sand surface, made by SandPublisher. Immutable, so any threads may read it. Successive
/// snapshots share all pages but those where something changed.
///
/// Heights are rounded to float, to 2^-24 of their distance from 0. Normals are means of those of the faces
/// around, weighted by their angle at the vertex (Thuermer and Wuethrich 1998): how an even face is cut into
/// triangles, long or thin, then changes nothing; the angles are within 7e-5 rad.
///
/// Memory: 20 bytes a vertex slot and 13 a triangle slot, 46 a vertex beside about 1 for what finds pages,
/// free slots included. That is beside the Sandbox's own; another snapshot that is kept costs the pages by
/// which it differs: 5 kB and 3 kB each.
class SandSnapshot {
 public:
  const LatticeFrame& frame() const noexcept { return frame_; }
  std::size_t vertexCount() const noexcept { return vertexCount_; }
  std::size_t triangleCount() const noexcept { return triangleCount_; }

  /// Ids are below these, as in the Triangulation; what is in no use says so.
  VertexId vertexSlots() const noexcept { return vertexSlots_; }
  TriangleId triangleSlots() const noexcept { return triangleSlots_; }
  const SandVertex& vertex(VertexId v) const noexcept {
    return vertices_[v / SandVertexPage::kSlots].vertices[v % SandVertexPage::kSlots];
  }
  const std::array<VertexId, 3>& corners(TriangleId t) const noexcept {
    return triangles_[t / SandTrianglePage::kSlots].corners[t % SandTrianglePage::kSlots];
  }
  bool isTriangle(TriangleId t) const noexcept { return flags(t) != 0; }
  /// Whether the side opposite corner i is a constrained edge.
  bool isConstrained(TriangleId t, int i) const noexcept { return ((flags(t) >> i) & 1) != 0; }

  const PageTable<SandVertexPage>& vertexPages() const noexcept { return vertices_; }
  const PageTable<SandTrianglePage>& trianglePages() const noexcept { return triangles_; }
  /// Bounds of a page of triangles; they touch its triangles, no more.
  const SandBounds& bounds(std::size_t trianglePage) const noexcept {
    return bounds_[trianglePage / SandBoundsPage::kSlots].pages[trianglePage % SandBoundsPage::kSlots];
  }
  SandBounds bounds() const noexcept;

  /// Where a ray first meets the surface, from above or below; nothing where it passes by or is no ray (a
  /// number is not finite, the direction is 0). No ray slips through between two triangles. Looks into the
  /// pages whose bounds the ray meets: about O(sqrt(n)) in a mesh whose ids follow a curve through space.
  std::optional<SandHit> hit(const SandRay& ray) const;

  /// Every byte held, what is shared with others as well.
  std::size_t bytes() const noexcept;

 private:
  friend class SandPublisher;
  std::uint8_t flags(TriangleId t) const noexcept {
    return triangles_[t / SandTrianglePage::kSlots].flags[t % SandTrianglePage::kSlots];
  }

  LatticeFrame frame_;
  std::size_t vertexCount_ = 0, triangleCount_ = 0;
  VertexId vertexSlots_ = 0;
  TriangleId triangleSlots_ = 0;
  PageTable<SandVertexPage> vertices_;
  PageTable<SandTrianglePage> triangles_;
  PageTable<SandBoundsPage> bounds_;
};

}  // namespace teren
