// The object that stands for the eye of a SoTerrain that drives its own engine.
#pragma once

#include "teren/Object.h"

namespace teren {

/// Stands wherever it was last put. It has no velocity: an eye may jump, and needs no ground ahead of it.
class EyeObject final : public Object {
 public:
  void put(const Position& position, double height) noexcept {
    motion_.position = position;
    motion_.height = height;
  }

  void update(double /*dt*/, const Ground& /*ground*/) override {}
  Motion motion() const override { return motion_; }

 private:
  Motion motion_;
};

}  // namespace teren
