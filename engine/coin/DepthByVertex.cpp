#include "coin/DepthByVertex.h"

#include <algorithm>
#include <cmath>

#include "coin/DrawnHeights.h"

namespace teren {
namespace {

/// At most, wherever between its two surfaces each vertex is drawn.
double squaredSide(const SurfaceVertex& a, const SurfaceVertex& b, double step) {
  const double east = step * (a.column - b.column), north = step * (a.row - b.row);
  const auto [aLow, aHigh] = drawnHeights(a);
  const auto [bLow, bHigh] = drawnHeights(b);
  const double up = std::max(static_cast<double>(aHigh) - static_cast<double>(bLow),
                             static_cast<double>(bHigh) - static_cast<double>(aLow));
  return east * east + north * north + up * up;
}

}  // namespace

double longestSide(const Mesh& mesh, double spacing) {
  const double step = std::ldexp(spacing, mesh.level);
  double most = 0.0;
  const TriangleIndices& indices = *mesh.indices;
  for (std::size_t at = 0; at + 2 < indices.size(); at += 3) {
    const SurfaceVertex &a = mesh.vertices[indices[at]], &b = mesh.vertices[indices[at + 1]],
                        &c = mesh.vertices[indices[at + 2]];
    most = std::max({most, squaredSide(a, b, step), squaredSide(b, c, step), squaredSide(c, a, step)});
  }
  return std::sqrt(most);
}

double nearestDepth(const SbBox3f& box, const SbVec3d& eye, const SbDPMatrix& toClip) {
  double depth = toClip[3][3];
  for (int axis = 0; axis < 3; ++axis) {
    const double low = static_cast<double>(box.getMin()[axis]) - eye[axis];
    const double high = static_cast<double>(box.getMax()[axis]) - eye[axis];
    depth += std::min(low * toClip[axis][3], high * toClip[axis][3]);
  }
  return depth;
}

bool DepthByVertex::does(const Mesh& mesh, const ScenePlacement& placement, const SbVec3d& eye,
                         const SbDPMatrix& toClip) {
  const double nearest = nearestDepth(placement.box(mesh), eye, toClip);
  // How much w differs by along a metre of the land, at most: 1 but where a scene is scaled.
  const double steepest = std::hypot(toClip[0][3], toClip[1][3], toClip[2][3]);
  // No triangle is shorter than its step: most of what is too near is known without a look.
  const double step = std::ldexp(placement.spacing(), mesh.level);
  if (!(step * steepest <= kWidest * nearest)) return false;
  const auto [found, isNew] = longest_.try_emplace(&mesh, 0.0);
  if (isNew) found->second = longestSide(mesh, placement.spacing());
  return found->second * steepest <= kWidest * nearest;
}

}  // namespace teren
