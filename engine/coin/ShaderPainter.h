// Draws ground and water with GLSL: what SoTerrain looks like wherever OpenGL 2.1 is to be had.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>

#include "teren/Result.h"

#include "coin/DepthByVertex.h"
#include "coin/TerrainBuffers.h"
#include "coin/TerrainPainter.h"
#include "coin/WaterCells.h"
#include "coin/WaterDisc.h"

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
  static constexpr double kAnchorStep = 1.0;  ///< [m] of the anchors that vertices are counted from
  /// Fails where the context has no GLSL 1.20 or does not take the programs.
  static Result<std::unique_ptr<TerrainPainter>> create();

  bool knowsLogarithmicDepth() const noexcept override { return true; }
  bool movesVertices() const noexcept override { return true; }
  void draw(const Picture& picture, std::span<const Mesh* const> meshes) override;
  void forget(const Mesh& mesh) override;
  void release() override;
  std::size_t bytes() const noexcept override { return buffers_.bytes() + water_.bytes(); }

 private:
  ShaderPainter() = default;
  /// By the depth they write: ordinary; logarithmic, of fragments; logarithmic, of vertices.
  enum : std::size_t { kOrdinary, kByFragment, kByVertex, kDepths };
  enum : std::size_t { kPlain, kHighOrLowGround, kDistant, kTinted, kGrounds };
  enum : std::size_t { kRippledWater, kSmoothWater, kDeepWaterBelow, kWaters };
  struct Programs {
    std::array<ShaderProgram, kGrounds> ground;
    std::array<ShaderProgram, kWaters> water;
  };
  Result<void> link();
  static void prepare(const ShaderProgram& program, const Picture& picture, const Anchor& anchor,
                      const SbDPMatrix& toClip);
  void makeNoise();
  const ShaderProgram& programFor(const Mesh& mesh, const Picture& picture, const SbDPMatrix& toClip);
  void drawGround(const Picture& picture, const Sample& anchor, const SbDPMatrix& toClip,
                  std::span<const Mesh* const> meshes);
  void findWater(const Picture& picture);
  /// Before the ground: the opaque water, and behind everything what one sees deep in the clear water.
  void drawFarWater(const Picture& picture);
  /// After the ground.
  void drawClearWater(const Picture& picture);

  std::array<Programs, kDepths> programs_;
  TerrainBuffers buffers_;
  DepthByVertex depthByVertex_;
  WaterDisc water_;
  WaterCells cells_;  // with water in the picture that is being drawn
  unsigned noise_ = 0;
};

}  // namespace teren
