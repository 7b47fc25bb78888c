// How far the vertices of a picture have moved, for what has to fit it on the processor: picking.
#pragma once

#include <cmath>
#include <cstdint>

#include <Inventor/SbVec3f.h>

#include "teren/Morph.h"
#include "teren/Scene.h"

#include "coin/ScenePlacement.h"

namespace teren {

/// The vertex shader's arithmetic: floats from the anchor of the picture.
class MovedVertices {
 public:
  /// Nothing moves.
  MovedVertices() = default;
  /// `eye`: that they move with, counted from the anchor.
  MovedVertices(const Morph& morph, const Anchor& anchor, const SbVec3f& eye, double spacing) noexcept
      : morph_(morph), anchor_(anchor), eye_(eye), spacing_(static_cast<float>(spacing)) {}

  bool move() const noexcept { return morph_.tolerance() > 0.0F; }
  const Anchor& anchor() const noexcept { return anchor_; }
  const SbVec3f& eye() const noexcept { return eye_; }

  /// Of the way to the next coarser surface.
  float share(const Mesh& mesh, const SurfaceVertex& vertex) const noexcept {
    if (!move()) return 0.0F;
    const std::int64_t column = mesh.originColumn + (std::int64_t{vertex.column} << mesh.level);
    const std::int64_t row = mesh.originRow + (std::int64_t{vertex.row} << mesh.level);
    const SbVec3f place(static_cast<float>(column - anchor_.sample.column) * spacing_,
                        static_cast<float>(row - anchor_.sample.row) * spacing_,
                        vertex.height - anchor_.height);
    return morph_.share(vertex.level(), (place - eye_).length());
  }

  /// [m] Where it is drawn.
  float height(const Mesh& mesh, const SurfaceVertex& vertex) const noexcept {
    const float t = share(mesh, vertex);
    return vertex.height * (1.0F - t) + vertex.coarserHeight * t;
  }

 private:
  Morph morph_;
  Anchor anchor_;
  SbVec3f eye_{0.0F, 0.0F, 0.0F};
  float spacing_ = 1.0F;
};

}  // namespace teren
