// What builds a piece of the surface: a task that ends with a mesh.
#pragma once

#include <memory>
#include <utility>

#include "teren/HeightMap.h"
#include "teren/Scene.h"
#include "teren/Slice.h"

namespace teren {

class PieceTask : public SlicedTask {
 public:
  /// Complete, but for its id, once step has returned true.
  std::shared_ptr<Mesh> takeResult() noexcept { return std::move(mesh_); }

 protected:
  PieceTask();
  /// Tells a vertex at a sample of a node with these coarser samples, if it has any, what it draws near to.
  static void setCoarser(SurfaceVertex& vertex, const HeightMap* coarser, int level, double spacing,
                         int column, int row) noexcept;
  /// Adds a vertex and widens the mesh's range of heights.
  void addVertex(const SurfaceVertex& vertex);

  std::shared_ptr<Mesh> mesh_;
};

}  // namespace teren
