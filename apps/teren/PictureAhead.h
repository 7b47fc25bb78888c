// What an object that looks where it flies has in its picture.
#pragma once

#include <array>

#include "teren/Engine.h"
#include "teren/Object.h"
#include "teren/Scene.h"
#include "teren/World.h"

namespace teren {

/// A picture 16:9, as high as the view's, level where the object moves level; north where it stands still. It
/// ends at the view's distance across the ground: what is drawn beyond completes roots, and nobody asked for
/// it.
class PictureAhead {
 public:
  PictureAhead(const World& world, const Motion& eye, const DetailSettings& detail);

  /// False only where no part of a mesh is in the picture: its box lies beyond one of the picture's edges or
  /// the view's distance, or behind the eye. What hides behind hills is in the picture. O(1).
  bool mayShow(const Mesh& mesh) const noexcept;
  /// Of a scene, those meshes. O(meshes).
  Scene of(const Scene& scene) const;

 private:
  using Vector = std::array<double, 3>;  // east, north, up

  const World& world_;
  Motion eye_;
  double distance_;                  // [m]
  std::array<Vector, 5> inwards_{};  // normals of the planes through the eye between which the picture lies
};

}  // namespace teren
