#include "coin/SoTerrain.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <Inventor/SbTime.h>
#include <Inventor/SoInput.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/actions/SoGetBoundingBoxAction.h>
#include <Inventor/actions/SoGetMatrixAction.h>
#include <Inventor/actions/SoGetPrimitiveCountAction.h>
#include <Inventor/actions/SoRayPickAction.h>
#include <Inventor/actions/SoSearchAction.h>
#include <Inventor/elements/SoCacheElement.h>
#include <Inventor/elements/SoDrawStyleElement.h>
#include <Inventor/elements/SoGLCacheContextElement.h>
#include <Inventor/elements/SoModelMatrixElement.h>
#include <Inventor/elements/SoProjectionMatrixElement.h>
#include <Inventor/elements/SoViewVolumeElement.h>
#include <Inventor/elements/SoViewingMatrixElement.h>
#include <Inventor/elements/SoViewportRegionElement.h>
#include <Inventor/errors/SoDebugError.h>
#include <Inventor/lists/SbStringList.h>
#include <Inventor/sensors/SoTimerSensor.h>

#include "teren/Parameter.h"
#include "teren/World.h"

#include "coin/FieldEngine.h"
#include "coin/GroundHorizon.h"
#include "coin/LogarithmicDepth.h"
#include "coin/SceneChildren.h"
#include "coin/ShaderPainter.h"
#include "coin/SoTerrainMesh.h"
#include "coin/TerrainLook.h"
#include "coin/TerrainRenderer.h"

namespace {

constexpr double kTimerInterval = 1.0 / 60.0;  // [s]
constexpr double kLongestStep = 0.1;           // [s] after a rest, time does not jump
constexpr float kDry = -1e6F;                  // [m] a water level from here down means no water

bool isFinite(const SbVec3d& vector) {
  return std::isfinite(vector[0]) && std::isfinite(vector[1]) && std::isfinite(vector[2]);
}

constexpr double kFarthest = 1e30;   // [m] of an origin: what a float can still tell from infinity
constexpr double kMostBudget = 1.0;  // [s]

/// "NAME is VALUE VALUE VALUE, expected EXPECTED".
template <class Vector>
std::string refusal(const char* name, const Vector& values, const char* expected) {
  std::string sentence = std::string(name) + " is";
  for (int axis = 0; axis < 3; ++axis) sentence += " " + teren::numberText(static_cast<double>(values[axis]));
  return sentence + ", expected " + expected;
}

/// As the vertex shader moves them.
teren::MovedVertices movedIn(const teren::Picture& picture) {
  const teren::Anchor anchor = picture.placement.anchorNear(picture.eye, teren::ShaderPainter::kAnchorStep);
  return {picture.morph, anchor, SbVec3f(picture.detailEye - picture.placement.position(anchor)),
          picture.placement.spacing()};
}

}  // namespace

/// What the node does between traversals, and what it remembers.
class SoTerrain::Private {
 public:
  explicit Private(SoTerrain& owner) : node(owner), children(owner), timer(tick, this) {
    timer.setInterval(SbTime(kTimerInterval));
  }

  bool livesByFields() const { return !fed; }
  teren::TerrainFields readFields() const;
  void makeEngineIfFieldsChanged();
  void armTimer();
  void followEye(const SbVec3d& point);
  void work(double dt);
  static void tick(void* self, SoSensor* sensor);

  /// `continued`: the snapshot comes from the engine of the one before.
  void show(const std::shared_ptr<const teren::Scene>& next, bool continued);
  void showEngine();
  void forget(const teren::Mesh& mesh) {
    renderer.forget(mesh);
    horizon.forget(mesh);
  }
  teren::ScenePlacement placement() const { return {origin, children.scene()->spacing()}; }

  bool isWet() const;
  teren::Picture look(SoState* state) const;
  const teren::Morph& morph() const { return detailMorph ? *detailMorph : children.scene()->morph(); }
  void takeOrigin();
  void takeBudget();
  void takeHaze();
  void takeDistance();
  void report(SbString& slot, const std::string& sentence) const;

