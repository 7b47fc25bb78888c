// The aircraft as one sees it from outside: a small low-wing propeller aircraft of a few hundred triangles.
#pragma once

#include <Inventor/SbColor.h>
#include <Inventor/SbRotation.h>
#include <Inventor/SbVec3f.h>

#include "apps/fly/Aircraft.h"

class SoRotation;
class SoSwitch;
class SoTransform;

namespace teren {

/// Turns a thing whose nose points north and whose top points up into the attitude's direction.
SbRotation rotationOf(const Pose& attitude);

/// The model: 9 m long, 11 m across, its own zero at the wings.
class AircraftModel {
 public:
  explicit AircraftModel(const SbColor& paint);
  ~AircraftModel();
  AircraftModel(const AircraftModel&) = delete;
  AircraftModel& operator=(const AircraftModel&) = delete;

  SoSwitch* node() const noexcept { return root_; }
  void setVisible(bool visible);
  /// `place` is the aircraft's in scene coordinates; the propeller turns on by `dt` [s].
  void show(const SbVec3f& place, const Pose& attitude, double dt);

 private:
  SoSwitch* root_;  // referenced
  SoTransform* transform_;
  SoRotation* propeller_;
  double propellerTurn_ = 0.0;  // [rad]
};

}  // namespace teren
