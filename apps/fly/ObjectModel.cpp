#include "apps/fly/ObjectModel.h"

#include <cmath>
#include <cstdint>
#include <numbers>

#include <Inventor/SbColor.h>
#include <Inventor/nodes/SoCoordinate3.h>
#include <Inventor/nodes/SoIndexedFaceSet.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoRotation.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShapeHints.h>
#include <Inventor/nodes/SoSwitch.h>
#include <Inventor/nodes/SoTransform.h>
#include <Inventor/nodes/SoTranslation.h>

namespace teren {
namespace {

SoTranslation* moveBy(const ModelPoint& to, float sign) {
  auto* translation = new SoTranslation;
  translation->translation = SbVec3f(sign * to[0], sign * to[1], sign * to[2]);
  return translation;
}

void addShape(SoSeparator* node, const ModelPart& part) {
  auto* material = new SoMaterial;
  const SbColor color(part.color[0], part.color[1], part.color[2]);
  material->diffuseColor = color;
  material->ambientColor = color;
  material->specularColor = SbColor(0.35F, 0.35F, 0.35F);
  material->shininess = part.shininess;
  node->addChild(material);
  auto* coordinates = new SoCoordinate3;
  std::vector<SbVec3f> points;
  for (const ModelPoint& point : part.points) points.emplace_back(point[0], point[1], point[2]);
  coordinates->point.setValues(0, static_cast<int>(points.size()), points.data());
  node->addChild(coordinates);
  auto* faces = new SoIndexedFaceSet;
  std::vector<std::int32_t> indices;
  for (const auto& triangle : part.triangles) {
    for (const std::uint32_t index : triangle) indices.push_back(static_cast<std::int32_t>(index));
    indices.push_back(-1);
  }
  faces->coordIndex.setValues(0, static_cast<int>(indices.size()), indices.data());
  node->addChild(faces);
}

}  // namespace

SbRotation rotationOf(const Attitude& attitude) {
  const SbRotation roll(SbVec3f(0.0F, 1.0F, 0.0F), static_cast<float>(attitude.roll));
  const SbRotation pitch(SbVec3f(1.0F, 0.0F, 0.0F), static_cast<float>(attitude.pitch));
  const SbRotation heading(SbVec3f(0.0F, 0.0F, 1.0F), static_cast<float>(-attitude.heading));
  return roll * pitch * heading;  // Inventor applies the left one first
}

ObjectModel::ObjectModel(const Model& model) : root_(new SoSwitch), transform_(new SoTransform) {
  root_->ref();
  root_->whichChild = SO_SWITCH_ALL;
  auto* whole = new SoSeparator;
  whole->renderCaching = SoSeparator::OFF;
  whole->addChild(transform_);
  auto* hints = new SoShapeHints;
  hints->vertexOrdering = SoShapeHints::COUNTERCLOCKWISE;  // with an unknown shape type: lit on both sides
  hints->faceType = SoShapeHints::CONVEX;
  hints->creaseAngle = 0.9F;
  whole->addChild(hints);
  for (const ModelPart& part : model.parts) {
    auto* node = new SoSeparator;
    if (part.spin != 0.0F) {
      auto* rotation = new SoRotation;
      node->addChild(moveBy(part.hub, 1.0F));
      node->addChild(rotation);
      node->addChild(moveBy(part.hub, -1.0F));
      spinning_.push_back({rotation, static_cast<double>(part.spin)});
    }
    addShape(node, part);
    whole->addChild(node);
  }
  root_->addChild(whole);
}

ObjectModel::~ObjectModel() {
  root_->unref();
}

void ObjectModel::setVisible(bool visible) {
  root_->whichChild = visible ? SO_SWITCH_ALL : SO_SWITCH_NONE;
}

void ObjectModel::show(const SbVec3f& place, const Attitude& attitude, double dt) {
  transform_->translation = place;
  transform_->rotation = rotationOf(attitude);
  for (SpinningPart& part : spinning_) {
    part.turn = std::fmod(part.turn + part.rate * dt, 2.0 * std::numbers::pi);
    part.rotation->rotation = SbRotation(SbVec3f(0.0F, 1.0F, 0.0F), static_cast<float>(part.turn));
  }
}

}  // namespace teren
