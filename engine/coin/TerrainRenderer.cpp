#include "coin/TerrainRenderer.h"

#include <cstdlib>
#include <string_view>

#include <Inventor/elements/SoGLCacheContextElement.h>
#include <Inventor/errors/SoDebugError.h>
#include <Inventor/misc/SoContextHandler.h>

#include "coin/PlainPainter.h"
#include "coin/ShaderPainter.h"

namespace teren {
namespace {

std::unique_ptr<TerrainPainter> makePainter() {
  const char* wish = std::getenv("TEREN_NO_SHADERS");
  if (wish != nullptr && std::string_view(wish) == "1") return std::make_unique<PlainPainter>();
  Result<std::unique_ptr<TerrainPainter>> painter = ShaderPainter::create();
  if (painter) return std::move(*painter);
  SoDebugError::postWarning("SoTerrain", "%s; the ground is drawn without them",
                            painter.error().message.c_str());
  return std::make_unique<PlainPainter>();
}

void deletePainter(void* painter, std::uint32_t /*context*/) {
  const std::unique_ptr<TerrainPainter> owned(static_cast<TerrainPainter*>(painter));
  owned->release();
}

}  // namespace

TerrainRenderer::TerrainRenderer() {
  SoContextHandler::addContextDestructionCallback(contextDies, this);
}

TerrainRenderer::~TerrainRenderer() {
  SoContextHandler::removeContextDestructionCallback(contextDies, this);
  for (auto& [context, painter] : painters_) {
    SoGLCacheContextElement::scheduleDeleteCallback(context, deletePainter, painter.release());
  }
}

TerrainRenderer::Drawn TerrainRenderer::draw(std::uint32_t context, const Picture& picture,
                                             std::span<const Mesh* const> meshes) {
  std::unique_ptr<TerrainPainter>& painter = painters_[context];
  if (!painter) painter = makePainter();
  painter->draw(picture, meshes);
  return {picture.depthScale.has_value() && painter->knowsLogarithmicDepth(), painter->movesVertices()};
}

void TerrainRenderer::forget(const Mesh& mesh) {
  for (const auto& [context, painter] : painters_) painter->forget(mesh);
}

std::size_t TerrainRenderer::bytes() const noexcept {
  std::size_t sum = 0;
  for (const auto& [context, painter] : painters_) sum += painter->bytes();
  return sum;
}

void TerrainRenderer::contextDies(std::uint32_t context, void* renderer) {
  auto& painters = static_cast<TerrainRenderer*>(renderer)->painters_;
  const auto found = painters.find(context);
  if (found == painters.end()) return;
  found->second->release();
  painters.erase(found);
}

}  // namespace teren
