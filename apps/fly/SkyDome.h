// The sky behind everything: haze at the horizon, blue above, and a glow round the sun.
#pragma once

#include <Inventor/SbVec3f.h>

#include "apps/fly/Daylight.h"

class SoSeparator;
class SoTranslation;

namespace teren {

/// A dome of kRadius metres round the eye, drawn first and without touching the depth buffer, so everything
/// else lies before it. The camera's clipping planes must leave room for the radius.
class SkyDome {
 public:
  static constexpr float kRadius = 100.0F;

  explicit SkyDome(const Daylight& light);
  ~SkyDome();
  SkyDome(const SkyDome&) = delete;
  SkyDome& operator=(const SkyDome&) = delete;

  /// To be put into the scene right after the camera.
  SoSeparator* node() const noexcept { return root_; }
  void moveTo(const SbVec3f& eye);

 private:
  SoSeparator* root_;  // referenced
  SoTranslation* place_;
};

}  // namespace teren
