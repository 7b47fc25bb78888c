#include "patch/PieceTask.h"

#include <algorithm>
#include <limits>

#include "patch/CoarserSurface.h"

namespace teren {

PieceTask::PieceTask() : mesh_(std::make_shared<Mesh>()) {
  mesh_->minHeight = std::numeric_limits<float>::infinity();
  mesh_->maxHeight = -std::numeric_limits<float>::infinity();
}

void PieceTask::setCoarser(SurfaceVertex& vertex, const HeightMap* coarser, int level, double spacing,
                           int column, int row) noexcept {
  if (coarser == nullptr) {
    vertex.setCoarser(SurfaceVertex::kFixed, vertex.height, vertex.normalX, vertex.normalY);
    return;
  }
  const CoarserSurface::Point point = CoarserSurface(*coarser, spacing).at(column, row);
  vertex.setCoarser(level, point.height, point.normal.x, point.normal.y);
}

void PieceTask::addVertex(const SurfaceVertex& vertex) {
  const auto [low, high] = std::minmax(vertex.height, vertex.coarserHeight);
  mesh_->minHeight = std::min(mesh_->minHeight, low);
  mesh_->maxHeight = std::max(mesh_->maxHeight, high);
  mesh_->vertices.push_back(vertex);
}

}  // namespace teren
