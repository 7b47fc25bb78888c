#include "qt/TerrainStage.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Inventor/SbVec2f.h>
#include <Inventor/SbVec2s.h>
#include <Inventor/SbViewportRegion.h>
#include <Inventor/SoPickedPoint.h>
#include <Inventor/actions/SoRayPickAction.h>
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
  const Position zero{viewer.position.i, viewer.position.j, 0.0, 0.0};
  if (zero != zero_ || pitch != pitch_) {
    zero_ = zero;
    pitch_ = pitch;
    terrain_->origin = SbVec3d(zero.x(pitch), zero.y(pitch), 0.0);
  }
  const Offset away = offset(zero_, viewer.position, pitch);
  camera_->position =
      SbVec3f(static_cast<float>(away.east), static_cast<float>(away.north), static_cast<float>(height));
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

void TerrainStage::show(std::shared_ptr<const Scene> scene, bool continued) {
  if (!continued) terrain_->setScene(std::make_shared<const Scene>());
  terrain_->setScene(std::move(scene));
}

double TerrainStage::water() const {
  const auto level = static_cast<double>(terrain_->waterLevel.getValue());
  return std::isfinite(level) ? std::max(level, kDry) : kDry;
}

std::optional<SbVec3f> TerrainStage::pick(const SbVec2f& point, const SbVec2s& size) const {
  SoRayPickAction action{SbViewportRegion(size)};
  action.setNormalizedPoint(point);
  action.apply(root_);
  const SoPickedPoint* picked = action.getPickedPoint();
  if (picked == nullptr) return std::nullopt;
  return picked->getPoint();
}

std::optional<Position> TerrainStage::positionOf(const SbVec3f& point) const {
  const Result<Position> position =
      zero_.movedBy(static_cast<double>(point[0]), static_cast<double>(point[1]), pitch_);
  if (!position) return std::nullopt;
  return *position;
}

}  // namespace teren
