// One mesh of a landscape's snapshot as a shape: what SoTerrain's hidden children are.
#pragma once

#include <array>
#include <memory>

#include <Inventor/SbVec3f.h>
#include <Inventor/nodes/SoShape.h>
#include <Inventor/nodes/SoSubNode.h>

#include "teren/Scene.h"

#include "coin/MovedVertices.h"

/// Picking, bounding boxes, callbacks and searches see each mesh as this shape, in metres east and north of
/// its own south-west vertex and at absolute height; SoTerrain moves it into place. SoTerrain itself draws
/// all of its meshes at once; a mesh drawn alone goes the plain way of shapes. Immutable; made only by
/// programs, never read from files, and without fields. Picking sees its vertices where the last picture had
/// them; callbacks, as they lie.
class SoTerrainMesh : public SoShape {
  typedef SoShape inherited;  // NOLINT: the name SO_NODE_HEADER expects

  SO_NODE_HEADER(SoTerrainMesh);  // NOLINT

 public:
  static void initClass();
  /// Without a mesh: an empty shape.
  SoTerrainMesh();
  /// `spacing` [m] between level-0 samples. `moved`: how its vertices were in the last picture, kept up to
  /// date by whoever draws; nullptr: as they lie.
  SoTerrainMesh(std::shared_ptr<const teren::Mesh> mesh, double spacing,
                std::shared_ptr<const teren::MovedVertices> moved = nullptr);

  /// nullptr for an empty shape.
  const std::shared_ptr<const teren::Mesh>& mesh() const noexcept { return mesh_; }

  void getPrimitiveCount(SoGetPrimitiveCountAction* action) override;
  /// Adds points and normals, without details. Looks only at triangles near the ray, so it costs nanoseconds
  /// a triangle where Inventor's general way costs a hundred.
  void rayPick(SoRayPickAction* action) override;

 protected:
  ~SoTerrainMesh() override;
  void computeBBox(SoAction* action, SbBox3f& box, SbVec3f& center) override;
  void generatePrimitives(SoAction* action) override;

 private:
  SbVec3f point(const teren::SurfaceVertex& vertex) const;
  static SbVec3f normal(const teren::SurfaceVertex& vertex);
  /// Of the last picture.
  float share(const teren::SurfaceVertex& vertex) const;
  SbVec3f drawnPoint(const teren::SurfaceVertex& vertex) const;
  SbVec3f drawnNormal(const teren::SurfaceVertex& vertex) const;
  void pickTriangle(SoRayPickAction& action, const std::array<const teren::SurfaceVertex*, 3>& corners,
                    const std::array<SbVec3f, 3>& points) const;

  std::shared_ptr<const teren::Mesh> mesh_;
  std::shared_ptr<const teren::MovedVertices> moved_;
  float step_ = 1.0F;  // [m] between the mesh's own samples
};
