#include "apps/fly/SkyDome.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <Inventor/nodes/SoDepthBuffer.h>
#include <Inventor/nodes/SoIndexedFaceSet.h>
#include <Inventor/nodes/SoLightModel.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShapeHints.h>
#include <Inventor/nodes/SoTranslation.h>
#include <Inventor/nodes/SoVertexProperty.h>

namespace teren {
namespace {

constexpr float kDegree = std::numbers::pi_v<float> / 180.0F;
constexpr int kSegments = 60;

/// Rings of vertices round an axis: ring r, segment s is vertex r * kSegments + s.
struct Rings {
  std::vector<SbVec3f> points;
  std::vector<std::uint32_t> colors;  // 0xRRGGBBAA
};

SbColor mixed(const SbColor& a, const SbColor& b, float share) {
  return a * (1.0F - share) + b * share;
}

// How blue the sky is at an elevation. The haze reaches some degrees up, so that mountains lost in it do not
// stand out against the sky; above it the air one looks through thins out quickly.
float clearness(float elevation) {
  const float sine = std::max(0.0F, std::sin(elevation));
  return 1.0F - std::exp(-2.6F * sine * sine / (sine + 0.16F));
}

Rings dome(const Daylight& light, const SbVec3f& sun) {
  constexpr std::array kElevations{-3.0F, 0.0F,  1.0F,  2.0F,  3.5F,  5.0F,  7.0F,  10.0F,
                                   14.0F, 19.0F, 25.0F, 33.0F, 43.0F, 55.0F, 70.0F, 90.0F};
  Rings rings;
  for (const float degrees : kElevations) {
    const float elevation = degrees * kDegree;
    for (int segment = 0; segment < kSegments; ++segment) {
      const float azimuth = 360.0F * kDegree * static_cast<float>(segment) / kSegments;
      const SbVec3f direction(std::cos(elevation) * std::sin(azimuth),
                              std::cos(elevation) * std::cos(azimuth), std::sin(elevation));
      const float towardsSun = std::max(0.0F, direction.dot(sun));
      SbColor color = mixed(light.haze, light.zenith, clearness(elevation));
      color =
          mixed(color, light.sunlight, 0.28F * towardsSun * towardsSun * towardsSun * clearness(elevation));
      rings.points.push_back(direction * SkyDome::kRadius);
      rings.colors.push_back(color.getPackedValue());
    }
  }
  return rings;
}

// The disc of the sun and the light scattered round it, fading out into nothing.
Rings glow(const Daylight& light, const SbVec3f& sun) {
  struct Ring {
    float degrees, opacity;
  };
  constexpr std::array<Ring, 11> kRings{{{0.0F, 1.0F},
                                         {0.9F, 1.0F},
                                         {1.2F, 0.72F},
                                         {1.8F, 0.52F},
                                         {3.0F, 0.38F},
                                         {5.0F, 0.26F},
                                         {8.0F, 0.16F},
                                         {12.0F, 0.09F},
                                         {17.0F, 0.045F},
                                         {23.0F, 0.015F},
                                         {32.0F, 0.0F}}};
  SbVec3f right = SbVec3f(0.0F, 0.0F, 1.0F).cross(sun);
  right.normalize();
  const SbVec3f up = sun.cross(right);
  Rings rings;
  for (const Ring& ring : kRings) {
    const float angle = ring.degrees * kDegree;
    const SbColor color = mixed(light.sunlight, SbColor(1.0F, 1.0F, 0.97F), ring.opacity);
    for (int segment = 0; segment < kSegments; ++segment) {
      const float turn = 360.0F * kDegree * static_cast<float>(segment) / kSegments;
      const SbVec3f sideways = right * std::cos(turn) + up * std::sin(turn);
      rings.points.push_back((sun * std::cos(angle) + sideways * std::sin(angle)) * SkyDome::kRadius);
      rings.colors.push_back(color.getPackedValue(1.0F - ring.opacity));
    }
  }
  return rings;
}

SoIndexedFaceSet* shape(const Rings& rings) {
  auto* vertices = new SoVertexProperty;
  const int count = static_cast<int>(rings.points.size());
  vertices->vertex.setValues(0, count, rings.points.data());
  vertices->orderedRGBA.setValues(0, count, rings.colors.data());
  vertices->materialBinding = SoVertexProperty::PER_VERTEX_INDEXED;
  std::vector<std::int32_t> faces;
  for (int ring = 0; ring + 1 < count / kSegments; ++ring) {
    for (int segment = 0; segment < kSegments; ++segment) {
      const int next = (segment + 1) % kSegments;
      const int low = ring * kSegments, high = low + kSegments;
      faces.insert(faces.end(), {low + segment, low + next, high + next, high + segment, -1});
    }
  }
  auto* set = new SoIndexedFaceSet;
  set->vertexProperty = vertices;
  set->coordIndex.setValues(0, static_cast<int>(faces.size()), faces.data());
  return set;
}

}  // namespace

SkyDome::SkyDome(const Daylight& light) : root_(new SoSeparator), place_(new SoTranslation) {
  root_->ref();
  root_->renderCaching = SoSeparator::OFF;
  root_->pickCulling = SoSeparator::OFF;
  auto* depth = new SoDepthBuffer;
  depth->test = FALSE;
  depth->write = FALSE;
  root_->addChild(depth);
  auto* unlit = new SoLightModel;
  unlit->model = SoLightModel::BASE_COLOR;
  root_->addChild(unlit);
  auto* hints = new SoShapeHints;
  hints->faceType = SoShapeHints::CONVEX;
  root_->addChild(hints);
  root_->addChild(place_);
  SbVec3f sun = light.sun;
  sun.normalize();
  auto* shapes = new SoSeparator;
  shapes->renderCaching = SoSeparator::ON;
  shapes->addChild(shape(dome(light, sun)));
  shapes->addChild(shape(glow(light, sun)));
  root_->addChild(shapes);
}

SkyDome::~SkyDome() {
  root_->unref();
}

void SkyDome::moveTo(const SbVec3f& eye) {
  place_->translation = eye;
}

}  // namespace teren
