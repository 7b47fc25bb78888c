// The object that stands for the eye of a TerrainWidget in its engine.
#pragma once

#include <algorithm>

#include "teren/Object.h"

#include "qt/Viewer.h"

namespace teren {

/// Stands above the ground, or the water, wherever it was last put. It has no velocity: a widget's eye may
/// jump.
class EyeAboveGround final : public Object {
 public:
  /// `ground` [m]: what to take for the ground until it is known.
  explicit EyeAboveGround(double ground) noexcept : ground_(ground) {}

  void put(const Viewer& viewer) noexcept {
    motion_.position = viewer.position;
    clearance_ = viewer.heightAboveGround;
    lift();
  }
  /// [m] far below all ground where there is no water.
  void setWater(double level) noexcept { water_ = level; }

  void update(double /*dt*/, const Ground& ground) override {
    ground_ = ground.height(motion_.position).value_or(ground_);
    lift();
  }
  Motion motion() const override { return motion_; }

  double ground() const noexcept { return ground_; }

 private:
  void lift() noexcept { motion_.height = std::max(ground_, water_) + clearance_; }

  Motion motion_;
  double ground_;
  double water_ = -1e9;
  double clearance_ = 0.0;
};

}  // namespace teren
