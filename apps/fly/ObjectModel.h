// A model of the engine's objects as Open Inventor nodes.
#pragma once

#include <vector>

#include <Inventor/SbRotation.h>
#include <Inventor/SbVec3f.h>

#include "teren/Object.h"

class SoRotation;
class SoSwitch;
class SoTransform;

namespace teren {

/// Turns a thing whose nose points north and whose top points up into the attitude's direction.
SbRotation rotationOf(const Attitude& attitude);

/// Shows one object; does not need its Model any more once it is made.
class ObjectModel {
 public:
  explicit ObjectModel(const Model& model);
  ~ObjectModel();
  ObjectModel(const ObjectModel&) = delete;
  ObjectModel& operator=(const ObjectModel&) = delete;

  SoSwitch* node() const noexcept { return root_; }
  void setVisible(bool visible);
  /// `place` is the object's in scene coordinates; what spins turns on by `dt` [s].
  void show(const SbVec3f& place, const Attitude& attitude, double dt);

 private:
  struct SpinningPart {
    SoRotation* rotation;
    double rate;        // [rad/s]
    double turn = 0.0;  // [rad]
  };

  SoSwitch* root_;  // referenced
  SoTransform* transform_;
  std::vector<SpinningPart> spinning_;
};

}  // namespace teren
