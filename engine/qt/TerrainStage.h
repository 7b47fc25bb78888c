// The scene graph of a TerrainWidget: a camera and the land.
#pragma once

#include <memory>

#include "teren/Position.h"
#include "teren/Scene.h"
#include "teren/SceneQuery.h"

#include "coin/SceneZero.h"
#include "qt/Viewer.h"

class SbVec2f;
class SbVec2s;
class SoPerspectiveCamera;
class SoSeparator;
class SoTerrain;

namespace teren {

/// Scene coordinates count from a place near the eye, so that what is near it is exact wherever in the world,
/// and however high, it is. Make it after SoTerrain::initClass.
class TerrainStage {
 public:
  TerrainStage();
  ~TerrainStage();
  TerrainStage(const TerrainStage&) = delete;
  TerrainStage& operator=(const TerrainStage&) = delete;

  SoSeparator* root() const noexcept { return root_; }
  SoTerrain& terrain() const noexcept { return *terrain_; }

  /// Looks from the viewer's place at a height [m] of the world whose pitch [m] this is.
  void look(const Viewer& viewer, double height, double pitch);
  /// Puts the haze, and the end of what the camera sees, behind this distance [m].
  void setViewDistance(double distance);
  double fieldOfView() const;  ///< [rad] of the picture's height
  /// `continued`: from the same engine as the one before.
  void show(std::shared_ptr<const Scene> scene, bool continued);

  /// [m] The water's surface; far below all ground where there is none.
  double water() const;

  /// The way of sight behind a point of a picture of `size` pixels, from (0, 0) at its lower left corner to
  /// (1, 1), to the end of what the camera sees; its direction is about 1 long.
  Ray sight(const SbVec2f& point, const SbVec2s& size) const;
  /// The ground with its vertices where the last picture had them.
  SceneQuery asDrawn(const SceneQuery& query) const;

 private:
  SoSeparator* root_;  // referenced
  SoPerspectiveCamera* camera_;
  SoTerrain* terrain_;
  SceneZero zero_;
  double pitch_ = 1.0;  // [m] of the world
};

}  // namespace teren