  SoTerrain& node;
  teren::SceneChildren children;
  teren::TerrainRenderer renderer;
  teren::GroundHorizon horizon;
  teren::FieldEngine source;
  SoTimerSensor timer;
  SbTime lastTick = SbTime::zero();
  bool fed = false;                         // by setScene()
  bool fieldsChanged = true;                // since the last attempt to make an engine
  bool showsThisEngine = false;             // whether the scene is one of source.engine()
  bool eyeMoved = true;                     // since the last update
  SbVec3d eye{0.0, 0.0, 0.0};               // of the last traversal, in scene coordinates
  SbVec3d eyePlace{0.0, 0.0, 0.0};          // the same in the world
  std::optional<SbVec3d> detailEye;         // where it is not the picture's own
  std::optional<teren::Morph> detailMorph;  // where it is not the snapshot's own
  SbVec3d origin{0.0, 0.0, 0.0};            // the last good one, as the next two
  double budget = 0.004;                    // [s]
  SbColor haze{0.76F, 0.84F, 0.92F};
  float distance = 1500.0F;  // [m] the last good one
  std::string worldFile;     // where the file named by `world` is
  SbString fieldError, originError, budgetError, hazeError;
  std::function<SbColor(const teren::Mesh&)> tint;
  std::vector<SbColor> tints;  // of the meshes of the last traversal
  std::size_t drawnTriangles = 0;
  bool drewLogarithmicDepth = false;
};

// --- The engine of a node that lives by its fields
// ---------------------------------------------------------------

teren::TerrainFields SoTerrain::Private::readFields() const {
  teren::TerrainFields fields;
  fields.seed = node.seed.getValue().getString();
  fields.world = worldFile;
  fields.generator = node.generator.getValue().getString();
  for (int index = 0; index < node.parameters.getNum(); ++index) {
    fields.parameters.emplace_back(node.parameters[index].getString());
  }
  fields.viewDistance = node.viewDistance.getValue();
  fields.pixelError = node.pixelError.getValue();
  fields.viewLevel = node.viewLevel.getValue();
  return fields;
}

void SoTerrain::Private::makeEngineIfFieldsChanged() {
  if (fed || !fieldsChanged) return;
  fieldsChanged = false;
  const teren::Result<void> made = source.make(readFields());
  report(fieldError, made ? std::string() : made.error().message);
  if (!made) return;
  distance = node.viewDistance.getValue();
  showsThisEngine = false;
  eyeMoved = true;
  armTimer();
}

void SoTerrain::Private::armTimer() {
  if (!fed && !timer.isScheduled()) timer.schedule();
}

void SoTerrain::Private::followEye(const SbVec3d& point) {
  const SbVec3d place = origin + point;
  eye = point;
  if (!isFinite(place) || place == eyePlace) return;
  eyePlace = place;
  eyeMoved = true;
  source.putEye(place);
  armTimer();
}

void SoTerrain::Private::tick(void* self, SoSensor* /*sensor*/) {
  auto& me = *static_cast<Private*>(self);
  me.makeEngineIfFieldsChanged();
  const SbTime now = SbTime::getTimeOfDay();
  const double dt = std::clamp((now - me.lastTick).getValue(), 0.0, kLongestStep);
  me.lastTick = now;
  me.work(dt);
}

void SoTerrain::Private::work(double dt) {
  bool pending = false;
  if (source.engine() != nullptr) {
    eyeMoved = false;
    pending = source.update(dt, std::chrono::nanoseconds(static_cast<std::int64_t>(budget * 1e9)));
    showEngine();
  }
  if (!pending && !eyeMoved) timer.unschedule();
}

void SoTerrain::Private::showEngine() {
  for (const std::string& sentence : source.engine()->world().takeMessages()) {
    SoDebugError::postWarning("SoTerrain", "%s", sentence.c_str());
  }
  const std::shared_ptr<const teren::Scene> next = source.engine()->scene();
  // A new engine has nothing to show at first: until then the landscape before it stays.
  if (!showsThisEngine && next->meshes().empty()) return;
  show(next, showsThisEngine);
  showsThisEngine = true;
}

// --- What is shown
// -------------------------------------------------------------------------------------------------

void SoTerrain::Private::show(const std::shared_ptr<const teren::Scene>& next, bool continued) {
  const std::shared_ptr<const teren::Scene> before = children.scene();
  if (next == before) return;
  if (!continued) {
    for (const auto& mesh : before->meshes()) forget(*mesh);
    children.show(std::make_shared<const teren::Scene>());
  } else {
    auto mesh = before->meshes().begin();  // sorted by id, as what has been removed
    for (const std::uint64_t id : teren::difference(*before, *next).removed) {
      while ((*mesh)->id != id) ++mesh;
      forget(**mesh);
    }
  }
  children.show(next);
  node.touch();
}

bool SoTerrain::Private::isWet() const {
  const float level = node.waterLevel.getValue();
  return std::isfinite(level) && level > kDry;
}

