// Draws snapshots in any number of GL contexts and sees to it that each context gets its objects back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>

#include "coin/TerrainPainter.h"

namespace teren {

/// One painter per GL context, made at the first drawing there: with shaders where the context has them and
/// TEREN_NO_SHADERS is not 1, else the plain one. A context that dies takes its painter along; when the
/// renderer dies first, what it left in a context is deleted at that context's next drawing, by Inventor.
class TerrainRenderer {
 public:
  TerrainRenderer();
  ~TerrainRenderer();
  TerrainRenderer(const TerrainRenderer&) = delete;
  TerrainRenderer& operator=(const TerrainRenderer&) = delete;

  /// What of a picture's wishes were met: those that take shaders.
  struct Drawn {
    bool logarithmicDepth = false, movedVertices = false;
  };
  /// Draws in the current context, whose number Inventor knows as `context`.
  Drawn draw(std::uint32_t context, const Picture& picture, std::span<const Mesh* const> meshes);
  /// Must be called before a mesh that was drawn dies.
  void forget(const Mesh& mesh);
  /// [bytes] in GL's buffers, of all contexts.
  std::size_t bytes() const noexcept;

 private:
  static void contextDies(std::uint32_t context, void* renderer);

  std::map<std::uint32_t, std::unique_ptr<TerrainPainter>> painters_;
};

}  // namespace teren
