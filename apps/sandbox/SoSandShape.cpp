#include "apps/sandbox/SoSandShape.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <utility>

#include <Inventor/SbBox3f.h>
#include <Inventor/SbLine.h>
#include <Inventor/SoPickedPoint.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/actions/SoGetPrimitiveCountAction.h>
#include <Inventor/actions/SoRayPickAction.h>
#include <Inventor/elements/SoCacheElement.h>
#include <Inventor/elements/SoGLCacheContextElement.h>
#include <Inventor/elements/SoModelMatrixElement.h>
#include <Inventor/elements/SoProjectionMatrixElement.h>
#include <Inventor/elements/SoViewingMatrixElement.h>
#include <Inventor/errors/SoDebugError.h>
#include <Inventor/misc/SoContextHandler.h>

#include "apps/sandbox/SandPlainPainter.h"
#include "apps/sandbox/SandShaderPainter.h"
#include "apps/sandbox/SandSides.h"
#include "coin/TerrainLook.h"

namespace {

std::unique_ptr<teren::SandPainter> makePainter() {
  const char* wish = std::getenv("TEREN_NO_SHADERS");
  if (wish != nullptr && std::string_view(wish) == "1") return std::make_unique<teren::SandPlainPainter>();
  teren::Result<std::unique_ptr<teren::SandPainter>> painter = teren::SandShaderPainter::create();
  if (painter) return std::move(*painter);
  SoDebugError::postWarning("SoSandShape", "%s; the sand is drawn without them",
                            painter.error().message.c_str());
  return std::make_unique<teren::SandPlainPainter>();
}

void deletePainter(void* painter, std::uint32_t /*context*/) {
  const std::unique_ptr<teren::SandPainter> owned(static_cast<teren::SandPainter*>(painter));
  owned->release();
}

SbVec3f normalOf(const teren::SandVertex& vertex) {
  const float x = static_cast<float>(vertex.normal[0]) / 32767.0F;
  const float y = static_cast<float>(vertex.normal[1]) / 32767.0F;
  return {x, y, std::sqrt(std::max(1.0F - x * x - y * y, 0.0F))};
}

}  // namespace

SO_NODE_SOURCE(SoSandShape)

void SoSandShape::initClass() {
  if (getClassTypeId() != SoType::badType()) return;
  SO_NODE_INIT_CLASS(SoSandShape, SoShape, "Shape");
}

SoSandShape::SoSandShape() {
  SO_NODE_CONSTRUCTOR(SoSandShape);
  SO_NODE_ADD_FIELD(moisture, (0.0F));
  SO_NODE_ADD_FIELD(wireframe, (FALSE));
  SoContextHandler::addContextDestructionCallback(contextDies, this);
}

SoSandShape::~SoSandShape() {
  SoContextHandler::removeContextDestructionCallback(contextDies, this);
  for (auto& [context, painter] : painters_) {
    SoGLCacheContextElement::scheduleDeleteCallback(context, deletePainter, painter.release());
  }
}

void SoSandShape::contextDies(std::uint32_t context, void* shape) {
  auto& painters = static_cast<SoSandShape*>(shape)->painters_;
  const auto found = painters.find(context);
  if (found == painters.end()) return;
  found->second->release();
  painters.erase(found);
}

void SoSandShape::show(std::shared_ptr<const teren::SandSnapshot> sand) {
  if (sand == sand_) return;
  sand_ = std::move(sand);
  touch();
}

std::size_t SoSandShape::bufferBytes() const noexcept {
  std::size_t sum = 0;
  for (const auto& [context, painter] : painters_) sum += painter->bytes();
  return sum;
}

std::size_t SoSandShape::uploadedBytes() const noexcept {
  std::size_t sum = 0;
  for (const auto& [context, painter] : painters_) sum += painter->uploaded();
  return sum;
}

