// The vertex and index buffers of one GL context: counted, made and freed under a quota of bytes per frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "teren/Scene.h"

namespace teren {

/// Keeps a vertex buffer for each mesh it was asked to bind, and one index buffer for each index list, shared
/// by all meshes that use the list. What the quota does not allow this frame is drawn straight from the
/// mesh's own memory, so a mesh is never missing for want of a buffer. Meshes are known by their address:
/// whoever uses this class keeps each mesh alive until it has called forget(). Construction needs no context;
/// frame(), bind() and clear() need this object's context to be the current one.
class TerrainBuffers {
 public:
  /// Bytes that may be uploaded in a frame, and bytes that may be freed in one; a single mesh that is larger
  /// is still done, alone. A scene of 169 nodes of 32 x 32 intervals has about 2.5 MB.
  static constexpr std::size_t kQuota = std::size_t{1} << 20;

  explicit TerrainBuffers(std::size_t quota = kQuota) noexcept : quota_(quota) {}
  TerrainBuffers(const TerrainBuffers&) = delete;
  TerrainBuffers& operator=(const TerrainBuffers&) = delete;

  /// Begins a frame: the quota is whole again, and buffers of forgotten meshes are freed.
  void frame();

  /// What to give glVertexAttribPointer and glDrawElements as the start of vertices and indices: offsets into
  /// the buffers now bound, or addresses where none is.
  struct Start {
    const std::byte* vertices;
    const void* indices;
  };
  /// Binds the buffers of a mesh to GL_ARRAY_BUFFER and GL_ELEMENT_ARRAY_BUFFER.
  Start bind(const Mesh& mesh);

  /// The mesh will not be drawn again; its buffers are freed in frames to come. Needs no context.
  void forget(const Mesh& mesh);

  /// Frees everything at once.
  void clear();

  /// [bytes] in buffers, those that wait to be freed included.
  std::size_t bytes() const noexcept { return bytes_; }

 private:
  struct Buffer {
    unsigned name = 0;
    std::size_t bytes = 0;
    std::size_t users = 0;
  };

  bool allows(std::size_t bytes) noexcept;
  Buffer upload(unsigned target, const void* data, std::size_t bytes);
  void retire(const Buffer& buffer);

  std::size_t quota_;
  std::size_t uploaded_ = 0;  // in this frame
  std::size_t bytes_ = 0;
  std::unordered_map<const Mesh*, Buffer> vertices_;
  std::unordered_map<const TriangleIndices*, Buffer> indices_;
  std::vector<Buffer> retired_;
};

}  // namespace teren
