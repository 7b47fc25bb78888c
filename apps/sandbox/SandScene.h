// The scene graph of a sandbox: light, sand, and the outline of a tool.
#pragma once

#include <cstddef>
#include <memory>

#include "generators/sand/SandSnapshot.h"
#include "generators/sand/Stamper.h"
#include "generators/sand/ToolShape.h"

class SoCoordinate3;
class SoLineSet;
class SoSandShape;
class SoSeparator;
class SoSwitch;

namespace teren {

/// Make it after SoDB::init; it must go before Coin does. Coordinates are those of SoSandShape: metres from
/// the south-west corner of the sand's box, and absolute height. The camera is the viewer's.
class SandScene {
 public:
  SandScene();
  ~SandScene();
  SandScene(const SandScene&) = delete;
  SandScene& operator=(const SandScene&) = delete;

  SoSeparator* node() const noexcept { return root_; }

  void show(std::shared_ptr<const SandSnapshot> sand);
  /// Edges over the sand, constrained ones red.
  void setWireframe(bool wireframe);
  /// 0 ... 1; what is beyond counts as the nearer of these, NaN as 0.
  void setMoisture(double moisture);
  /// Marks where the tool would cut the ground: its outer outlines, draped over the sand as it is shown, and
  /// seen through hills. What lies beyond the sand is left out.
  void setTool(const ToolShape& tool, const StampPlace& place);
  void hideTool();

  /// [bytes] of GL's buffers for the sand, and uploaded to them so far.
  std::size_t bufferBytes() const;
  std::size_t uploadedBytes() const;

 private:
  void addLight();
  void addTool();

  SoSeparator* root_;  // referenced
  SoSandShape* sand_;
  SoSwitch* tool_;
  SoCoordinate3* outline_;
  SoLineSet* lines_;
};

}  // namespace teren
