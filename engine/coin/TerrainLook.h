// What a GL traversal's state says about a look at a landscape: from where, under which sun, and what is in
// sight.
#pragma once

#include <optional>
#include <vector>

#include <Inventor/SbBox2f.h>
#include <Inventor/SbColor.h>
#include <Inventor/SbDPMatrix.h>
#include <Inventor/SbVec3d.h>
#include <Inventor/SbVec3f.h>

#include "teren/Scene.h"

#include "coin/ScenePlacement.h"
#include "coin/TerrainPainter.h"

class SbMatrix;
class SoState;

namespace teren {

/// The eye, in the coordinates the model matrix leads from: the place of the camera as it was given, which is
/// known better than the matrix that is made from it.
SbVec3d eyePosition(SoState* state);
/// [radian] Of the picture's height; empty where the camera has no perspective.
std::optional<double> fieldOfView(SoState* state);
/// A matrix of Inventor's with the numbers it has.
SbDPMatrix precise(const SbMatrix& matrix);

/// The first directional light of the state; without one, a warm sun in the south-west, 35 degrees high.
struct Sun {
  SbVec3f direction{-0.579F, -0.579F, 0.574F};  ///< unit vector towards it, in the same coordinates
  SbColor light{0.98F, 0.90F, 0.76F};           ///< its colour times its intensity
};
Sun sunOf(SoState* state);

/// Whether a mesh cannot be seen through the water, from above it: too deep, or below opaque water.
bool isLostInWater(const Mesh& mesh, const Picture& picture);

/// [m] From where on all ground in the picture is drawn, and filled, so that it hides what is behind it;
/// empty where that cannot be said: without perspective, with clipping planes, as lines, scaled.
std::optional<double> nearestDrawn(SoState* state);

/// Where there is water above these meshes that is not outside the view volume or a clipping plane, wherever
/// its bed is: their rectangles.
std::vector<SbBox2f> wetPlaces(SoState* state, const Scene& scene, const ScenePlacement& placement,
                               float waterLevel);

/// The meshes that are not outside the view volume or a clipping plane, nearest to the eye first.
std::vector<const Mesh*> visibleMeshes(SoState* state, const Scene& scene, const ScenePlacement& placement);

}  // namespace teren
