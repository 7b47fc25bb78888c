// An eye and what it sees, drawn as lines: for those who look at it from outside.
#pragma once

#include <Inventor/SbRotation.h>
#include <Inventor/SbVec3f.h>

class SoCoordinate3;
class SoSwitch;
class SoTranslation;

namespace teren {

/// A pyramid from the eye through the corners of its picture, with the picture's frame at several distances.
class SightLines {
 public:
  SightLines();
  ~SightLines();
  SightLines(const SightLines&) = delete;
  SightLines& operator=(const SightLines&) = delete;

  SoSwitch* node() const noexcept { return root_; }
  void hide();
  /// `turn`: of a camera that looks down its -z axis. `fieldOfView` [rad] of the picture's height, `aspect`
  /// its width by its height, `length` [m] of the pyramid.
  void show(const SbRotation& turn, double fieldOfView, double aspect, double length);
  /// Where the eye is now, in scene coordinates.
  void moveTo(const SbVec3f& eye);

 private:
  SoSwitch* root_;  // referenced
  SoTranslation* place_;
  SoCoordinate3* points_;
};

}  // namespace teren
