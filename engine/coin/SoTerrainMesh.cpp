#include "coin/SoTerrainMesh.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include <Inventor/SbBox3f.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/actions/SoGetPrimitiveCountAction.h>

SO_NODE_SOURCE(SoTerrainMesh)

void SoTerrainMesh::initClass() {
  if (getClassTypeId() != SoType::badType()) return;
  SO_NODE_INIT_CLASS(SoTerrainMesh, SoShape, "Shape");
}

SoTerrainMesh::SoTerrainMesh() {
  SO_NODE_CONSTRUCTOR(SoTerrainMesh);
}

SoTerrainMesh::SoTerrainMesh(std::shared_ptr<const teren::Mesh> mesh, double spacing) : SoTerrainMesh() {
  mesh_ = std::move(mesh);
  step_ = static_cast<float>(spacing * static_cast<double>(std::int64_t{1} << mesh_->level));
}

SoTerrainMesh::~SoTerrainMesh() = default;

void SoTerrainMesh::getPrimitiveCount(SoGetPrimitiveCountAction* action) {
  if (mesh_ && shouldPrimitiveCount(action)) {
    action->addNumTriangles(static_cast<int>(mesh_->indices->size() / 3));
  }
}

void SoTerrainMesh::computeBBox(SoAction* /*action*/, SbBox3f& box, SbVec3f& center) {
  box.makeEmpty();
  if (!mesh_) return;
  box.setBounds(0.0F, 0.0F, mesh_->minHeight, step_ * static_cast<float>(mesh_->columns),
                step_ * static_cast<float>(mesh_->rows), mesh_->maxHeight);
  center = box.getCenter();
}

void SoTerrainMesh::generatePrimitives(SoAction* action) {
  if (!mesh_) return;
  SoPrimitiveVertex corner;
  beginShape(action, SoShape::TRIANGLES);
  for (const std::uint32_t index : *mesh_->indices) {
    const teren::SurfaceVertex& vertex = mesh_->vertices[index];
    const float x = static_cast<float>(vertex.normalX) / 32767.0F;
    const float y = static_cast<float>(vertex.normalY) / 32767.0F;
    corner.setPoint(SbVec3f(static_cast<float>(vertex.column) * step_, static_cast<float>(vertex.row) * step_,
                            vertex.height));
    corner.setNormal(SbVec3f(x, y, std::sqrt(std::fmax(0.0F, 1.0F - x * x - y * y))));
    shapeVertex(&corner);
  }
  endShape();
}
