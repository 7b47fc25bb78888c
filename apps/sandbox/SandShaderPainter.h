// Draws sand with GLSL.
#pragma once

#include <memory>

#include "teren/Result.h"

#include "apps/sandbox/SandBuffers.h"
#include "apps/sandbox/SandEdges.h"
#include "apps/sandbox/SandPainter.h"
#include "apps/sandbox/SandSides.h"
#include "coin/ShaderPainter.h"

namespace teren {

/// Sand wherever OpenGL 2.1 is to be had.
class SandShaderPainter final : public SandPainter {
 public:
  /// Fails where the context does not take the programs.
  static Result<std::unique_ptr<SandPainter>> create();

  void draw(const SandPicture& picture) override;
  void release() override;
  std::size_t bytes() const noexcept override { return buffers_.bytes(); }
  std::size_t uploaded() const noexcept override { return buffers_.uploaded(); }

 private:
  SandShaderPainter() = default;
  void drawSand(const SandPicture& picture, const std::vector<PageRun>& runs);
  void drawWire(const SandPicture& picture, const std::vector<PageRun>& runs);

  ShaderProgram sand_, wire_;
  SandBuffers buffers_;
  SandEdges constrained_{SandEdges::Kind::constrained};
  SandSides sides_;
};

}  // namespace teren
