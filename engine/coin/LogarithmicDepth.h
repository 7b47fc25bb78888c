// What a shape of your own needs to stand in one scene with a SoTerrain whose logarithmicDepth is on: the
// same depth for the same distance.
#pragma once

#include <cmath>

#include <Inventor/SbVec2f.h>

namespace teren {

/// For GLSL 1.20 and later, after the line with the version: a uniform and a function for the main() of a
/// fragment shader. depth = log2(w / near) / log2(far / near), where w [m] is the distance from the eye along
/// the line of sight's axis: a step of 24 bits is 1e-6 of the distance (near 0.5 m, far 100 km), everywhere.
/// What is drawn so is not sorted out before its fragments are computed, and polygon offsets do nothing.
inline constexpr char kLogarithmicDepthShader[] = R"(
uniform vec2 depthScale;
void writeDepth() { gl_FragDepth = depthScale.y * log2(depthScale.x / gl_FragCoord.w); }
)";

/// The uniform's value for the camera's clipping planes [m], 0 < nearest < farthest.
inline SbVec2f depthScale(float nearest, float farthest) {
  return {1.0F / nearest, 1.0F / std::log2(farthest / nearest)};
}

}  // namespace teren
