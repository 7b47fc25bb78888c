// Which meshes may have the logarithmic depth of their vertices instead of one for each fragment.
#pragma once

#include <unordered_map>

#include <Inventor/SbDPMatrix.h>

#include "teren/Scene.h"

#include "coin/ScenePlacement.h"

namespace teren {

/// Depth that fragments compute keeps OpenGL from leaving out hidden ones before their colour is computed, in
/// all of a hilly picture two of five. Depth of vertices does not, and is linear between them on the screen,
/// as the inverse of the distance w from the eye's plane is. So within a triangle it lies behind the true
/// one, by at most (wmax / wmin - 1)^2 / 8 of the distance: a chord of -ln(1/w), whose second derivative is
/// w^2. Triangles stay where they are, so nothing opens between meshes of either kind.
class DepthByVertex {
 public:
  /// How much farther away than it is a point may be taken to be, as a share of its distance.
  static constexpr double kFarther = 5e-4;
  /// wmax / wmin - 1 with which that holds: sqrt(8 kFarther) and less.
  static constexpr double kWidest = 0.0632;

  /// Whether it holds for all of a mesh. `toClip` takes places relative to `eye` to clip coordinates.
  bool does(const Mesh& mesh, const ScenePlacement& placement, const SbVec3d& eye, const SbDPMatrix& toClip);
  void forget(const Mesh& mesh) { longest_.erase(&mesh); }

 private:
  std::unordered_map<const Mesh*, double> longest_;  // [m] side of a triangle
};

/// [m] The longest side of a mesh's triangles, wherever between its surface and the coarser one each vertex
/// is drawn; `spacing` [m] of level-0 samples. O(triangles).
double longestSide(const Mesh& mesh, double spacing);

/// [m] A lower bound for w within a box of the scene's.
double nearestDepth(const SbBox3f& box, const SbVec3d& eye, const SbDPMatrix& toClip);

}  // namespace teren