teren::Picture SoTerrain::Private::look(SoState* state) const {
  teren::Picture picture{placement()};
  picture.eye = teren::eyePosition(state);
  picture.detailEye = detailEye.value_or(picture.eye);
  if (teren::fieldOfView(state)) picture.morph = morph();
  const teren::Sun sun = teren::sunOf(state);
  picture.sun = sun.direction;
  picture.sunlight = sun.light;
  picture.toClip = teren::precise(SoProjectionMatrixElement::get(state));
  picture.toEye = teren::precise(SoModelMatrixElement::get(state));
  picture.toEye.multRight(teren::precise(SoViewingMatrixElement::get(state)));
  for (int axis = 0; axis < 3; ++axis) picture.toEye[3][axis] = 0.0;
  picture.viewDistance = std::max(distance, 1.0F);
  picture.waterLevel = isWet() ? node.waterLevel.getValue() : kDry;
  picture.haze = haze;
  const SbDPViewVolume& seen = SoViewVolumeElement::get(state).getDPViewVolume();
  if (node.logarithmicDepth.getValue() != FALSE && seen.getProjectionType() == SbDPViewVolume::PERSPECTIVE &&
      seen.getNearDist() > 0.0) {
    picture.depthScale = teren::depthScale(static_cast<float>(seen.getNearDist()),
                                           static_cast<float>(seen.getNearDist() + seen.getDepth()));
  }
  return picture;
}

void SoTerrain::Private::takeOrigin() {
  const SbVec3d wanted = node.origin.getValue();
  const auto isNear = [](double metres) { return std::fabs(metres) <= kFarthest; };  // false for NaN
  if (isNear(wanted[0]) && isNear(wanted[1]) && isNear(wanted[2])) {
    report(originError, "");
    origin = wanted;
    if (!fed) followEye(eye);
  } else {
    report(originError, refusal("origin", wanted, "three numbers from -1e30 to 1e30"));
  }
}

void SoTerrain::Private::takeBudget() {
  const double wanted = node.frameBudget.getValue().getValue();
  if (0.0 <= wanted && wanted <= kMostBudget) {
    report(budgetError, "");
    budget = wanted;
  } else {
    report(budgetError, "frameBudget is " + teren::numberText(wanted) + " s, expected 0 to 1 s");
  }
}

void SoTerrain::Private::takeHaze() {
  const SbColor wanted = node.hazeColor.getValue();
  const auto isShare = [](float light) { return 0.0F <= light && light <= 1.0F; };
  if (isShare(wanted[0]) && isShare(wanted[1]) && isShare(wanted[2])) {
    report(hazeError, "");
    haze = wanted;
  } else {
    report(hazeError, refusal("hazeColor", wanted, "three numbers from 0 to 1"));
  }
}

/// Of a node that is fed: for others the engine has the say.
void SoTerrain::Private::takeDistance() {
  const float wanted = node.viewDistance.getValue();
  if (fed && std::isfinite(wanted) && wanted > 0.0F) distance = wanted;
}

void SoTerrain::Private::report(SbString& slot, const std::string& sentence) const {
  if (slot == sentence.c_str()) return;
  slot = sentence.c_str();
  if (!sentence.empty()) SoDebugError::post("SoTerrain", "%s", sentence.c_str());
}

// --- The node
// ------------------------------------------------------------------------------------------------------

SO_NODE_SOURCE(SoTerrain)

void SoTerrain::initClass() {
  if (getClassTypeId() != SoType::badType()) return;
  SoTerrainMesh::initClass();
  SO_NODE_INIT_CLASS(SoTerrain, SoNode, "Node");
  // Inventor asks nodes that are no groups and no shapes only where they have told it to.
  SoCallbackAction::addMethod(getClassTypeId(), SoNode::callbackS);
  SoGLRenderAction::addMethod(getClassTypeId(), SoNode::GLRenderS);
  SoGetBoundingBoxAction::addMethod(getClassTypeId(), SoNode::getBoundingBoxS);
  SoGetMatrixAction::addMethod(getClassTypeId(), SoNode::getMatrixS);
  SoGetPrimitiveCountAction::addMethod(getClassTypeId(), SoNode::getPrimitiveCountS);
  SoRayPickAction::addMethod(getClassTypeId(), SoNode::rayPickS);
  SoSearchAction::addMethod(getClassTypeId(), SoNode::searchS);
}

