#include "apps/sandbox/SandPlainPainter.h"

#include <cmath>

#include "coin/OpenGL.h"

namespace teren {
namespace {

std::uint8_t asByte(float value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 1.0F) * 255.0F + 0.5F);
}

/// The shaders' light, stretched as there.
float stretchedLight(const SbVec3f& normal, const SbVec3f& sun) {
  const float lit =
      SandLook::kSky * (0.5F + 0.5F * normal[2]) + (1.0F - SandLook::kSky) * std::max(normal.dot(sun), 0.0F);
  const float stretched = (lit - SandLook::kCut) / (1.0F - 2.0F * SandLook::kCut);
  const float t = std::clamp((stretched + 0.25F) / 1.5F, 0.0F, 1.0F);
  return t * t * (3.0F - 2.0F * t);
}

}  // namespace

SandPlainPainter::Vertex SandPlainPainter::vertexOf(const SandPicture& picture, const SandVertex& vertex,
                                                    float side) {
  const auto step = static_cast<float>(picture.sand->frame().step);
  const float x = static_cast<float>(vertex.normal[0]) / 32767.0F;
  const float y = static_cast<float>(vertex.normal[1]) / 32767.0F;
  const SbVec3f normal(x, y, std::sqrt(std::max(1.0F - x * x - y * y, 0.0F)));
  const float light = stretchedLight(normal, picture.sun);
  const float loose = std::clamp(vertex.loose / (SandLook::kHiding * side), 0.0F, 1.0F);
  const SbVec3f own = SandLook::kSolid + (SandLook::kLoose - SandLook::kSolid) * loose;
  const float wet = 1.0F + (SandLook::kWet - 1.0F) * picture.moisture;
  Vertex made{static_cast<float>(vertex.place.x) * step,
              static_cast<float>(vertex.place.y) * step,
              vertex.height,
              {0, 0, 0, 255}};
  for (int i = 0; i < 3; ++i) {
    const float full = SandLook::kLight[i] * picture.sunlight[i];
    made.colour[static_cast<std::size_t>(i)] =
        asByte(own[i] * wet * (SandLook::kShade[i] + (full - SandLook::kShade[i]) * light));
  }
  return made;
}

void SandPlainPainter::follow(const SandPicture& picture) {
  const bool same = last_.sand && last_.sun == picture.sun && last_.sunlight == picture.sunlight &&
                    last_.moisture == picture.moisture && last_.sand->frame() == picture.sand->frame();
  const SandSnapshot none;
  const auto& pages = picture.sand->vertexPages();
  const float side = sideOf(*picture.sand);
  vertices_.resize(pages.size() * SandVertexPage::kSlots);
  pages.forEachDifference((same ? *last_.sand : none).vertexPages(), [&](std::size_t i) {
    for (std::size_t k = 0; k < SandVertexPage::kSlots; ++k) {
      vertices_[i * SandVertexPage::kSlots + k] = vertexOf(picture, pages[i].vertices[k], side);
    }
  });
  last_ = picture;
}

void SandPlainPainter::draw(const SandPicture& picture) {
  follow(picture);
  if (vertices_.empty()) return;
  glPushAttrib(GL_COLOR_BUFFER_BIT | GL_CURRENT_BIT | GL_DEPTH_BUFFER_BIT | GL_ENABLE_BIT | GL_LINE_BIT |
               GL_POLYGON_BIT);
  glPushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT);
  glDisable(GL_LIGHTING);
  glDisable(GL_TEXTURE_2D);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_COLOR_ARRAY);
  drawSides(picture);
  pointTo(vertices_.front());
  if (picture.wireframe) {
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.0F, 1.0F);
  }
  drawTriangles(picture);
  if (picture.wireframe) {
    drawWire(picture);
  } else {
    constrained_.clear();
  }
  glPopClientAttrib();
  glPopAttrib();
}

void SandPlainPainter::pointTo(const Vertex& first) {
  glVertexPointer(3, GL_FLOAT, sizeof(Vertex), &first.x);
  glColorPointer(4, GL_UNSIGNED_BYTE, sizeof(Vertex), first.colour.data());
}

void SandPlainPainter::drawSides(const SandPicture& picture) {
  const float side = sideOf(*picture.sand);
  std::vector<Vertex> walls;
  for (const SandVertex& vertex : sides_.of(picture.sand)) walls.push_back(vertexOf(picture, vertex, side));
  if (walls.empty()) return;
  pointTo(walls.front());
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(walls.size()));
}

void SandPlainPainter::drawWire(const SandPicture& picture) {
  glDisableClientState(GL_COLOR_ARRAY);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_LEQUAL);
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glLineWidth(1.0F);
  glColor4fv(SandLook::kWire);
  drawTriangles(picture);
  glLineWidth(SandLook::kConstrainedWidth);
  glColor4fv(SandLook::kConstrained);
  const std::vector<VertexId>& edges = constrained_.of(picture.sand);
  glDrawElements(GL_LINES, static_cast<GLsizei>(edges.size()), GL_UNSIGNED_INT, edges.data());
}

void SandPlainPainter::drawTriangles(const SandPicture& picture) const {
  const auto& pages = picture.sand->trianglePages();
  for (const PageRun& run : visibleRuns(*picture.sand, picture.toClip)) {
    for (std::size_t i = run.first; i < run.first + run.count; ++i) {
      glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * SandTrianglePage::kSlots), GL_UNSIGNED_INT,
                     pages[i].corners.data());
    }
  }
}

}  // namespace teren
