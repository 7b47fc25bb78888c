#include "coin/SoTerrainMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include <Inventor/SbBox3f.h>
#include <Inventor/SbLine.h>
#include <Inventor/SbVec3d.h>
#include <Inventor/SoPickedPoint.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/actions/SoGetPrimitiveCountAction.h>
#include <Inventor/actions/SoRayPickAction.h>

namespace {

/// A box around the part of a line that lies inside a box; empty where it passes by.
std::optional<SbBox3f> partInside(const SbLine& line, const SbBox3f& box) {
  const SbVec3d from(line.getPosition()), way(line.getDirection());
  double begin = -std::numeric_limits<double>::infinity(), end = -begin;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = static_cast<double>(box.getMin()[axis]) - from[axis];
    const double high = static_cast<double>(box.getMax()[axis]) - from[axis];
    if (way[axis] == 0.0) {
      if (low > 0.0 || high < 0.0) return std::nullopt;
      continue;
    }
    begin = std::max(begin, std::min(low / way[axis], high / way[axis]));
    end = std::min(end, std::max(low / way[axis], high / way[axis]));
  }
  if (!(begin <= end)) return std::nullopt;
  SbBox3f part;
  part.extendBy(SbVec3f(from + begin * way));
  part.extendBy(SbVec3f(from + end * way));
  return part;
}

}  // namespace

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

SbVec3f SoTerrainMesh::point(const teren::SurfaceVertex& vertex) const {
  return {static_cast<float>(vertex.column) * step_, static_cast<float>(vertex.row) * step_, vertex.height};
}

SbVec3f SoTerrainMesh::normal(const teren::SurfaceVertex& vertex) {
  const float x = static_cast<float>(vertex.normalX) / 32767.0F;
  const float y = static_cast<float>(vertex.normalY) / 32767.0F;
  return {x, y, std::sqrt(std::fmax(0.0F, 1.0F - x * x - y * y))};
}

void SoTerrainMesh::generatePrimitives(SoAction* action) {
  if (!mesh_) return;
  SoPrimitiveVertex corner;
  beginShape(action, SoShape::TRIANGLES);
  for (const std::uint32_t index : *mesh_->indices) {
    const teren::SurfaceVertex& vertex = mesh_->vertices[index];
    corner.setPoint(point(vertex));
    corner.setNormal(normal(vertex));
    shapeVertex(&corner);
  }
  endShape();
}

void SoTerrainMesh::rayPick(SoRayPickAction* action) {
  if (!mesh_ || !shouldRayPick(action)) return;
  computeObjectSpaceRay(action);
  const SbVec3f size(step_ * static_cast<float>(mesh_->columns), step_ * static_cast<float>(mesh_->rows),
                     0.0F);
  const SbVec3f margin(0.5F * step_, 0.5F * step_, 0.5F * step_);  // for rounding
  const SbBox3f box(SbVec3f(0.0F, 0.0F, mesh_->minHeight) - margin,
                    SbVec3f(size[0], size[1], mesh_->maxHeight) + margin);
  const std::optional<SbBox3f> near = partInside(action->getLine(), box);
  if (!near) return;
  const SbVec3f low = near->getMin() - margin, high = near->getMax() + margin;
  // A triangle is far from the ray where all of its corners lie on one side of that part of the ray.
  const auto isFar = [&](const std::array<const teren::SurfaceVertex*, 3>& corners) {
    std::array<SbVec3f, 3> points;
    for (std::size_t k = 0; k < 3; ++k) points[k] = point(*corners[k]);
    for (int axis = 0; axis < 3; ++axis) {
      if (points[0][axis] < low[axis] && points[1][axis] < low[axis] && points[2][axis] < low[axis])
        return true;
      if (points[0][axis] > high[axis] && points[1][axis] > high[axis] && points[2][axis] > high[axis])
        return true;
    }
    return false;
  };
  const teren::TriangleIndices& indices = *mesh_->indices;
  for (std::size_t at = 0; at + 2 < indices.size(); at += 3) {
    const std::array<const teren::SurfaceVertex*, 3> corners{
        &mesh_->vertices[indices[at]], &mesh_->vertices[indices[at + 1]], &mesh_->vertices[indices[at + 2]]};
    if (!isFar(corners)) pickTriangle(*action, corners);
  }
}

void SoTerrainMesh::pickTriangle(SoRayPickAction& action,
                                 const std::array<const teren::SurfaceVertex*, 3>& corners) const {
  SbVec3f hit, weights;
  SbBool front = FALSE;
  if (!action.intersect(point(*corners[0]), point(*corners[1]), point(*corners[2]), hit, weights, front))
    return;
  if (!action.isBetweenPlanes(hit)) return;
  SoPickedPoint* picked = action.addIntersection(hit, front);
  if (picked == nullptr) return;  // another one is nearer
  SbVec3f middle(0.0F, 0.0F, 0.0F);
  for (int k = 0; k < 3; ++k) middle += weights[k] * normal(*corners[static_cast<std::size_t>(k)]);
  middle.normalize();
  picked->setObjectNormal(middle);
}
