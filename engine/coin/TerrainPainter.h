// What the two ways of drawing a landscape, with shaders and without, have in common.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include <Inventor/SbColor.h>
#include <Inventor/SbDPMatrix.h>
#include <Inventor/SbVec3f.h>

#include "teren/Scene.h"

#include "coin/ScenePlacement.h"

namespace teren {

/// One look at a landscape, in scene coordinates.
struct Picture {
  ScenePlacement placement;
  SbDPMatrix toEye;   ///< scene to eye coordinates (row vectors, as Inventor's matrices)
  SbDPMatrix toClip;  ///< eye to clip coordinates
  SbVec3f eye;        ///< where it is looked from
  SbVec3f sun;        ///< unit vector towards the sun
  float viewDistance = 0.0F;
  bool water = false;       ///< whether there is any to draw
  float waterLevel = 0.0F;  ///< [m] absolute, finite also where there is no water
  SbColor haze;
};

/// How much of the ground the haze hides at `share` of the view distance, 0 ... 1, reaching 1 at share 1. An
/// exponential law that a steep end pulls to 1; the shaders have the same formula.
inline float hazeAt(float share) {
  const float s = share < 1.0F ? share : 1.0F;
  const float cube = s * s * s;
  return 1.0F - std::exp(-1.1F * s) * (1.0F - cube * cube);
}

/// Draws meshes in one GL context and keeps what that takes. All members but forget() and bytes() need the
/// context to be current. GL state is left as it was found.
class TerrainPainter {
 public:
  virtual ~TerrainPainter() = default;

  /// Draws the meshes, which are best sorted front to back, then the water.
  virtual void draw(const Picture& picture, std::span<const Mesh* const> meshes) = 0;
  /// The mesh will not be drawn again and may die.
  virtual void forget(const Mesh& mesh) = 0;
  /// Deletes all GL objects; nothing but destruction may follow.
  virtual void release() = 0;
  /// [bytes] in GL's buffers.
  virtual std::size_t bytes() const noexcept = 0;
};

}  // namespace teren
