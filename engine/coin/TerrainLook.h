// What a GL traversal's state says about a look at a landscape: from where, under which sun, and what is in
// sight.
#pragma once

#include <vector>

#include <Inventor/SbVec3f.h>

#include "teren/Scene.h"

#include "coin/ScenePlacement.h"

class SoState;

namespace teren {

/// The eye, in the coordinates the model matrix leads from.
SbVec3f eyePosition(SoState* state);

/// Unit vector towards the first directional light, in the same coordinates; without one, towards a sun in
/// the south-west, 35 degrees high.
SbVec3f sunDirection(SoState* state);

/// The meshes that are not outside the view volume or a clipping plane, nearest to the eye first.
std::vector<const Mesh*> visibleMeshes(SoState* state, const Scene& scene, const ScenePlacement& placement);

}  // namespace teren
