// The engine's objects: moved together, one of them active, and kept from passing through the ground and each
// other.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "teren/Object.h"

#include "stream/GroundSweep.h"

namespace teren {

/// Not thread-safe. A step costs about 3 us an object with a ball, besides its own update, and 20 ns a pair
/// of them (bench-objects); every collision costs the pairs again, and there are at most two an object in a
/// step.
class ObjectSet {
 public:
  /// `pitch` [m] of the world.
  explicit ObjectSet(double pitch);
  ~ObjectSet();

  /// The first becomes active.
  Object& add(std::unique_ptr<Object> object);
  /// All of them, in the order they were added; the set is then empty.
  std::vector<std::unique_ptr<Object>> release();
  std::size_t size() const noexcept { return members_.size(); }
  Object& at(std::size_t index) const;
  std::size_t active() const noexcept { return active_; }
  /// The object active before lets go of its keys.
  void setActive(std::size_t index);
  /// For the active object; false without one.
  bool handle(const InputEvent& event);
  void letGo();

  /// Moves all by dt seconds, in the order they were added, then finds what their balls touch on the straight
  /// ways from where they were to where they are: the earliest touch first (at equal times the ground before
  /// objects, then in the order they were added), which ends the way of those who touch; the others may still
  /// run into them where they stopped. Last, who is in or under ground that came meanwhile is lifted onto it.
  /// Bounds: sweepError(length of the way). A dt that is not finite or less than 0 counts as 0.
  void advance(double dt, const Ground& ground, const FinestGround& finest);

  /// Of every object, as it says now or, where that is refused, said last; at first the world's zero.
  std::span<const Motion> motions();

  /// Sentences about objects that said what cannot be, each kind once an object.
  std::vector<std::string> takeMessages();

 private:
  struct Member {
    std::unique_ptr<Object> object;
    bool motionRefused = false, sphereRefused = false;  // once is enough to say it
  };
  struct Way;
  struct Collision;

  /// What the object says it is doing, if that can be.
  void read(std::size_t index);
  std::optional<CollisionSphere> sphereOf(std::size_t index);
  std::string nameOf(std::size_t index) const;
  Vector3 centre(const Way& way, const Motion& motion) const;
  Way begin(std::size_t index);
  void end(Way& way);
  void move(double dt, const Ground& ground);
  std::optional<Collision> firstCollision() const;
  std::optional<Touch> touchOf(const Way& a, const Way& b) const;
  Contact contactOf(const Way& way, const Touch& touch, double gap, double dt) const;
  void collide(const Collision& collision, const GroundSweep& sweep, double dt);
  void tell(Way& way, const Contact& contact, double time);
  void lift(Way& way, const GroundSweep& sweep, double dt);

  double pitch_;
  std::vector<Member> members_;
  std::vector<Motion> motions_;
  std::vector<Way> ways_;  // of the step; kept for the room it has
  std::size_t active_ = 0;
  bool timeRefused_ = false;
  std::vector<std::string> messages_;
};

}  // namespace teren