SoTerrain::SoTerrain() {
  SO_NODE_CONSTRUCTOR(SoTerrain);
  SO_NODE_ADD_FIELD(seed, (""));
  SO_NODE_ADD_FIELD(world, (""));
  SO_NODE_ADD_FIELD(generator, (""));
  SO_NODE_ADD_EMPTY_MFIELD(parameters);
  SO_NODE_ADD_FIELD(viewDistance, (1500.0F));
  SO_NODE_ADD_FIELD(pixelError, (0.0F));
  SO_NODE_ADD_FIELD(viewLevel, (2));
  SO_NODE_ADD_FIELD(frameBudget, (SbTime(0.004)));
  SO_NODE_ADD_FIELD(waterLevel, (-150.0F));
  SO_NODE_ADD_FIELD(origin, (SbVec3d(0.0, 0.0, 0.0)));
  SO_NODE_ADD_FIELD(hazeColor, (SbColor(0.76F, 0.84F, 0.92F)));
  SO_NODE_ADD_FIELD(logarithmicDepth, (FALSE));
  private_ = std::make_unique<Private>(*this);
}

SoTerrain::~SoTerrain() = default;

void SoTerrain::setScene(std::shared_ptr<const teren::Scene> scene) {
  const bool continued = private_->fed;
  private_->fed = scene != nullptr;
  if (!scene) {
    if (continued) private_->fieldsChanged = true;
    private_->makeEngineIfFieldsChanged();
    return;
  }
  private_->takeDistance();
  private_->timer.unschedule();
  private_->source.drop();
  private_->showsThisEngine = false;
  private_->show(scene, continued);
}

void SoTerrain::setTint(std::function<SbColor(const teren::Mesh&)> tint) {
  private_->tint = std::move(tint);
  touch();
}

void SoTerrain::setDetailEye(const std::optional<SbVec3d>& eye, const std::optional<teren::Morph>& morph) {
  private_->detailEye = eye;
  private_->detailMorph = morph;
  touch();
}

std::optional<SbVec3d> SoTerrain::movedWith() const {
  const teren::MovedVertices& moved = private_->children.moved();
  if (!moved.move()) return std::nullopt;
  return private_->placement().position(moved.anchor()) + SbVec3d(moved.eye());
}

std::shared_ptr<const teren::Scene> SoTerrain::scene() const {
  return private_->children.scene();
}

teren::Engine* SoTerrain::engine() {
  private_->makeEngineIfFieldsChanged();
  return private_->source.engine();
}

void SoTerrain::settle() {
  if (engine() == nullptr) return;
  private_->source.settle();
  private_->showEngine();
}

const SbString& SoTerrain::errorText() {
  private_->makeEngineIfFieldsChanged();
  for (const SbString* error : {&private_->fieldError, &private_->originError, &private_->budgetError}) {
    if (error->getLength() > 0) return *error;
  }
  return private_->hazeError;
}

std::size_t SoTerrain::bufferBytes() const {
  return private_->renderer.bytes();
}

std::size_t SoTerrain::drawnTriangles() const {
  return private_->drawnTriangles;
}

SbBool SoTerrain::drewLogarithmicDepth() const {
  return private_->drewLogarithmicDepth ? TRUE : FALSE;
}

SbBool SoTerrain::affectsState() const {
  return FALSE;
}

void SoTerrain::notify(SoNotList* list) {
  if (private_) {
    const SoField* field = list->getLastField();
    if (field == &world) private_->worldFile = world.getValue().getString();
    if (field == &origin) private_->takeOrigin();
    if (field == &frameBudget) private_->takeBudget();
    if (field == &hazeColor) private_->takeHaze();
    if (field == &viewDistance) private_->takeDistance();
    if (field == &seed || field == &world || field == &generator || field == &parameters ||
        field == &viewDistance || field == &pixelError || field == &viewLevel) {
      private_->fieldsChanged = true;
      private_->armTimer();
    }
  }
  inherited::notify(list);
}

SbBool SoTerrain::readInstance(SoInput* input, unsigned short flags) {
  const SbBool good = inherited::readInstance(input, flags);
  const std::filesystem::path name = world.getValue().getString();
  std::error_code ignored;
  if (good && !name.empty() && name.is_relative() && !std::filesystem::exists(name, ignored)) {
    const SbStringList none;
    const SbString found = SoInput::searchForFile(world.getValue(), SoInput::getDirectories(), none);
    if (found.getLength() > 0) private_->worldFile = found.getString();
  }
  return good;
}

// --- Traversals
// ----------------------------------------------------------------------------------------------------

SoChildList* SoTerrain::getChildren() const {
  return private_->children.list();
}

