// Draws the ground without shaders, for OpenGL before 2.1 and for TEREN_NO_SHADERS=1: coloured, lit and
// placed by the processor, hazed by GL's fog.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "coin/TerrainPainter.h"

namespace teren {

/// Keeps, in the program's own memory, the vertices of each mesh it has drawn: positions relative to an
/// anchor, made from whole numbers as the shaders do it, so that shared vertices are equal bit for bit. They
/// are placed again when the anchor changes, every kAnchorStep metres or so, and coloured again when the sun,
/// the water level or their mesh's tint does; 16 bytes a vertex.
class PlainPainter final : public TerrainPainter {
 public:
  PlainPainter() = default;
  static constexpr double kAnchorStep = 64.0;  ///< [m] halving it halves what a vertex strays on the screen

  bool knowsLogarithmicDepth() const noexcept override { return false; }
  bool movesVertices() const noexcept override { return false; }
  void draw(const Picture& picture, std::span<const Mesh* const> meshes) override;
  void forget(const Mesh& mesh) override { drawn_.erase(&mesh); }
  void release() override { drawn_.clear(); }
  std::size_t bytes() const noexcept override { return 0; }

 private:
  struct Vertex {
    float x, y, z;
    std::array<std::uint8_t, 4> colour;
  };
  struct Drawn {
    std::vector<Vertex> vertices;
    std::optional<SbColor> tint;  // that they have
  };
  static void colour(const Mesh& mesh, const Picture& picture, Drawn& drawn);
  void place(const Mesh& mesh, std::vector<Vertex>& vertices) const;
  void takeLook(const Picture& picture);
  void drawGround(const Picture& picture, std::span<const Mesh* const> meshes);

  Anchor anchor_;
  SbVec3f sun_{0.0F, 0.0F, 0.0F};
  SbVec3f sunlight_{0.0F, 0.0F, 0.0F};
  float waterLevel_ = 0.0F;
  double spacing_ = 0.0;
  std::unordered_map<const Mesh*, Drawn> drawn_;
};

}  // namespace teren
