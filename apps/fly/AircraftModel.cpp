#include "apps/fly/AircraftModel.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

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

constexpr float kPi = std::numbers::pi_v<float>;
constexpr double kPropellerRate = 40.0;  // [rad/s]; slow enough to be seen turning
const SbColor kWhite(0.93F, 0.94F, 0.95F);
const SbColor kGlass(0.10F, 0.16F, 0.22F);
const SbColor kDark(0.12F, 0.12F, 0.13F);

/// A cross section of the fuselage: an ellipse at `y` along the aircraft, its middle at height `z`.
struct Section {
  float y, z, halfWidth, halfHeight;
};

/// A corner of a wing's outline, seen from above.
struct Corner {
  float x, y, z;
};

SoSeparator* faces(const SbColor& color, float shininess, const std::vector<SbVec3f>& points,
                   const std::vector<std::int32_t>& indices) {
  auto* part = new SoSeparator;
  auto* material = new SoMaterial;
  material->diffuseColor = color;
  material->ambientColor = color;
  material->specularColor = SbColor(0.35F, 0.35F, 0.35F);
  material->shininess = shininess;
  part->addChild(material);
  auto* coordinates = new SoCoordinate3;
  coordinates->point.setValues(0, static_cast<int>(points.size()), points.data());
  part->addChild(coordinates);
  auto* set = new SoIndexedFaceSet;
  set->coordIndex.setValues(0, static_cast<int>(indices.size()), indices.data());
  part->addChild(set);
  return part;
}

// A body of elliptic sections from tail to nose.
SoSeparator* body(const SbColor& color, std::span<const Section> sections) {
  constexpr int kSides = 12;
  std::vector<SbVec3f> points;
  std::vector<std::int32_t> indices;
  for (const Section& section : sections) {
    for (int side = 0; side < kSides; ++side) {
      const float turn = 2.0F * kPi * static_cast<float>(side) / kSides;
      points.emplace_back(section.halfWidth * std::cos(turn), section.y,
                          section.z + section.halfHeight * std::sin(turn));
    }
  }
  for (int ring = 0; ring + 1 < static_cast<int>(sections.size()); ++ring) {
    for (int side = 0; side < kSides; ++side) {
      const int here = ring * kSides, there = here + kSides, next = (side + 1) % kSides;
      indices.insert(indices.end(), {here + side, here + next, there + next, there + side, -1});
    }
  }
  return faces(color, 0.5F, points, indices);
}

// A wing: its outline, thick in the middle and sharp at the edges, on both sides of the aircraft. `up` is the
// direction of its thickness.
SoSeparator* wing(const SbColor& color, std::span<const Corner> outline, const SbVec3f& up, float thickness,
                  bool mirrored) {
  std::vector<SbVec3f> points;
  std::vector<std::int32_t> indices;
  const int count = static_cast<int>(outline.size());
  for (int side = 0; side < (mirrored ? 2 : 1); ++side) {
    const float sign = side == 0 ? 1.0F : -1.0F;
    const int first = static_cast<int>(points.size());
    SbVec3f middle(0.0F, 0.0F, 0.0F);
    for (const Corner& corner : outline) {
      points.emplace_back(sign * corner.x, corner.y, corner.z);
      middle += points.back() / static_cast<float>(count);
    }
    points.push_back(middle + up * thickness);
    points.push_back(middle - up * thickness);
    for (int corner = 0; corner < count; ++corner) {
      const int here = first + corner, next = first + (corner + 1) % count;
      const bool forwards = (side == 0) == (up[2] > 0.5F);
      const int a = forwards ? here : next, b = forwards ? next : here;
      indices.insert(indices.end(), {a, b, first + count, -1, b, a, first + count + 1, -1});
    }
  }
  return faces(color, 0.4F, points, indices);
}

SoSeparator* fuselage(const SbColor& paint) {
  constexpr std::array<Section, 8> kBody{{{-5.3F, 0.35F, 0.02F, 0.05F},
                                          {-4.9F, 0.32F, 0.12F, 0.22F},
                                          {-3.0F, 0.18F, 0.34F, 0.42F},
                                          {-1.2F, 0.08F, 0.55F, 0.62F},
                                          {0.8F, 0.02F, 0.60F, 0.66F},
                                          {2.2F, 0.0F, 0.52F, 0.52F},
                                          {3.0F, 0.0F, 0.40F, 0.42F},
                                          {3.05F, 0.0F, 0.02F, 0.02F}}};
  constexpr std::array<Section, 4> kBand{{{-3.4F, 0.205F, 0.31F, 0.395F},
                                          {-2.9F, 0.172F, 0.36F, 0.445F},
                                          {-2.3F, 0.14F, 0.43F, 0.51F},
                                          {-2.25F, 0.14F, 0.40F, 0.45F}}};
  constexpr std::array<Section, 5> kCanopy{{{-1.9F, 0.50F, 0.05F, 0.05F},
                                            {-1.2F, 0.62F, 0.36F, 0.32F},
                                            {-0.2F, 0.66F, 0.43F, 0.46F},
                                            {0.8F, 0.55F, 0.40F, 0.34F},
                                            {1.5F, 0.38F, 0.10F, 0.10F}}};
  constexpr std::array<Section, 3> kSpinner{
      {{3.03F, 0.0F, 0.24F, 0.24F}, {3.3F, 0.0F, 0.17F, 0.17F}, {3.55F, 0.0F, 0.01F, 0.01F}}};
  auto* parts = new SoSeparator;
  parts->addChild(body(kWhite, kBody));
  parts->addChild(body(paint, kBand));
  parts->addChild(body(kGlass, kCanopy));
  parts->addChild(body(paint, kSpinner));
  return parts;
}