void SoSandShape::GLRender(SoGLRenderAction* action) {
  SoState* state = action->getState();
  SoGLCacheContextElement::shouldAutoCache(state, SoGLCacheContextElement::DONT_AUTO_CACHE);
  SoCacheElement::invalidate(state);  // what is culled depends on the view
  if (!sand_ || sand_->triangleCount() == 0 || !shouldGLRender(action)) return;
  const teren::Sun sun = teren::sunOf(state);
  teren::SandPicture picture;
  picture.sand = sand_;
  picture.toClip = SoModelMatrixElement::get(state) * SoViewingMatrixElement::get(state) *
                   SoProjectionMatrixElement::get(state);
  picture.sun = sun.direction;
  picture.sunlight = sun.light;
  picture.moisture = moisture.getValue() > 0.0F ? std::min(moisture.getValue(), 1.0F) : 0.0F;
  picture.wireframe = wireframe.getValue() == TRUE;
  std::unique_ptr<teren::SandPainter>& painter =
      painters_[static_cast<std::uint32_t>(SoGLCacheContextElement::get(state))];
  if (!painter) painter = makePainter();
  painter->draw(picture);
}

void SoSandShape::rayPick(SoRayPickAction* action) {
  if (!sand_ || !shouldRayPick(action)) return;
  computeObjectSpaceRay(action);
  const teren::LatticeFrame& frame = sand_->frame();
  const SbVec3f from = action->getLine().getPosition(), way = action->getLine().getDirection();
  teren::SandRay ray;
  for (int i = 0; i < 3; ++i) {
    ray.from[static_cast<std::size_t>(i)] = static_cast<double>(from[i]);
    ray.direction[static_cast<std::size_t>(i)] = static_cast<double>(way[i]);
  }
  ray.from[0] += frame.x;
  ray.from[1] += frame.y;
  const std::optional<teren::SandHit> hit = sand_->hit(ray);
  if (!hit) return;
  const SbVec3f place(static_cast<float>(hit->x - frame.x), static_cast<float>(hit->y - frame.y),
                      static_cast<float>(hit->height));
  if (!action->isBetweenPlanes(place)) return;
  SoPickedPoint* picked = action->addIntersection(place);
  if (picked == nullptr) return;  // another one is nearer
  const auto& corners = sand_->corners(hit->triangle);
  const SbVec3f a = point(sand_->vertex(corners[0]));
  SbVec3f normal = (point(sand_->vertex(corners[1])) - a).cross(point(sand_->vertex(corners[2])) - a);
  normal.normalize();
  picked->setObjectNormal(normal);
}

void SoSandShape::getPrimitiveCount(SoGetPrimitiveCountAction* action) {
  if (sand_ && shouldPrimitiveCount(action)) {
    action->addNumTriangles(static_cast<int>(sand_->triangleCount()));
  }
}

SbVec3f SoSandShape::point(const teren::SandVertex& vertex) const {
  const double step = sand_->frame().step;
  return {static_cast<float>(vertex.place.x * step), static_cast<float>(vertex.place.y * step),
          vertex.height};
}

void SoSandShape::computeBBox(SoAction* /*action*/, SbBox3f& box, SbVec3f& center) {
  box.makeEmpty();
  const teren::SandBounds bounds = sand_ ? sand_->bounds() : teren::SandBounds{};
  if (bounds.isEmpty()) return;
  const double step = sand_->frame().step;
  const auto metres = [step](std::int32_t steps) { return static_cast<float>(steps * step); };
  box.setBounds(metres(bounds.southWest.x), metres(bounds.southWest.y), teren::SandSides::bottomOf(*sand_),
                metres(bounds.northEast.x), metres(bounds.northEast.y), bounds.high);
  center = box.getCenter();
}

void SoSandShape::generatePrimitives(SoAction* action) {
  if (!sand_) return;
  SoPrimitiveVertex corner;
  beginShape(action, SoShape::TRIANGLES);
  for (teren::TriangleId t = 0; t < sand_->triangleSlots(); ++t) {
    if (!sand_->isTriangle(t)) continue;
    for (const teren::VertexId v : sand_->corners(t)) {
      corner.setPoint(point(sand_->vertex(v)));
      corner.setNormal(normalOf(sand_->vertex(v)));
      shapeVertex(&corner);
    }
  }
  endShape();
}
