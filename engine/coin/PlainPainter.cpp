#include "coin/PlainPainter.h"

#include <algorithm>
#include <cmath>

#include "coin/OpenGL.h"

namespace teren {
namespace {

SbVec3f mix(const SbVec3f& from, const SbVec3f& to, float share) {
  return from + (to - from) * share;
}

float smoothStep(float from, float to, float value) {
  const float t = std::clamp((value - from) / (to - from), 0.0F, 1.0F);
  return t * t * (3.0F - 2.0F * t);
}

/// The shaders' palette without its noise.
SbVec3f groundColour(float height, float steep, float depth) {
  SbVec3f colour = mix({0.32F, 0.37F, 0.16F}, {0.43F, 0.41F, 0.27F}, smoothStep(120.0F, 380.0F, height));
  colour = mix(colour, {0.43F, 0.40F, 0.37F}, smoothStep(0.55F, 0.80F, steep));
  colour = mix(colour, {0.93F, 0.95F, 0.99F},
               smoothStep(420.0F, 480.0F, height) * (1.0F - smoothStep(0.70F, 1.05F, steep)));
  return mix(colour, {0.74F, 0.67F, 0.50F},
             smoothStep(-7.0F, -2.5F, depth) * (1.0F - smoothStep(0.45F, 0.75F, steep)));
}

std::array<std::uint8_t, 4> asBytes(const SbVec3f& colour) {
  const auto byte = [](float value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 1.0F) * 255.0F + 0.5F);
  };
  return {byte(colour[0]), byte(colour[1]), byte(colour[2]), 255};
}

void loadMatrix(GLenum mode, const SbDPMatrix& matrix) {
  std::array<double, 16> values{};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      values[static_cast<std::size_t>(row * 4 + column)] = matrix[row][column];
    }
  }
  glMatrixMode(mode);
  glPushMatrix();
  glLoadMatrixd(values.data());
}

void setUpFog(const Picture& picture) {
  const std::array<float, 4> haze{picture.haze[0], picture.haze[1], picture.haze[2], 1.0F};
  glEnable(GL_FOG);
  glFogi(GL_FOG_MODE, GL_LINEAR);
  glFogf(GL_FOG_START, 0.0F);
  glFogf(GL_FOG_END, picture.viewDistance);
  glFogfv(GL_FOG_COLOR, haze.data());
}

/// A square of opaque water, hazed by the same fog at its corners: cut into rows, so that the fog is right
/// inside too. `eye` and `level` are counted from the anchor.
void drawWater(const Picture& picture, const SbVec3f& eye, float level) {
  constexpr int kCuts = 32;
  const float step = 2.0F * picture.viewDistance / kCuts;
  const SbVec3f corner(eye[0] - picture.viewDistance, eye[1] - picture.viewDistance, level);
  glColor3f(0.16F, 0.32F, 0.44F);
  for (int row = 0; row < kCuts; ++row) {
    glBegin(GL_TRIANGLE_STRIP);
    for (int column = 0; column <= kCuts; ++column) {
      const float x = corner[0] + step * static_cast<float>(column);
      glVertex3f(x, corner[1] + step * static_cast<float>(row + 1), corner[2]);
      glVertex3f(x, corner[1] + step * static_cast<float>(row), corner[2]);
    }
    glEnd();
  }
}

}  // namespace

void PlainPainter::colour(const Mesh& mesh, const Picture& picture, Drawn& drawn) {
  drawn.vertices.resize(mesh.vertices.size());
  for (std::size_t k = 0; k < drawn.vertices.size(); ++k) {
    const SurfaceVertex& vertex = mesh.vertices[k];
    const float x = static_cast<float>(vertex.normalX) / 32767.0F;
    const float y = static_cast<float>(vertex.normalY) / 32767.0F;
    const float up = std::sqrt(std::max(1.0F - x * x - y * y, 1e-4F));
    const float direct = std::max(SbVec3f(x, y, up).dot(picture.sun), 0.0F);
    if (drawn.tint) {
      drawn.vertices[k].colour = asBytes(*drawn.tint * (0.45F + 0.55F * direct));
      continue;
    }
    const SbVec3f light = SbVec3f(0.40F, 0.46F, 0.56F) + picture.sunlight * direct;
    const SbVec3f colour =
        groundColour(vertex.height, std::sqrt(x * x + y * y) / up, picture.waterLevel - vertex.height);
    drawn.vertices[k].colour = asBytes({colour[0] * light[0], colour[1] * light[1], colour[2] * light[2]});
  }
}

