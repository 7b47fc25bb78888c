// Things that move in the world. The engine keeps finest ground under each, draws the view around the active
// one, hands it what the person's hands do, and tells every object what it runs into.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "teren/Input.h"
#include "teren/Model.h"
#include "teren/Position.h"

namespace teren {

/// The ground as objects may ask for it: never blocks, never generates.
class Ground {
 public:
  virtual ~Ground() = default;
  /// [m] The highest of the level-0 triangles and the triangles on the screen at a position: what an object
  /// must stay above so that it is neither below the ground nor seen to be. Empty where neither is there yet,
  /// and for what is not a position (NaN).
  virtual std::optional<double> height(const Position& position) const = 0;
  virtual double pitch() const noexcept = 0;
};

/// An object's state of motion: what the engine needs to know to have ground ready for it.
struct Motion {
  Position position;
  double height = 0.0;                       ///< [m] above zero, at most kMostHeight above or below
  double east = 0.0, north = 0.0, up = 0.0;  ///< [m/s] finite
  /// [m] 0 ... kLargestBall: how far around it there should be finest ground; its ball's size counts anyway.
  double reach = 0.0;
};
inline constexpr double kMostHeight = 1e9;     ///< [m]
inline constexpr double kLargestBall = 100.0;  ///< [m]

/// How an object is turned. Angles in radians: heading clockwise from north; pitch and roll positive for nose
/// up and right wing down. For the eye only: nothing the engine computes depends on it.
struct Attitude {
  double heading = 0.0, pitch = 0.0, roll = 0.0;
};

/// What an object is to a collision: a ball, no part of it farther than kLargestBall from the object's place.
struct CollisionSphere {
  double radius = 0.0;                       ///< [m] >= 0; 0 is a point
  double east = 0.0, north = 0.0, up = 0.0;  ///< [m] of its centre from the object's place
};

class Object;

/// The first touch of a ball with the ground or with another object's.
struct Contact {
  Object* other = nullptr;  ///< nullptr: the ground
  double seconds = 0.0;     ///< [s] into the update, 0 ... dt
  /// Unit, east, north and up: from what was touched towards this object's ball.
  std::array<double, 3> normal{0.0, 0.0, 1.0};
  /// This object at the touch, less than kContactGap apart from what it touches, with the velocity that
  /// motion() said. On ground that came or grew over the object: lifted onto it.
  Motion motion = {};
  std::array<double, 3> otherVelocity{};  ///< [m/s] of the other object; 0 for the ground
};

/// [m] How far from what it touched an object is left.
inline constexpr double kContactGap = 1e-3;

/// A line of an object's head-up display.
struct DisplayLine {
  std::string what;      ///< "speed"
  std::string says;      ///< "60.0 m/s"
  bool warning = false;  ///< to be seen at once

  friend bool operator==(const DisplayLine&, const DisplayLine&) = default;
};

/// All calls on the engine's thread. Whoever implements it says what it is by overriding as much as it needs:
/// update() and motion() make a thing that moves; everything else has a default that is nothing.
class Object {
 public:
  virtual ~Object() = default;

  /// What messages call it.
  virtual std::string name() const { return "object"; }

  /// Moves on by dt seconds (finite, >= 0). Called by Engine::update in the order the objects were added. For
  /// collisions the way from the motion before to the motion after is one straight line: an object that
  /// curves in one update is asked to be content with that. What moves it outside update() is a jump.
  virtual void update(double dt, const Ground& ground) = 0;
  /// Where it is. A position outside the world, and values that are not finite, are refused: one message
  /// names the object, and the engine goes on with what it said last.
  virtual Motion motion() const = 0;
  /// Puts it into a state of motion, at once. An object that does not implement it cannot be stopped.
  virtual void place(const Motion& /*motion*/) {}

  /// Its ball, at the motion of the moment; empty: it touches nothing.
  virtual std::optional<CollisionSphere> collisionSphere() const { return std::nullopt; }
  /// It touched something on its way; the rest of the way is not gone. Not told of what it moves away from.
  /// The default stops at the contact. Whatever it does instead, it is where motion() says afterwards, until
  /// the next update.
  virtual void collided(const Contact& contact);

  /// Something the person did while this object is active. Returns whether it meant anything to the object.
  virtual bool handle(const InputEvent& /*event*/) { return false; }
  /// Lets go of every key: the object is no longer the active one, or the window lost the keyboard.
  virtual void letGo() {}
  /// The keys it listens to, for the help of the program.
  virtual std::vector<KeyHelp> keys() const { return {}; }

  /// What it wants shown to the person while it is active, from top to bottom.
  virtual std::vector<DisplayLine> headUpDisplay() const { return {}; }

  /// What it looks like; does not change while the object lives.
  virtual const Model& model() const;
  /// How it is turned; the default looks where it goes, north if it stands.
  virtual Attitude attitude() const;
};

}  // namespace teren