void SoTerrain::doAction(SoAction* action) {
  private_->children.traverse(action, private_->placement());
}

void SoTerrain::callback(SoCallbackAction* action) {
  doAction(action);
}

void SoTerrain::getPrimitiveCount(SoGetPrimitiveCountAction* action) {
  doAction(action);
}

void SoTerrain::rayPick(SoRayPickAction* action) {
  doAction(action);
}

void SoTerrain::search(SoSearchAction* action) {
  inherited::search(action);
  if (!action->isFound()) doAction(action);
}

void SoTerrain::getMatrix(SoGetMatrixAction* action) {
  int count = 0;
  const int* indices = nullptr;
  if (action->getPathCode(count, indices) != SoAction::IN_PATH) return;
  SbMatrix move;
  const SbVec3f offset = private_->children.offset(indices[0], private_->placement());
  move.setTranslate(offset);
  action->getMatrix().multLeft(move);
  move.setTranslate(-offset);
  action->getInverse().multRight(move);
}

void SoTerrain::getBoundingBox(SoGetBoundingBoxAction* action) {
  private_->makeEngineIfFieldsChanged();
  int count = 0;
  const int* indices = nullptr;
  if (action->getPathCode(count, indices) == SoAction::IN_PATH) {
    doAction(action);
    return;
  }
  SbBox3f box = private_->children.box(private_->placement());
  if (box.isEmpty()) box = private_->source.expectedBox(private_->origin);
  if (box.isEmpty()) return;
  if (private_->isWet()) {
    const auto surface = static_cast<float>(static_cast<double>(waterLevel.getValue()) - private_->origin[2]);
    const SbVec3f corner = box.getMin();
    if (surface > corner[2])
      box.extendBy(SbVec3f(corner[0], corner[1], surface));  // else no ground is below it
  }
  action->extendBy(box);
  action->setCenter(box.getCenter(), TRUE);
}

void SoTerrain::GLRender(SoGLRenderAction* action) {
  SoState* state = action->getState();
  SoGLCacheContextElement::shouldAutoCache(state, SoGLCacheContextElement::DONT_AUTO_CACHE);
  SoCacheElement::invalidate(state);
  private_->drawnTriangles = 0;
  if (SoDrawStyleElement::get(state) == SoDrawStyleElement::INVISIBLE) return;
  if (private_->livesByFields()) {
    private_->makeEngineIfFieldsChanged();
    private_->followEye(teren::eyePosition(state));
    if (const std::optional<double> angle = teren::fieldOfView(state)) {
      const int lines = SoViewportRegionElement::get(state).getViewportSizePixels()[1];
      if (private_->source.fitPicture(lines, *angle)) private_->armTimer();
    }
  }
  teren::Picture picture = private_->look(state);
  if (!isFinite(picture.eye)) return;  // of a camera that is nowhere
  std::vector<const teren::Mesh*> meshes =
      teren::visibleMeshes(state, *private_->children.scene(), picture.placement);
  const std::vector<SbBox2f> wet =
      teren::wetPlaces(state, *private_->children.scene(), picture.placement, picture.waterLevel);
  picture.wet = wet;
  if (meshes.empty() && wet.empty()) return;
  if (picture.eye[2] + private_->origin[2] > static_cast<double>(picture.waterLevel)) {
    std::erase_if(meshes, [&](const teren::Mesh* mesh) { return teren::isLostInWater(*mesh, picture); });
  }
  if (const std::optional<double> nearest = teren::nearestDrawn(state)) {
    private_->horizon.leaveOutHidden(meshes, *private_->children.scene(), movedIn(picture), picture.placement,
                                     picture.eye, *nearest);
  }
  for (const teren::Mesh* mesh : meshes) private_->drawnTriangles += mesh->indices->size() / 3;
  private_->tints.clear();
  if (private_->tint) {
    for (const teren::Mesh* mesh : meshes) private_->tints.push_back(private_->tint(*mesh));
  }
  picture.tints = private_->tints;
  const auto context = static_cast<std::uint32_t>(SoGLCacheContextElement::get(state));
  const teren::TerrainRenderer::Drawn drawn = private_->renderer.draw(context, picture, meshes);
  private_->drewLogarithmicDepth = drawn.logarithmicDepth;
  private_->children.setMoved(drawn.movedVertices ? movedIn(picture) : teren::MovedVertices());
  if (private_->source.engine() != nullptr) {
    private_->source.engine()->setRendererBytes(private_->renderer.bytes());
  }
}