void PlainPainter::place(const Mesh& mesh, std::vector<Vertex>& vertices) const {
  const auto column = static_cast<float>(mesh.originColumn - anchor_.sample.column);
  const auto row = static_cast<float>(mesh.originRow - anchor_.sample.row);
  const auto step = static_cast<float>(std::int64_t{1} << mesh.level);
  const auto spacing = static_cast<float>(spacing_);
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const SurfaceVertex& from = mesh.vertices[k];
    vertices[k].x = (static_cast<float>(from.column) * step + column) * spacing;
    vertices[k].y = (static_cast<float>(from.row) * step + row) * spacing;
    vertices[k].z = from.height - anchor_.height;
  }
}

/// What is kept must fit the picture.
void PlainPainter::takeLook(const Picture& picture) {
  const double spacing = picture.placement.spacing();
  if (sun_ != picture.sun || sunlight_ != picture.sunlight || waterLevel_ != picture.waterLevel ||
      spacing_ != spacing) {
    drawn_.clear();
    sun_ = picture.sun;
    sunlight_ = picture.sunlight;
    waterLevel_ = picture.waterLevel;
    spacing_ = spacing;
  }
  const Anchor anchor = picture.placement.anchorNear(picture.eye, kAnchorStep);
  if (anchor == anchor_) return;
  anchor_ = anchor;
  for (auto& [mesh, drawn] : drawn_) place(*mesh, drawn.vertices);
}

void PlainPainter::draw(const Picture& picture, std::span<const Mesh* const> meshes) {
  takeLook(picture);
  const SbVec3d away = picture.placement.position(anchor_) - picture.eye;
  SbDPMatrix toEye;
  toEye.setTranslate(away);
  toEye.multRight(picture.toEye);

  glPushAttrib(GL_COLOR_BUFFER_BIT | GL_CURRENT_BIT | GL_ENABLE_BIT | GL_FOG_BIT | GL_LIGHTING_BIT |
               GL_TRANSFORM_BIT);
  glPushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT);
  loadMatrix(GL_PROJECTION, picture.toClip);
  loadMatrix(GL_MODELVIEW, toEye);
  glDisable(GL_LIGHTING);
  glDisable(GL_TEXTURE_2D);
  glDisable(GL_BLEND);
  setUpFog(picture);
  drawGround(picture, meshes);
  if (!picture.wet.empty()) drawWater(picture, SbVec3f(-away), picture.waterLevel - anchor_.height);
  glMatrixMode(GL_PROJECTION);
  glPopMatrix();
  glMatrixMode(GL_MODELVIEW);
  glPopMatrix();
  glPopClientAttrib();
  glPopAttrib();
}

void PlainPainter::drawGround(const Picture& picture, std::span<const Mesh* const> meshes) {
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_COLOR_ARRAY);
  for (std::size_t index = 0; index < meshes.size(); ++index) {
    const Mesh* mesh = meshes[index];
    const auto tint = picture.tints.empty() ? std::nullopt : std::optional(picture.tints[index]);
    const auto [found, isNew] = drawn_.try_emplace(mesh);
    Drawn& drawn = found->second;
    if (isNew || drawn.tint != tint) {
      drawn.tint = tint;
      colour(*mesh, picture, drawn);
    }
    if (isNew) place(*mesh, drawn.vertices);
    const std::vector<Vertex>& vertices = drawn.vertices;
    glVertexPointer(3, GL_FLOAT, sizeof(Vertex), &vertices.front().x);
    glColorPointer(4, GL_UNSIGNED_BYTE, sizeof(Vertex), vertices.front().colour.data());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(mesh->indices->size()), GL_UNSIGNED_INT,
                   mesh->indices->data());
  }
}

}  // namespace teren
