#include "apps/fly/FlyScene.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include <Inventor/nodes/SoDirectionalLight.h>
#include <Inventor/nodes/SoEnvironment.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>

#include "coin/SoTerrain.h"

namespace teren {
namespace {

constexpr float kNearest = 1.0F;         // [m] the near clipping plane
constexpr float kFarthestFactor = 1.6F;  // far clipping plane in view distances: to the corners of the square
constexpr float kFarthestAtLeast = 500.0F;  // [m] so that the sky fits in

SoSeparator* uncached() {
  auto* separator = new SoSeparator;
  separator->renderCaching = SoSeparator::OFF;
  separator->renderCulling = SoSeparator::OFF;
  return separator;
}

}  // namespace

FlyScene::FlyScene(const Daylight& light, Engine& engine)
    : root_(uncached()), camera_(new SoPerspectiveCamera), terrain_(new SoTerrain), sky_(light) {
  root_->ref();
  camera_->nearDistance = kNearest;
  root_->addChild(camera_);
  root_->addChild(sky_.node());
  auto* environment = new SoEnvironment;
  environment->ambientIntensity = 0.38F;
  environment->ambientColor = SbColor(0.78F, 0.86F, 1.0F);
  root_->addChild(environment);
  auto* sun = new SoDirectionalLight;
  sun->direction = -light.sun;
  sun->color = light.sunlight;
  root_->addChild(sun);
  terrain_->setScene(engine.scene());  // first: fields of a node without an engine of its own are few
  terrain_->waterLevel = light.waterLevel;
  terrain_->hazeColor = light.haze;
  setViewDistance(engine.options().view.reach(engine.world()));
  SoSeparator* land = uncached();
  land->addChild(terrain_);
  root_->addChild(land);
  for (std::size_t index = 0; index < engine.objectCount(); ++index) {
    models_.push_back(std::make_unique<ObjectModel>(engine.object(index).model()));
    root_->addChild(models_.back()->node());
  }
}

FlyScene::~FlyScene() {
  models_.clear();
  root_->unref();
}

void FlyScene::setViewDistance(double viewDistance) {
  const auto distance = static_cast<float>(viewDistance);
  camera_->farDistance = std::max(kFarthestAtLeast, kFarthestFactor * distance);
  terrain_->viewDistance = distance;
}

// Snapshots of two engines have nothing in common.
void FlyScene::showOtherLand(const Engine& engine) {
  terrain_->setScene(std::make_shared<const Scene>());
  setViewDistance(engine.options().view.reach(engine.world()));
}

SbVec3f FlyScene::place(const Position& position, double height, double pitch) const {
  const Offset away = offset(zero_.position(), position, pitch);
  return {static_cast<float>(away.east), static_cast<float>(away.north),
          static_cast<float>(height - zero_.height())};
}

void FlyScene::moveZero(double pitch) {
  const Position& zero = zero_.position();
  terrain_->origin = SbVec3d(zero.x(pitch), zero.y(pitch), zero_.height());
}

void FlyScene::show(Flight& flight, const Viewpoint& view, CameraRig::Person person, double dt) {
  const double pitch = flight.engine().world().pitch();
  const Pose& eye = view.pose;
  if (zero_.follow(eye.position, eye.height, pitch)) moveZero(pitch);
  if (std::exchange(changes_, flight.changes()) != flight.changes()) showOtherLand(flight.engine());
  terrain_->setScene(flight.engine().scene());

  // The camera of Inventor looks down its -z axis with y up; an object's rest looks north with z up.
  const SbRotation upright(SbVec3f(1.0F, 0.0F, 0.0F), std::numbers::pi_v<float> / 2.0F);
  const SbVec3f place = this->place(eye.position, eye.height, pitch);
  camera_->position = place;
  camera_->orientation = upright * rotationOf({eye.heading, eye.pitch, eye.roll});
  camera_->heightAngle = static_cast<float>(view.fieldOfView);
  sky_.moveTo(place);

  for (std::size_t index = 0; index < models_.size(); ++index) {
    const Object& object = flight.engine().object(index);
    const Motion motion = object.motion();
    models_[index]->setVisible(person == CameraRig::Person::third || index != flight.active());
    models_[index]->show(this->place(motion.position, motion.height, pitch), object.attitude(), dt);
  }
}

std::size_t FlyScene::bufferBytes() const {
  return terrain_->bufferBytes();
}

}  // namespace teren
