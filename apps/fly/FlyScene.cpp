#include "apps/fly/FlyScene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <Inventor/SbVec3d.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/nodes/SoCallback.h>
#include <Inventor/nodes/SoDirectionalLight.h>
#include <Inventor/nodes/SoDrawStyle.h>
#include <Inventor/nodes/SoEnvironment.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSwitch.h>

#include "coin/SoTerrain.h"

namespace teren {
namespace {

// [m] The clipping planes under logarithmic depth, and under the ordinary one, which wears thin between them.
constexpr float kNearest = 0.5F, kFarthest = 100e3F;
constexpr float kOrdinaryNearest = 1.0F, kOrdinaryFarthest = 500.0F;  // the sky fits in
constexpr float kFarthestFactor = 1.6F;  // the far one in view distances at least: to the square's corners

constexpr float kDry = -1e6F;  // [m] a water level of SoTerrain's for no water

/// The camera of Inventor looks down its -z axis with y up; an object's rest looks north with z up.
SbRotation turnOf(const Pose& pose) {
  const SbRotation upright(SbVec3f(1.0F, 0.0F, 0.0F), std::numbers::pi_v<float> / 2.0F);
  return upright * rotationOf({pose.heading, pose.pitch, pose.roll});
}

SoSeparator* uncached() {
  auto* separator = new SoSeparator;
  separator->renderCaching = SoSeparator::OFF;
  separator->renderCulling = SoSeparator::OFF;
  return separator;
}

}  // namespace

FlyScene::FlyScene(const Daylight& light, Engine& engine)
    : root_(uncached()),
      camera_(new SoPerspectiveCamera),
      terrain_(new SoTerrain),
      style_(new SoDrawStyle),
      waterLevel_(light.waterLevel),
      sky_(light) {
  root_->ref();
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
  terrain_->logarithmicDepth = TRUE;
  setViewDistance(engine.options().view.reach(engine.world()));
  SoSeparator* land = uncached();
  land->addChild(style_);
  land->addChild(terrain_);
  root_->addChild(land);
  auto* drawn = new SoCallback;
  drawn->setCallback(landIsDrawn, this);
  root_->addChild(drawn);
  root_->addChild(ring_.node());
  root_->addChild(depth_.node());
  depth_.node()->addChild(sight_.node());
  for (std::size_t index = 0; index < engine.objectCount(); ++index) {
    models_.push_back(std::make_unique<ObjectModel>(engine.object(index).model()));
    depth_.node()->addChild(models_.back()->node());
  }
}

FlyScene::~FlyScene() {
  models_.clear();
  root_->unref();
}

void FlyScene::setTint(std::function<SbColor(const Mesh&)> tint) {
  terrain_->setTint(std::move(tint));
}

void FlyScene::setWires(bool wires) {
  style_->style = wires ? SoDrawStyle::LINES : SoDrawStyle::FILLED;
  terrain_->waterLevel = wires ? kDry : waterLevel_;
}

void FlyScene::freeze(const Viewpoint& eye, double aspect) {
  frozen_ = Frozen{eye, aspect};
}

void FlyScene::thaw() {
  frozen_.reset();
  sight_.hide();
}

void FlyScene::setRing(const std::optional<Position>& middle, double radius) {
  ringMiddle_ = middle;
  ringRadius_ = radius;
}

// On the triangles as they are drawn; where there are none, as high as its middle.
void FlyScene::showRing(const Engine& engine) {
  const std::optional<double> base = ringMiddle_ ? engine.drawnHeight(*ringMiddle_) : std::nullopt;
  if (!base) return ring_.hide();
  const double pitch = engine.world().pitch();
  const auto at = [&](double turn, double radius) {
    const double east = radius * std::sin(turn), north = radius * std::cos(turn);
    const Result<Position> there = ringMiddle_->movedBy(east, north, pitch);
    const std::optional<double> height = there ? engine.drawnHeight(*there) : std::nullopt;
    return SbVec3f(static_cast<float>(east), static_cast<float>(north),
                   static_cast<float>(height.value_or(*base) - *base));
  };
  constexpr double kFullTurn = 2.0 * std::numbers::pi, kCross = 0.15;
  std::array<SbVec3f, ToolRing::kPoints> around;
  for (std::size_t k = 0; k < around.size(); ++k) {
    around[k] = at(kFullTurn * static_cast<double>(k) / ToolRing::kPoints, ringRadius_);
  }
  const double arm = kCross * ringRadius_;
  const std::array<SbVec3f, 4> cross{at(0.0, arm), at(0.5 * kFullTurn, arm), at(0.25 * kFullTurn, arm),
                                     at(0.75 * kFullTurn, arm)};
  ring_.show(place(*ringMiddle_, *base, pitch), around, cross);
}

double FlyScene::viewDistance(const Engine& engine, const Pose& eye) const {
  const double reach = engine.options().view.reach(engine.world());
  if (!frozen_) return reach;
  const Pose& there = frozen_->eye.pose;
  const Offset away = offset(there.position, eye.position, engine.world().pitch());
  return reach + std::hypot(away.east, away.north, eye.height - there.height);
}

void FlyScene::setViewDistance(double viewDistance) {
  if (terrain_->viewDistance.getValue() == static_cast<float>(viewDistance)) return;
  terrain_->viewDistance = static_cast<float>(viewDistance);
  setPlanes();
}

/// Between the land and the objects of one picture.
void FlyScene::landIsDrawn(void* scene, SoAction* action) {
  if (!action->isOfType(SoGLRenderAction::getClassTypeId())) return;
  auto& me = *static_cast<FlyScene*>(scene);
  me.depth_.turnOn(me.terrain_->drewLogarithmicDepth() != FALSE);
}

/// For the depth that the land had in the last picture.
void FlyScene::setPlanes() {
  const bool logarithmic = terrain_->drewLogarithmicDepth() != FALSE;
  camera_->nearDistance = logarithmic ? kNearest : kOrdinaryNearest;
  camera_->farDistance = std::max(logarithmic ? kFarthest : kOrdinaryFarthest,
                                  kFarthestFactor * terrain_->viewDistance.getValue());
  depth_.setPlanes(camera_->nearDistance.getValue(), camera_->farDistance.getValue());
}

// Snapshots of two engines have nothing in common.
void FlyScene::showOtherLand() {
  terrain_->setScene(std::make_shared<const Scene>());
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
  if (std::exchange(changes_, flight.changes()) != flight.changes()) showOtherLand();
  terrain_->setScene(flight.engine().scene());
  const DetailEye detailEye = flight.detailEye();
  terrain_->setDetailEye(SbVec3d(this->place(detailEye.position, detailEye.height, pitch)));
  setViewDistance(viewDistance(flight.engine(), eye));
  setPlanes();

  const SbVec3f place = this->place(eye.position, eye.height, pitch);
  camera_->position = place;
  camera_->orientation = turnOf(eye);
  camera_->heightAngle = static_cast<float>(view.fieldOfView);
  sky_.moveTo(place);

  for (std::size_t index = 0; index < models_.size(); ++index) {
    const Object& object = flight.engine().object(index);
    const Motion motion = object.motion();
    models_[index]->setVisible(frozen_ || person == CameraRig::Person::third || index != flight.active());
    models_[index]->show(this->place(motion.position, motion.height, pitch), object.attitude(), dt);
  }
  showRing(flight.engine());
  if (!frozen_) return;
  const Pose& there = frozen_->eye.pose;
  sight_.show(turnOf(there), frozen_->eye.fieldOfView, frozen_->aspect,
              flight.engine().options().view.reach(flight.engine().world()));
  sight_.moveTo(this->place(there.position, there.height, pitch));
}

std::size_t FlyScene::bufferBytes() const {
  return terrain_->bufferBytes();
}

}  // namespace teren
