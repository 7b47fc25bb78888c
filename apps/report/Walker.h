// An object that goes straight on over the ground, at a speed that can be changed: what the report looks
// from.
#pragma once

#include "teren/Object.h"

namespace teren {

class Walker final : public Object {
 public:
  /// `clearance` [m] above the ground, as last known; at first at the height `ground` + clearance.
  Walker(const Position& place, double ground, double clearance) : clearance_(clearance) {
    motion_.position = place;
    motion_.height = ground + clearance;
  }

  std::string name() const override { return "walker"; }
  void update(double dt, const Ground& ground) override;
  Motion motion() const override { return motion_; }
  void place(const Motion& motion) override { motion_ = motion; }

  /// [m/s] to the north.
  void setSpeed(double speed) { motion_.north = speed; }

 private:
  double clearance_;
  Motion motion_;
};

}  // namespace teren
