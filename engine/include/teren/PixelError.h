// How wrong a picture is: what drawn meshes are off by, in metres, and in pixels as a camera sees it.
#pragma once

#include "teren/Morph.h"
#include "teren/Position.h"
#include "teren/Scene.h"
#include "teren/World.h"

namespace teren {

/// [m] Upper estimate of the largest vertical distance between a mesh and the level-0 triangles below and
/// above it; 0 where nodes of level 0 are drawn. At least 99.9 % of a world's nodes have no more than that,
/// and in the median less than half as much (doc/accuracy.md), once they have been measured by an engine of
/// this world; before, it is an estimate from the plugins' promises. Of the vertices' own heights, not moved
/// with distance (Morph.h). Any thread.
double drawnError(const World& world, const Mesh& mesh);

/// A camera with perspective.
struct Eye {
  Position position = {};
  double height = 0.0;  ///< [m]
  /// [pixel] that a length of 1 m has at a distance of 1 m in the middle of the picture: see lensPixels.
  double lensPixels = 0.0;
};

/// Of a picture `rows` pixels high with a field of view of `fieldOfView` [rad] from its bottom to its top.
double lensPixels(double rows, double fieldOfView) noexcept;

/// [pixel] What a mesh's error looks like from the eye: error / distance * lensPixels, with the distance of
/// the eye from the mesh in three dimensions, or of the boxes around its triangles where the mesh is nearer
/// than it is wide, and at least kNearestGround. An upper bound in the middle of the picture for what one
/// sees from the side; towards its corners perspective stretches everything (by 1 / cos^2 of the angle).
/// O(1), O(triangles) where the mesh is near.
///
/// With the scene's `morph`, and the eye that its vertices move with, they are taken where they are drawn: so
/// far on their way, (1 - t) times the mesh's own error and t times that of the next coarser level. Without
/// `movedWith` that eye is the one that looks. With it, a vertex counts as moved as far as one may be that is
/// so far from the eye that looks: it is at most the distance of the two eyes farther from the other.
double pixelError(const World& world, const Mesh& mesh, const Eye& eye, const Morph& morph = {});
double pixelError(const World& world, const Mesh& mesh, const Eye& eye, const Morph& morph,
                  const DetailEye& movedWith);
inline constexpr double kNearestGround = 1.0;  ///< [m]

/// [pixel] Over all meshes of a scene, in the picture or not.
struct PixelError {
  double p99 = 0.0;  ///< the smallest value that at least 99 % of the meshes do not exceed
  double max = 0.0;
};

/// Of all meshes of a scene, moved as it says: about 0.2 ms for 10^6 triangles.
PixelError pixelError(const World& world, const Scene& scene, const Eye& eye);
PixelError pixelError(const World& world, const Scene& scene, const Eye& eye, const DetailEye& movedWith);

}  // namespace teren
