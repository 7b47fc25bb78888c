#include "coin/TerrainLook.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Inventor/SbMatrix.h>
#include <Inventor/SbViewVolume.h>
#include <Inventor/elements/SoClipPlaneElement.h>
#include <Inventor/elements/SoCullElement.h>
#include <Inventor/elements/SoDrawStyleElement.h>
#include <Inventor/elements/SoLightElement.h>
#include <Inventor/elements/SoModelMatrixElement.h>
#include <Inventor/elements/SoViewVolumeElement.h>
#include <Inventor/elements/SoViewingMatrixElement.h>
#include <Inventor/nodes/SoDirectionalLight.h>

namespace teren {

SbDPMatrix precise(const SbMatrix& matrix) {
  SbDPMatrix result;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) result[row][column] = static_cast<double>(matrix[row][column]);
  }
  return result;
}

SbVec3d eyePosition(SoState* state) {
  SbVec3d eye;
  const SbDPMatrix fromWorld = precise(SoModelMatrixElement::get(state)).inverse();
  fromWorld.multVecMatrix(SoViewVolumeElement::get(state).getDPViewVolume().getProjectionPoint(), eye);
  return eye;
}

std::optional<double> fieldOfView(SoState* state) {
  const SbViewVolume& volume = SoViewVolumeElement::get(state);
  const auto height = static_cast<double>(volume.getHeight()),
             near = static_cast<double>(volume.getNearDist());
  if (volume.getProjectionType() != SbViewVolume::PERSPECTIVE || !(height > 0.0 && near > 0.0))
    return std::nullopt;
  return 2.0 * std::atan(0.5 * height / near);
}

std::optional<double> nearestDrawn(SoState* state) {
  const SbViewVolume& volume = SoViewVolumeElement::get(state);
  const double scale = std::fabs(precise(SoModelMatrixElement::get(state)).det3());
  if (volume.getProjectionType() != SbViewVolume::PERSPECTIVE || std::fabs(scale - 1.0) > 1e-3 ||
      SoClipPlaneElement::getInstance(state)->getNum() > 0 ||
      SoDrawStyleElement::get(state) != SoDrawStyleElement::FILLED)
    return std::nullopt;
  return static_cast<double>(volume.getNearDist());
}

Sun sunOf(SoState* state) {
  const SoNodeList& lights = SoLightElement::getLights(state);
  for (int index = 0; index < lights.getLength(); ++index) {
    if (!lights[index]->isOfType(SoDirectionalLight::getClassTypeId())) continue;
    const auto* light = static_cast<const SoDirectionalLight*>(lights[index]);
    const SbMatrix toEye = SoModelMatrixElement::get(state) * SoViewingMatrixElement::get(state);
    Sun sun;
    SoLightElement::getMatrix(state, index).multDirMatrix(-light->direction.getValue(), sun.direction);
    toEye.inverse().multDirMatrix(sun.direction, sun.direction);
    if (!(sun.direction.normalize() > 0.0F)) break;
    sun.light = light->color.getValue() * light->intensity.getValue();
    return sun;
  }
  return {};
}

bool isLostInWater(const Mesh& mesh, const Picture& picture) {
  if (mesh.maxHeight < picture.waterLevel - kOpaqueDepth) return true;
  if (mesh.maxHeight >= picture.waterLevel) return false;
  const SbVec3f eye(picture.eye);
  SbVec3f away = picture.placement.box(mesh).getClosestPoint(eye) - eye;
  away[2] = 0.0F;
  return away.length() > kClearShare * picture.viewDistance;
}

std::vector<SbBox2f> wetPlaces(SoState* state, const Scene& scene, const ScenePlacement& placement,
                               float waterLevel) {
  std::vector<SbBox2f> places;
  for (const auto& mesh : scene.meshes()) {
    if (mesh->minHeight >= waterLevel) continue;
    const SbBox3f box = placement.box(*mesh);
    const float surface = box.getMax()[2] + (waterLevel - mesh->maxHeight);
    const SbVec3f low = box.getMin(), high = box.getMax();
    if (!SoCullElement::cullTest(state, SbBox3f(low[0], low[1], surface, high[0], high[1], surface)))
      places.emplace_back(low[0], low[1], high[0], high[1]);
  }
  return places;
}

std::vector<const Mesh*> visibleMeshes(SoState* state, const Scene& scene, const ScenePlacement& placement) {
  const SbVec3f eye(eyePosition(state));
  std::vector<std::pair<float, const Mesh*>> ranked;
  ranked.reserve(scene.meshes().size());
  for (const std::shared_ptr<const Mesh>& mesh : scene.meshes()) {
    const SbBox3f box = placement.box(*mesh);
    if (SoCullElement::cullTest(state, box)) continue;
    ranked.emplace_back((box.getClosestPoint(eye) - eye).sqrLength(), mesh.get());
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<const Mesh*> meshes;
  meshes.reserve(ranked.size());
  for (const auto& [distance, mesh] : ranked) meshes.push_back(mesh);
  return meshes;
}

}  // namespace teren
