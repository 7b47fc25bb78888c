// Draws ground and water with GLSL: what SoTerrain looks like wherever OpenGL 2.1 is to be had.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "teren/Result.h"

#include "coin/TerrainBuffers.h"
#include "coin/TerrainPainter.h"

namespace teren {

/// A vertex and a fragment shader, linked. Uniforms that a program does not use are passed over, as GL does.
class ShaderProgram {
 public:
  ShaderProgram() = default;
  /// The fragment shader comes in pieces. `attributes` are bound to the numbers 0, 1, 2 ... in order. The
  /// error is GL's log, or that the context has no GLSL 1.20.
  static Result<ShaderProgram> link(const char* vertexShader, std::span<const char* const> fragmentShader,
                                    std::span<const char* const> attributes);
  void use() const;
  void set(const char* name, float value) const;
  void set(const char* name, float x, float y) const;
  void set(const char* name, const SbVec3f& value) const;
  void set(const char* name, std::span<const Morph::Range> ranges) const;
  void set(const char* name, const SbDPMatrix& matrix) const;
  void release();

 private:
  unsigned name_ = 0;
};

class ShaderPainter final : public TerrainPainter {
 public:
  /// Fails where the context has no GLSL 1.20 or does not take the programs.
  static Result<std::unique_ptr<TerrainPainter>> create();

  bool knowsLogarithmicDepth() const noexcept override { return true; }
  void draw(const Picture& picture, std::span<const Mesh* const> meshes) override;
  void forget(const Mesh& mesh) override { buffers_.forget(mesh); }
  void release() override;
  std::size_t bytes() const noexcept override { return buffers_.bytes() + waterBytes_; }

 private:
  ShaderPainter() = default;
  struct Programs {
    ShaderProgram ground, tinted, water, deep;
  };
  static Result<void> link(Programs& programs, const char* depth);
  const Programs& prepare(const Picture& picture, const Anchor& anchor) const;
  void makeNoise();
  void makeWater();
  /// `tints`: of every mesh, or empty where the program has none.
  void drawGround(const ShaderProgram& program, const Sample& anchor, std::span<const Mesh* const> meshes,
                  std::span<const SbColor> tints);
  /// Before the ground: the opaque water, and behind everything what one sees deep in the clear water.
  void drawFarWater(const Programs& programs) const;
  /// After the ground.
  void drawClearWater(const ShaderProgram& program) const;
  void drawRings(int first, int count) const;

  Programs ordinary_, logarithmic_;  // by the depth they write
  TerrainBuffers buffers_;
  unsigned noise_ = 0;
  unsigned waterVertices_ = 0, waterIndices_ = 0;
  std::size_t waterBytes_ = 0;
};

}  // namespace teren
