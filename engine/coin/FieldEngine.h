// The engine of a SoTerrain that lives by its fields: made from them, and following the eye.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include <Inventor/SbBox3f.h>
#include <Inventor/SbVec3d.h>

#include "teren/Engine.h"

#include "coin/EyeObject.h"
#include "coin/FieldWorld.h"

namespace teren {

/// Nothing at first; then an engine made from the last good fields.
class FieldEngine {
 public:
  /// Puts an engine for these fields in the place of the present one, which stays where there is an error.
  Result<void> make(const TerrainFields& fields);
  void drop() noexcept;

  /// nullptr where there is none.
  Engine* engine() const noexcept { return engine_.get(); }

  /// Puts the viewpoint [m, world]; one beyond the world's end leaves it where it was. It outlives the
  /// engine.
  void putEye(const SbVec3d& point);

  /// The picture [px] and the angle [radian] it shows, which detail by error depends on; what cannot be is
  /// ignored. They outlive the engine. True where other detail is wanted now.
  bool fitPicture(double lines, double fieldOfView);

  /// One update of the engine (there must be one); whether it should be followed by another although the eye
  /// stands still: something is missing, or is still to be measured.
  bool update(double dt, std::chrono::nanoseconds budget);
  void settle();

  /// 3 x 3 patches around the viewpoint, at the world's mean +- 3 deviations, relative to `origin`: the best
  /// guess at what will be there. Empty without an engine.
  SbBox3f expectedBox(const SbVec3d& origin) const;

 private:
  bool tellPicture();
  std::unique_ptr<Engine> engine_;
  EyeObject* eye_ = nullptr;  // the engine's
  SbVec3d point_{0.0, 0.0, 0.0};
  double lines_ = DetailSettings{}.lines, fieldOfView_ = DetailSettings{}.fieldOfView;
};

}  // namespace teren
