// What the two ways of drawing a landscape, with shaders and without, have in common.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <Inventor/SbBox2f.h>
#include <Inventor/SbColor.h>
#include <Inventor/SbDPMatrix.h>
#include <Inventor/SbVec2f.h>
#include <Inventor/SbVec3d.h>
#include <Inventor/SbVec3f.h>

#include "teren/Scene.h"

#include "coin/ScenePlacement.h"

namespace teren {

/// What lies below the water is seen only where the water is shallow and near: ground this far [m] below it
/// keeps less than half a hundredth of its colour (exp(-0.09 60), the shaders' law), and beyond this share of
/// the view distance the water is opaque, so that no time is spent on a sea bed at grazing angles.
inline constexpr float kOpaqueDepth = 60.0F;
inline constexpr float kClearShare = 14.0F * 14.0F / (32.0F * 32.0F);

/// One look at a landscape, in scene coordinates. The eye's place is no part of the matrices: those of
/// Inventor are floats, and would lose what is near in the digits of how far the scene's zero is.
struct Picture {
  explicit Picture(const ScenePlacement& where) : placement(where) {}

  ScenePlacement placement;
  SbDPMatrix toEye;                  ///< from places relative to `eye` (row vectors, as Inventor's matrices)
  SbDPMatrix toClip;                 ///< eye to clip coordinates
  SbVec3d eye{0.0, 0.0, 0.0};        ///< where it is looked from
  SbVec3d detailEye{0.0, 0.0, 0.0};  ///< the eye whose distance vertices move with
  Morph morph = {};                  ///< how; the plain painter moves none
  SbVec3f sun{0.0F, 0.0F, 1.0F};     ///< unit vector towards the sun
  SbColor sunlight{1.0F, 1.0F, 1.0F};  ///< its colour times its intensity
  float viewDistance = 1.0F;           ///< [m] > 0
  /// Where on the plane there may be water to see, in rectangles; empty: none is drawn.
  std::span<const SbBox2f> wet = {};
  float waterLevel = 0.0F;  ///< [m] absolute, finite also where there is no water
  SbColor haze{1.0F, 1.0F, 1.0F};
  /// Of the depth as LogarithmicDepth.h has it; empty: the ordinary depth.
  std::optional<SbVec2f> depthScale = {};
  /// One for each mesh to be drawn, in place of what grows there; empty: the land as it looks.
  std::span<const SbColor> tints = {};
};

/// Draws meshes in one GL context and keeps what that takes. All members but forget() and bytes() need the
/// context to be current. GL state is left as it was found.
class TerrainPainter {
 public:
  virtual ~TerrainPainter() = default;

  /// Whether it heeds Picture::depthScale.
  virtual bool knowsLogarithmicDepth() const noexcept = 0;
  /// Whether it heeds Picture::morph.
  virtual bool movesVertices() const noexcept = 0;
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
