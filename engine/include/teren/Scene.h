// What there is to draw: immutable snapshots of meshes, published by the engine and read by any renderer.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace teren {

/// One vertex of the surface, 20 bytes. `column` and `row` count the mesh's steps from its origin to the east
/// and north; the height [m] is absolute. The unit normal's x and y are stored as round(32767 n); its z is
/// sqrt(1 - x^2 - y^2), always positive.
///
/// `coarserHeight` [m] and the coarser normal are those of the next coarser level's surface there: what the
/// vertex draws near to with distance (Morph.h). A vertex between nodes of several levels is one of the
/// finest, so all meshes that share a vertex have the same of everything but column and row.
struct SurfaceVertex {
  std::int16_t column = 0, row = 0;
  float height = 0.0F;
  std::int16_t normalX = 0, normalY = 0;
  float coarserHeight = 0.0F;
  /// As normalX and normalY, but that the last four bits of x are the level of the vertex.
  std::int16_t coarserNormalX = kFixed, coarserNormalY = 0;

  static constexpr int kFixed = 15;  ///< in place of a level: there is no coarser surface
  int level() const noexcept { return coarserNormalX & 15; }
  /// Without the level, right to 8 steps.
  int coarserX() const noexcept { return (coarserNormalX & ~15) + 8; }
  void setCoarser(int level, float itsHeight, std::int16_t x, std::int16_t y) noexcept {
    coarserHeight = itsHeight;
    coarserNormalX = static_cast<std::int16_t>((x & ~15) | (level < kFixed ? level : kFixed));
    coarserNormalY = y;
  }

  friend bool operator==(const SurfaceVertex&, const SurfaceVertex&) = default;
};
static_assert(sizeof(SurfaceVertex) == 20);

/// Triangles as triples of vertex numbers, anticlockwise seen from above.
using TriangleIndices = std::vector<std::uint32_t>;

/// A piece of the surface. Positions are whole numbers: vertex (column, row) lies at level-0 sample
/// (originColumn + column * 2^level, originRow + row * 2^level) of the world, and level-0 samples are
/// World::spacing(0) metres apart. Add them as integers (or as floats below 2^24) relative to a sample near
/// the eye and multiply by the spacing once: then shared vertices of neighbouring meshes come out bit-equal.
struct Mesh {
  std::uint64_t id = 0;  ///< unique within the engine that made it, increasing
  int level = 0;
  std::int64_t originColumn = 0, originRow = 0;
  int columns = 0, rows = 0;                 ///< vertices lie at 0 ... columns and 0 ... rows
  float minHeight = 0.0F, maxHeight = 0.0F;  ///< [m] measured over the vertices, coarser heights too
  int nodeLevel = 0;  ///< of the nodes it joins; between nodes of several levels, of the one it fills
  float bend = 0.0F;  ///< [m] largest second difference of their samples: see drawnError in PixelError.h
  std::vector<SurfaceVertex> vertices;
  std::shared_ptr<const TriangleIndices> indices;  ///< shared by all meshes of the same shape

  std::size_t bytes() const noexcept { return sizeof(Mesh) + vertices.capacity() * sizeof(SurfaceVertex); }
};

/// Everything to draw at one moment: the interiors of nodes, the seams between them and the corner pieces
/// where four meet, together one watertight surface. Immutable, so any thread may read it for as long as it
/// holds it.
class Scene {
 public:
  Scene() = default;
  /// `meshes` sorted by id.
  Scene(std::uint64_t serial, double spacing, std::vector<std::shared_ptr<const Mesh>> meshes)
      : serial_(serial), spacing_(spacing), meshes_(std::move(meshes)) {}

  std::uint64_t serial() const noexcept { return serial_; }  ///< grows with every change
  double spacing() const noexcept { return spacing_; }       ///< [m] between level-0 samples
  std::span<const std::shared_ptr<const Mesh>> meshes() const noexcept { return meshes_; }
  std::size_t triangles() const noexcept;

 private:
  std::uint64_t serial_ = 0;
  double spacing_ = 1.0;
  std::vector<std::shared_ptr<const Mesh>> meshes_;
};

struct SceneDifference {
  std::vector<std::shared_ptr<const Mesh>> added;
  std::vector<std::uint64_t> removed;  ///< ids
};

/// What a renderer that shows `before` has to change to show `after`; any snapshots of one engine, in
/// O(meshes).
SceneDifference difference(const Scene& before, const Scene& after);

}  // namespace teren