SoSeparator* wings(const SbColor& paint) {
  constexpr std::array<Corner, 4> kWing{
      {{0.3F, 0.95F, -0.28F}, {0.3F, -0.85F, -0.28F}, {4.5F, -0.45F, 0.10F}, {4.5F, 0.62F, 0.10F}}};
  constexpr std::array<Corner, 4> kTip{
      {{4.5F, 0.62F, 0.10F}, {4.5F, -0.45F, 0.10F}, {5.5F, -0.32F, 0.20F}, {5.4F, 0.30F, 0.20F}}};
  constexpr std::array<Corner, 4> kTail{
      {{0.05F, -3.9F, 0.40F}, {0.05F, -4.9F, 0.40F}, {1.9F, -4.95F, 0.45F}, {1.85F, -4.4F, 0.45F}}};
  constexpr std::array<Corner, 4> kFin{
      {{0.0F, -3.5F, 0.5F}, {0.0F, -5.2F, 0.45F}, {0.0F, -5.55F, 2.0F}, {0.0F, -4.75F, 2.0F}}};
  const SbVec3f up(0.0F, 0.0F, 1.0F), sideways(1.0F, 0.0F, 0.0F);
  auto* parts = new SoSeparator;
  parts->addChild(wing(kWhite, kWing, up, 0.13F, true));
  parts->addChild(wing(paint, kTip, up, 0.05F, true));
  parts->addChild(wing(kWhite, kTail, up, 0.06F, true));
  parts->addChild(wing(paint, kFin, sideways, 0.08F, false));
  return parts;
}

SoSeparator* propeller(SoRotation* turn) {
  constexpr std::array<Corner, 6> kBlade{{{0.0F, 0.0F, -0.08F},
                                          {0.45F, 0.04F, -0.11F},
                                          {1.05F, 0.02F, -0.06F},
                                          {1.1F, 0.0F, 0.05F},
                                          {0.45F, -0.04F, 0.10F},
                                          {0.0F, 0.0F, 0.08F}}};
  auto* parts = new SoSeparator;
  auto* place = new SoTranslation;
  place->translation = SbVec3f(0.0F, 3.2F, 0.0F);
  parts->addChild(place);
  parts->addChild(turn);
  parts->addChild(wing(kDark, kBlade, SbVec3f(0.0F, 1.0F, 0.0F), 0.03F, true));
  return parts;
}

}  // namespace

SbRotation rotationOf(const Pose& attitude) {
  const SbRotation roll(SbVec3f(0.0F, 1.0F, 0.0F), static_cast<float>(attitude.roll));
  const SbRotation pitch(SbVec3f(1.0F, 0.0F, 0.0F), static_cast<float>(attitude.pitch));
  const SbRotation heading(SbVec3f(0.0F, 0.0F, 1.0F), static_cast<float>(-attitude.heading));
  return roll * pitch * heading;  // Inventor applies the left one first
}

AircraftModel::AircraftModel(const SbColor& paint)
    : root_(new SoSwitch), transform_(new SoTransform), propeller_(new SoRotation) {
  root_->ref();
  root_->whichChild = SO_SWITCH_ALL;
  auto* model = new SoSeparator;
  model->renderCaching = SoSeparator::OFF;
  model->addChild(transform_);
  auto* hints = new SoShapeHints;
  hints->vertexOrdering = SoShapeHints::COUNTERCLOCKWISE;  // with an unknown shape type: lit on both sides
  hints->faceType = SoShapeHints::CONVEX;
  hints->creaseAngle = 0.9F;
  model->addChild(hints);
  model->addChild(fuselage(paint));
  model->addChild(wings(paint));
  model->addChild(propeller(propeller_));
  root_->addChild(model);
}

AircraftModel::~AircraftModel() {
  root_->unref();
}

void AircraftModel::setVisible(bool visible) {
  root_->whichChild = visible ? SO_SWITCH_ALL : SO_SWITCH_NONE;
}

void AircraftModel::show(const SbVec3f& place, const Pose& attitude, double dt) {
  transform_->translation = place;
  transform_->rotation = rotationOf(attitude);
  propellerTurn_ = std::fmod(propellerTurn_ + kPropellerRate * dt, 2.0 * std::numbers::pi);
  propeller_->rotation = SbRotation(SbVec3f(0.0F, 1.0F, 0.0F), static_cast<float>(propellerTurn_));
}

}  // namespace teren
