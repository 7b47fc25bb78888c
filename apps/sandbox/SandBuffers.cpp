#include "apps/sandbox/SandBuffers.h"

#include <utility>

#include "coin/OpenGL.h"

namespace teren {
namespace {

constexpr std::size_t kVertexPageBytes = sizeof(SandVertexPage);
constexpr std::size_t kCornerBytes = sizeof(SandTrianglePage::corners);

}  // namespace

void SandBuffers::follow(std::shared_ptr<const SandSnapshot> sand) {
  if (sand == sand_) return;
  const SandSnapshot none;
  const SandSnapshot& last = sand_ ? *sand_ : none;
  const auto& vertexPages = sand->vertexPages();
  const auto& trianglePages = sand->trianglePages();
  const bool fresh =
      reserve(vertices_, GL_ARRAY_BUFFER, vertexPages.size() * kVertexPageBytes, kVertexPageBytes);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.name);
  vertexPages.forEachDifference((fresh ? none : last).vertexPages(), [&](std::size_t i) {
    upload(GL_ARRAY_BUFFER, i * kVertexPageBytes, &vertexPages[i], kVertexPageBytes);
  });
  const bool freshToo =
      reserve(triangles_, GL_ELEMENT_ARRAY_BUFFER, trianglePages.size() * kCornerBytes, kCornerBytes);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, triangles_.name);
  trianglePages.forEachDifference((freshToo ? none : last).trianglePages(), [&](std::size_t i) {
    upload(GL_ELEMENT_ARRAY_BUFFER, i * kCornerBytes, trianglePages[i].corners.data(), kCornerBytes);
  });
  sand_ = std::move(sand);
}

/// Makes a buffer large enough; true where it is another one now, with nothing in it.
bool SandBuffers::reserve(Buffer& buffer, unsigned target, std::size_t bytes, std::size_t spare) {
  if (buffer.name != 0 && bytes <= buffer.bytes) return false;
  if (buffer.name != 0) glDeleteBuffers(1, &buffer.name);
  buffer.bytes = bytes + bytes / 8 + 8 * spare;
  glGenBuffers(1, &buffer.name);
  glBindBuffer(target, buffer.name);
  glBufferData(target, static_cast<GLsizeiptr>(buffer.bytes), nullptr, GL_DYNAMIC_DRAW);
  return true;
}

void SandBuffers::upload(unsigned target, std::size_t offset, const void* data, std::size_t bytes) {
  glBufferSubData(target, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
  uploaded_ += bytes;
}

void SandBuffers::bind() const {
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.name);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, triangles_.name);
}

void SandBuffers::clear() {
  for (Buffer* buffer : {&vertices_, &triangles_}) {
    if (buffer->name != 0) glDeleteBuffers(1, &buffer->name);
    *buffer = {};
  }
  sand_.reset();
}

}  // namespace teren
