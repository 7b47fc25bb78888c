#include "coin/TerrainBuffers.h"

#include <cassert>

#include "coin/OpenGL.h"

namespace teren {

void TerrainBuffers::frame() {
  uploaded_ = 0;
  std::size_t freed = 0;
  while (!retired_.empty()) {
    const Buffer& buffer = retired_.back();
    if (freed != 0 && freed + buffer.bytes > quota_) break;
    freed += buffer.bytes;
    bytes_ -= buffer.bytes;
    glDeleteBuffers(1, &buffer.name);
    retired_.pop_back();
  }
}

TerrainBuffers::Start TerrainBuffers::bind(const Mesh& mesh) {
  const TriangleIndices& list = *mesh.indices;
  auto vertices = vertices_.find(&mesh);
  auto indices = indices_.find(&list);
  if (vertices == vertices_.end()) {
    const std::size_t vertexBytes = mesh.vertices.size() * sizeof(SurfaceVertex);
    const std::size_t indexBytes =
        indices == indices_.end() ? list.size() * sizeof(TriangleIndices::value_type) : 0;
    if (!allows(vertexBytes + indexBytes)) {
      glBindBuffer(GL_ARRAY_BUFFER, 0);
      glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
      return {reinterpret_cast<const std::byte*>(mesh.vertices.data()), list.data()};
    }
    vertices = vertices_.emplace(&mesh, upload(GL_ARRAY_BUFFER, mesh.vertices.data(), vertexBytes)).first;
    if (indices == indices_.end()) {
      indices = indices_.emplace(&list, upload(GL_ELEMENT_ARRAY_BUFFER, list.data(), indexBytes)).first;
    }
    ++indices->second.users;
  }
  glBindBuffer(GL_ARRAY_BUFFER, vertices->second.name);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices->second.name);
  return {nullptr, nullptr};
}

void TerrainBuffers::forget(const Mesh& mesh) {
  const auto vertices = vertices_.find(&mesh);
  if (vertices == vertices_.end()) return;
  retire(vertices->second);
  vertices_.erase(vertices);
  const auto indices = indices_.find(mesh.indices.get());
  assert(indices != indices_.end() && indices->second.users > 0);
  if (--indices->second.users > 0) return;
  retire(indices->second);
  indices_.erase(indices);
}

void TerrainBuffers::clear() {
  for (const auto& [mesh, buffer] : vertices_) retired_.push_back(buffer);
  for (const auto& [list, buffer] : indices_) retired_.push_back(buffer);
  vertices_.clear();
  indices_.clear();
  for (const Buffer& buffer : retired_) glDeleteBuffers(1, &buffer.name);
  retired_.clear();
  bytes_ = 0;
}

bool TerrainBuffers::allows(std::size_t bytes) noexcept {
  if (uploaded_ != 0 && uploaded_ + bytes > quota_) return false;
  uploaded_ += bytes;
  return true;
}

TerrainBuffers::Buffer TerrainBuffers::upload(unsigned target, const void* data, std::size_t bytes) {
  Buffer buffer;
  buffer.bytes = bytes;
  glGenBuffers(1, &buffer.name);
  glBindBuffer(target, buffer.name);
  glBufferData(target, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
  bytes_ += bytes;
  return buffer;
}

void TerrainBuffers::retire(const Buffer& buffer) {
  retired_.push_back(buffer);
}

}  // namespace teren
