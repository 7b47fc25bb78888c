// Things that move in the world. The engine keeps finest ground under each, and the view around the active
// one.
#pragma once

#include <optional>

#include "teren/Position.h"

namespace teren {

/// The ground as objects may ask for it: never blocks, never generates.
class Ground {
 public:
  virtual ~Ground() = default;
  /// [m] The highest of the level-0 triangles and the triangles on the screen at a position: what an object
  /// must stay above so that it is neither below the ground nor seen to be. Empty where neither is there yet.
  virtual std::optional<double> height(const Position& position) const = 0;
  virtual double pitch() const noexcept = 0;
};

/// An object's state of motion: what the engine needs to know to have ground ready for it.
struct Motion {
  Position position;
  double height = 0.0;                       ///< [m] above zero
  double east = 0.0, north = 0.0, up = 0.0;  ///< [m/s]
};

class Object {
 public:
  virtual ~Object() = default;
  /// Moves on by dt seconds (>= 0). Called by Engine::update on its thread, in the order the objects were
  /// added.
  virtual void update(double dt, const Ground& ground) = 0;
  virtual Motion motion() const = 0;
};

}  // namespace teren
