#include "coin/WaterDisc.h"

#include <cmath>
#include <numbers>

#include "coin/OpenGL.h"

namespace teren {
namespace {

constexpr int kRings = WaterCells::kRings, kSectors = WaterCells::kSectors;

/// x and y of the disc's vertices: the centre, then ring by ring.
std::vector<float> discVertices() {
  std::vector<float> vertices{0.0F, 0.0F};
  for (int ring = 1; ring <= kRings; ++ring) {
    const auto radius = static_cast<double>(WaterCells::radius(ring));
    for (int sector = 0; sector < kSectors; ++sector) {
      const double angle = 2.0 * std::numbers::pi * sector / kSectors;
      vertices.push_back(static_cast<float>(radius * std::cos(angle)));
      vertices.push_back(static_cast<float>(radius * std::sin(angle)));
    }
  }
  return vertices;
}

std::uint16_t vertexAt(int circle, int sector) {
  return static_cast<std::uint16_t>(circle == 0 ? 0 : 1 + (circle - 1) * kSectors + sector % kSectors);
}

void addCell(int ring, int sector, std::vector<std::uint16_t>& triangles) {
  const std::uint16_t inner = vertexAt(ring, sector);
  const std::uint16_t outer = vertexAt(ring + 1, sector), nextOuter = vertexAt(ring + 1, sector + 1);
  triangles.insert(triangles.end(), {inner, outer, nextOuter});
  if (ring > 0) triangles.insert(triangles.end(), {inner, nextOuter, vertexAt(ring, sector + 1)});
}

}  // namespace

void WaterDisc::make() {
  const std::vector<float> vertices = discVertices();
  bytes_ = vertices.size() * sizeof(float);
  glGenBuffers(1, &vertices_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes_), vertices.data(), GL_STATIC_DRAW);
}

void WaterDisc::release() {
  glDeleteBuffers(1, &vertices_);
  vertices_ = 0;
  bytes_ = 0;
}

void WaterDisc::draw(const WaterCells& cells, int first, int count, unsigned attribute) {
  triangles_.clear();
  for (int ring = first; ring < first + count; ++ring) {
    for (int sector = 0; sector < kSectors; ++sector) {
      if (cells.has(ring, sector)) addCell(ring, sector, triangles_);
    }
  }
  if (triangles_.empty()) return;
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
  glEnableVertexAttribArray(attribute);
  glVertexAttribPointer(attribute, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(triangles_.size()), GL_UNSIGNED_SHORT, triangles_.data());
  glDisableVertexAttribArray(attribute);
}

}  // namespace teren
