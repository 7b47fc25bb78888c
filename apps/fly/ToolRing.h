// A ring on the ground: where a tool would press, and how large.
#pragma once

#include <span>

#include <Inventor/SbVec3f.h>

class SoCoordinate3;
class SoSwitch;
class SoTranslation;

namespace teren {

/// A closed line and a cross in its middle, drawn over the land whatever the depth there, so that no part of
/// it sinks into the ground or flickers; what is drawn after it hides it.
class ToolRing {
 public:
  static constexpr int kPoints = 96;  ///< around

  ToolRing();
  ~ToolRing();
  ToolRing(const ToolRing&) = delete;
  ToolRing& operator=(const ToolRing&) = delete;

  /// Between the land and what may hide the ring.
  SoSwitch* node() const noexcept { return root_; }
  void hide();
  /// `around`: kPoints points. `cross`: the ends of two lines. All relative to `place`, which is in scene
  /// coordinates.
  void show(const SbVec3f& place, std::span<const SbVec3f> around, std::span<const SbVec3f, 4> cross);

 private:
  SoSwitch* root_;  // referenced
  SoTranslation* place_;
  SoCoordinate3* points_;
};

}  // namespace teren
