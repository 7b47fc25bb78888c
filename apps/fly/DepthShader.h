// Makes shapes write the logarithmic depth that SoTerrain writes, so that they and the land hide each other.
#pragma once

#include <Inventor/SbVec2f.h>

class SoSeparator;
class SoShaderParameter2f;
class SoSwitch;

namespace teren {

/// A separator for shapes that OpenGL lights by itself, without textures. While it is on, a fragment shader
/// takes their colours as they come and writes the depth.
class DepthShader {
 public:
  DepthShader();
  ~DepthShader();
  DepthShader(const DepthShader&) = delete;
  DepthShader& operator=(const DepthShader&) = delete;

  /// To be put into the scene once; shapes are its children.
  SoSeparator* node() const noexcept { return root_; }

  /// May be called while the scene is being drawn, before it comes to node().
  void turnOn(bool on);
  /// The camera's clipping planes [m].
  void setPlanes(float nearest, float farthest);

 private:
  SoSeparator* root_;  // referenced
  SoSwitch* switch_;
  SoShaderParameter2f* scale_;
};

}  // namespace teren
