#include "patch/PieceTask.h"

#include <algorithm>
#include <limits>

namespace teren {

PieceTask::PieceTask() : mesh_(std::make_shared<Mesh>()) {
  mesh_->minHeight = std::numeric_limits<float>::infinity();
  mesh_->maxHeight = -std::numeric_limits<float>::infinity();
}

void PieceTask::addVertex(const SurfaceVertex& vertex) {
  mesh_->minHeight = std::min(mesh_->minHeight, vertex.height);
  mesh_->maxHeight = std::max(mesh_->maxHeight, vertex.height);
  mesh_->vertices.push_back(vertex);
}

}  // namespace teren
