#include "qt/TerrainStage.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Inventor/SbLine.h>
#include <Inventor/SbVec2f.h>
#include <Inventor/SbVec2s.h>
#include <Inventor/SbVec3d.h>
#include <Inventor/SbVec3f.h>
#include <Inventor/SbViewVolume.h>
#include <Inventor/SbViewportRegion.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>

#include "coin/SoTerrain.h"

namespace teren {
namespace {

constexpr float kNearest = 0.3F;         // [m] the near clipping plane
constexpr double kFarthestFactor = 1.6;  // far clipping plane in view distances: to the corners of the square
constexpr float kFieldOfView = 0.87F;    // [rad] of the picture's height
constexpr double kDry = -1e9;            // [m]

}  // namespace

TerrainStage::TerrainStage()
    : root_(new SoSeparator), camera_(new SoPerspectiveCamera), terrain_(new SoTerrain) {
  root_->ref();
  root_->renderCaching = SoSeparator::OFF;
  root_->renderCulling = SoSeparator::OFF;
  camera_->nearDistance = kNearest;
  camera_->heightAngle = kFieldOfView;
  root_->addChild(camera_);
  root_->addChild(terrain_);
  show(std::make_shared<const Scene>(), false);
}

TerrainStage::~TerrainStage() {
  root_->unref();
}

void TerrainStage::look(const Viewer& viewer, double height, double pitch) {
  const bool otherPitch = std::exchange(pitch_, pitch) != pitch;
  if (zero_.follow(viewer.position, height, pitch) || otherPitch) {
    const Position& zero = zero_.position();
    terrain_->origin = SbVec3d(zero.x(pitch), zero.y(pitch), zero_.height());
  }
  const Offset away = offset(zero_.position(), viewer.position, pitch);
  camera_->position = SbVec3f(static_cast<float>(away.east), static_cast<float>(away.north),
                              static_cast<float>(height - zero_.height()));
  // The camera of Inventor looks down its -z axis with y up; here it rests looking north with z up.
  const auto up = static_cast<float>(std::numbers::pi / 2.0 + viewer.pitch);
  const auto turn = static_cast<float>(-std::remainder(viewer.heading, 2.0 * std::numbers::pi));
  camera_->orientation =
      SbRotation(SbVec3f(1.0F, 0.0F, 0.0F), up) * SbRotation(SbVec3f(0.0F, 0.0F, 1.0F), turn);
}

void TerrainStage::setViewDistance(double distance) {
  const auto haze = static_cast<float>(distance);
  if (terrain_->viewDistance.getValue() == haze) return;
  terrain_->viewDistance = haze;
  camera_->farDistance = static_cast<float>(kFarthestFactor * distance);
}

double TerrainStage::fieldOfView() const {
  return static_cast<double>(camera_->heightAngle.getValue());
}

void TerrainStage::show(std::shared_ptr<const Scene> scene, bool continued) {
  if (!continued) terrain_->setScene(std::make_shared<const Scene>());
  terrain_->setScene(std::move(scene));
}

double TerrainStage::water() const {
  const auto level = static_cast<double>(terrain_->waterLevel.getValue());
  return std::isfinite(level) ? std::max(level, kDry) : kDry;
}

SceneQuery TerrainStage::asDrawn(const SceneQuery& query) const {
  const std::optional<SbVec3d> eye = terrain_->movedWith();
  if (!eye) return query;
  const Result<Position> position = zero_.position().movedBy((*eye)[0], (*eye)[1], pitch_);
  return position ? query.seenFrom({*position, (*eye)[2] + zero_.height()}) : query;
}

Ray TerrainStage::sight(const SbVec2f& point, const SbVec2s& size) const {
  SbViewportRegion seen;
  SbLine line;
  camera_->SoCamera::getViewVolume(SbViewportRegion(size), seen).projectPointToLine(point, line);
  const SbVec3d begin(line.getPosition()), way(line.getDirection());
  Ray ray;
  ray.length = static_cast<double>(camera_->farDistance.getValue());
  ray.height = begin[2] + zero_.height();
  ray.direction = {way[0], way[1], way[2]};
  if (const Result<Position> from = zero_.position().movedBy(begin[0], begin[1], pitch_)) {
    ray.from = *from;
  } else {
    ray.length = 0.0;  // beyond the world's end there is nothing to see
  }
  return ray;
}

}  // namespace teren
