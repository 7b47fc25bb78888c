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

SoTerrainMesh::SoTerrainMesh(std::shared_ptr<const teren::Mesh> mesh, double spacing,
                             std::shared_ptr<const teren::MovedVertices> moved)
    : SoTerrainMesh() {
  mesh_ = std::move(mesh);
  moved_ = std::move(moved);
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

float SoTerrainMesh::share(const teren::SurfaceVertex& vertex) const {
  return moved_ ? moved_->share(*mesh_, vertex) : 0.0F;
}

SbVec3f SoTerrainMesh::drawnPoint(const teren::SurfaceVertex& vertex) const {
  SbVec3f drawn = point(vertex);
  if (moved_) drawn[2] = moved_->height(*mesh_, vertex);
  return drawn;
}

/// As the vertex shader mixes them.
SbVec3f SoTerrainMesh::drawnNormal(const teren::SurfaceVertex& vertex) const {
  const float t = share(vertex);
  if (t == 0.0F) return normal(vertex);
  const float x = (vertex.normalX * (1.0F - t) + static_cast<float>(vertex.coarserX()) * t) / 32767.0F;
  const float y = (vertex.normalY * (1.0F - t) + vertex.coarserNormalY * t) / 32767.0F;
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
  const float middle = 0.5F * (low[2] + high[2]);
  // A triangle is far from the ray where all of its corners lie on one side of that part of the ray.
  const auto isFar = [&](const std::array<SbVec3f, 3>& points) {
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
    std::array<SbVec3f, 3> points{point(*corners[0]), point(*corners[1]), point(*corners[2])};
    for (SbVec3f& flat : points) flat[2] = middle;  // heights cost more: the plan first
    if (isFar(points)) continue;
    for (std::size_t k = 0; k < 3; ++k) points[k] = drawnPoint(*corners[k]);
    if (!isFar(points)) pickTriangle(*action, corners, points);
  }
}

void SoTerrainMesh::pickTriangle(SoRayPickAction& action,
                                 const std::array<const teren::SurfaceVertex*, 3>& corners,
                                 const std::array<SbVec3f, 3>& points) const {
  SbVec3f hit, weights;
  SbBool front = FALSE;
  if (!action.intersect(points[0], points[1], points[2], hit, weights, front)) return;
  if (!action.isBetweenPlanes(hit)) return;
  SoPickedPoint* picked = action.addIntersection(hit, front);
  if (picked == nullptr) return;  // another one is nearer
  SbVec3f middle(0.0F, 0.0F, 0.0F);
  for (int k = 0; k < 3; ++k) middle += weights[k] * drawnNormal(*corners[static_cast<std::size_t>(k)]);
  middle.normalize();
  picked->setObjectNormal(middle);
}
