// What there is to draw: immutable snapshots of meshes, published by the engine and read by any renderer.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "teren/MeshList.h"
#include "teren/Morph.h"
#include "teren/SurfaceVertex.h"

namespace teren {

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
  int nodeLevel = 0;   ///< of the nodes it joins; between nodes of several levels, of the one it fills
  float bend = 0.0F;   ///< [m] largest second difference of their samples: see drawnError in PixelError.h
  float moved = 0.0F;  ///< [m] what edits add to their error (GroundEdits::moved); 0 at level 0
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
  Scene(std::uint64_t serial, double spacing, MeshList meshes, const Morph& morph = {})
      : serial_(serial), spacing_(spacing), meshes_(std::move(meshes)), morph_(morph) {}

  std::uint64_t serial() const noexcept { return serial_; }    ///< grows with every change of the meshes
  double spacing() const noexcept { return spacing_; }         ///< [m] between level-0 samples
  const MeshList& meshes() const noexcept { return meshes_; }  ///< in the order of their ids
  std::size_t triangles() const noexcept;
  /// How the vertices move with distance: not at all but where detail goes by error.
  const Morph& morph() const noexcept { return morph_; }

 private:
  std::uint64_t serial_ = 0;
  double spacing_ = 1.0;
  MeshList meshes_;
  Morph morph_;
};

struct SceneDifference {
  std::vector<std::shared_ptr<const Mesh>> added;  ///< by their ids, like the next
  std::vector<std::uint64_t> removed;              ///< ids
};

/// What a renderer that shows `before` has to change to show `after`; any snapshots of one engine. Costs what
/// has changed and O(pages) between successive ones (MeshList), O(meshes) at most.
SceneDifference difference(const Scene& before, const Scene& after);

}  // namespace teren
