// Draws sand without shaders, for OpenGL before 2.1 and for TEREN_NO_SHADERS=1: lit by the processor, and
// without grain.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "apps/sandbox/SandEdges.h"
#include "apps/sandbox/SandPainter.h"
#include "apps/sandbox/SandSides.h"

namespace teren {

/// Keeps, in the program's own memory, the vertices it has drawn: 16 bytes each. Pages that differ are made
/// again, all of them when light, moisture or the box change.
class SandPlainPainter final : public SandPainter {
 public:
  SandPlainPainter() = default;

  void draw(const SandPicture& picture) override;
  void release() override { *this = {}; }
  std::size_t bytes() const noexcept override { return 0; }
  std::size_t uploaded() const noexcept override { return 0; }

 private:
  struct Vertex {
    float x = 0.0F, y = 0.0F, z = 0.0F;
    std::array<std::uint8_t, 4> colour{};
  };
  static Vertex vertexOf(const SandPicture& picture, const SandVertex& vertex, float side);
  void follow(const SandPicture& picture);
  static void pointTo(const Vertex& first);
  void drawSides(const SandPicture& picture);
  void drawTriangles(const SandPicture& picture) const;
  void drawWire(const SandPicture& picture);

  SandPicture last_;
  SandEdges constrained_{SandEdges::Kind::constrained};
  SandSides sides_;
  std::vector<Vertex> vertices_;
};

}  // namespace teren
