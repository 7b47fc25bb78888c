#include "stream/ObjectSet.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "teren/Parameter.h"
#include "teren/Quote.h"

namespace teren {
namespace {

/// [m] An object this little in the ground is left alone: rounding.
constexpr double kInGround = 1e-6;

/// What is wrong with a motion; empty: nothing.
std::string faultOf(const Motion& motion) {
  const Position& at = motion.position;
  if (!at.valid()) {
    return "a position of patch (" + std::to_string(at.i) + ", " + std::to_string(at.j) + ") and place (" +
           numberText(at.u) + ", " + numberText(at.v) + ") in it, which is not in the world";
  }
  if (!(std::fabs(motion.height) <= kMostHeight)) {
    return "a height of " + numberText(motion.height) + " m, expected -1e9 to 1e9";
  }
  for (const double speed : {motion.east, motion.north, motion.up}) {
    if (!std::isfinite(speed)) return "a speed of " + numberText(speed) + " m/s, expected a finite number";
  }
  if (!(motion.reach >= 0.0 && motion.reach <= kLargestBall)) {
    return "a reach of " + numberText(motion.reach) + " m, expected 0 to " + numberText(kLargestBall);
  }
  return {};
}

double reachOf(const CollisionSphere& sphere) {
  return sphere.radius +
         std::sqrt(sphere.east * sphere.east + sphere.north * sphere.north + sphere.up * sphere.up);
}

}  // namespace

/// An object's way in one step, in metres from the corner of the patch it began in.
struct ObjectSet::Way {
  std::size_t index = 0;
  Position origin;
  bool touches = false, moves = false;
  double radius = 0.0;
  Vector3 offset;      // of the ball's centre from the object
  double begin = 0.0;  // the time at which it is at `from`
  Vector3 from, to;    // of the ball's centre; equal once it has touched something
  std::optional<Touch> ground;

  MovingBall ball() const { return {from, to, radius}; }
  Vector3 at(double time) const { return moves ? from + ((time - begin) / (1.0 - begin)) * (to - from) : to; }
};

/// The first touch of all.
struct ObjectSet::Collision {
  Touch touch;  // seen from a
  std::size_t a = 0;
  std::optional<std::size_t> b;  // empty: the ground
};

ObjectSet::ObjectSet(double pitch) : pitch_(pitch) {}
ObjectSet::~ObjectSet() = default;

Object& ObjectSet::add(std::unique_ptr<Object> object) {
  assert(object);
  members_.push_back({std::move(object)});
  motions_.emplace_back();
  return *members_.back().object;
}

std::vector<std::unique_ptr<Object>> ObjectSet::release() {
  std::vector<std::unique_ptr<Object>> objects;
  for (Member& member : members_) objects.push_back(std::move(member.object));
  members_.clear();
  motions_.clear();
  active_ = 0;
  return objects;
}

Object& ObjectSet::at(std::size_t index) const {
  assert(index < members_.size());
  return *members_[index].object;
}

void ObjectSet::setActive(std::size_t index) {
  assert(index < members_.size());
  if (index != active_) letGo();
  active_ = index;
}

bool ObjectSet::handle(const InputEvent& event) {
  return !members_.empty() && at(active_).handle(event);
}

void ObjectSet::letGo() {
  if (!members_.empty()) at(active_).letGo();
}

std::span<const Motion> ObjectSet::motions() {
  for (std::size_t index = 0; index < members_.size(); ++index) {
    read(index);
    if (const std::optional<CollisionSphere> sphere = sphereOf(index)) {
      motions_[index].reach = std::max(motions_[index].reach, reachOf(*sphere));
    }
  }
  return motions_;
}

std::vector<std::string> ObjectSet::takeMessages() {
  return std::exchange(messages_, {});
}

std::string ObjectSet::nameOf(std::size_t index) const {
  return "object " + std::to_string(index + 1) + ", " + inQuotes(at(index).name()) + ",";
}

void ObjectSet::read(std::size_t index) {
  const Motion motion = at(index).motion();
  const std::string fault = faultOf(motion);
  if (fault.empty()) {
    motions_[index] = motion;
  } else if (!std::exchange(members_[index].motionRefused, true)) {
    messages_.push_back(nameOf(index) + " says it has " + fault + "; the engine keeps it where it was");
  }
}

std::optional<CollisionSphere> ObjectSet::sphereOf(std::size_t index) {
  const std::optional<CollisionSphere> sphere = at(index).collisionSphere();
  if (!sphere) return std::nullopt;
  if (sphere->radius >= 0.0 && reachOf(*sphere) <= kLargestBall) return sphere;
  if (!std::exchange(members_[index].sphereRefused, true)) {
    messages_.push_back(nameOf(index) + " has a collision sphere of radius " + numberText(sphere->radius) +
                        " m that reaches " + numberText(reachOf(*sphere)) + " m from it, expected 0 to " +
                        numberText(kLargestBall) + "; it touches nothing");
  }
  return std::nullopt;
}

Vector3 ObjectSet::centre(const Way& way, const Motion& motion) const {
  const Offset away = teren::offset(way.origin, motion.position, pitch_);
  return Vector3{away.east, away.north, motion.height} + way.offset;
}

ObjectSet::Way ObjectSet::begin(std::size_t index) {
  read(index);
  Way way;
  way.index = index;
  way.origin = {motions_[index].position.i, motions_[index].position.j, 0.0, 0.0};
  if (const std::optional<CollisionSphere> sphere = sphereOf(index)) {
    way.touches = true;
    way.offset = {sphere->east, sphere->north, sphere->up};
    way.from = centre(way, motions_[index]);
  }
  return way;
}

void ObjectSet::end(Way& way) {
  read(way.index);
  const std::optional<CollisionSphere> sphere = sphereOf(way.index);
  way.touches = way.touches && sphere;
  if (!way.touches) return;
  way.radius = sphere->radius;
  way.offset = {sphere->east, sphere->north, sphere->up};
  way.to = centre(way, motions_[way.index]);
  const Vector3 gone = way.to - way.from;
  way.moves = dot(gone, gone) > 0.0;
}

void ObjectSet::move(double dt, const Ground& ground) {
  ways_.clear();
  for (std::size_t index = 0; index < members_.size(); ++index) {
    ways_.push_back(begin(index));
    at(index).update(dt, ground);
    end(ways_.back());
  }
}

void ObjectSet::advance(double dt, const Ground& ground, const FinestGround& finest) {
  if (!(dt >= 0.0) || !std::isfinite(dt)) {
    if (!std::exchange(timeRefused_, true)) {
      messages_.push_back("the engine was asked to move on by " + numberText(dt) +
                          " s, expected a finite time of at least 0; nothing moves");
    }
    dt = 0.0;
  }
  move(dt, ground);
  const GroundSweep sweep(finest, pitch_);
  for (Way& way : ways_) {
    if (way.moves) way.ground = sweep.sweep(way.origin, way.ball());
  }
  while (const std::optional<Collision> first = firstCollision()) collide(*first, sweep, dt);
  for (Way& way : ways_) {
    if (way.touches) lift(way, sweep, dt);
  }
}

std::optional<ObjectSet::Collision> ObjectSet::firstCollision() const {
  std::optional<Collision> first;
  const auto consider = [&first](const std::optional<Touch>& touch, std::size_t a,
                                 std::optional<std::size_t> b) {
    if (touch && (!first || touch->time < first->touch.time)) first = Collision{*touch, a, b};
  };
  for (std::size_t a = 0; a < ways_.size(); ++a) {
    if (ways_[a].moves) consider(ways_[a].ground, a, std::nullopt);
  }
  for (std::size_t a = 0; a < ways_.size(); ++a) {
    for (std::size_t b = a + 1; b < ways_.size(); ++b) {
      if (ways_[a].moves || ways_[b].moves) consider(touchOf(ways_[a], ways_[b]), a, b);
    }
  }
  return first;
}

std::optional<Touch> ObjectSet::touchOf(const Way& a, const Way& b) const {
  if (!a.touches || !b.touches) return std::nullopt;
  const double begin = std::max(a.begin, b.begin);
  const Offset between = teren::offset(b.origin, a.origin, pitch_);
  const Vector3 apart{between.east, between.north, 0.0};
  const MovingBall relative{apart + (a.at(begin) - b.at(begin)), apart + (a.at(1.0) - b.at(1.0)),
                            a.radius + b.radius};
  std::optional<Touch> touch = sweepPoint(relative, {});
  if (touch) touch->time = begin + touch->time * (1.0 - begin);
  return touch;
}

/// What a touch is to an object, moved `gap` back from what it touches.
Contact ObjectSet::contactOf(const Way& way, const Touch& touch, double gap, double dt) const {
  Contact contact;
  contact.seconds = touch.time * dt;
  contact.normal = {touch.normal.x, touch.normal.y, touch.normal.z};
  contact.motion = motions_[way.index];
  const Vector3 place = way.at(touch.time) + gap * touch.normal - way.offset;
  if (const Result<Position> position = way.origin.movedBy(place.x, place.y, pitch_)) {
    contact.motion.position = *position;
    contact.motion.height = place.z;
  }
  return contact;
}

void ObjectSet::collide(const Collision& collision, const GroundSweep& sweep, double dt) {
  Way& a = ways_[collision.a];
  const Touch& touch = collision.touch;
  if (!collision.b) {
    Contact contact = contactOf(a, touch, kContactGap, dt);
    // In a notch, what backs off from one side may be in the other.
    const Vector3 there = centre(a, contact.motion);
    const auto rest = sweep.rest(a.origin, there.x, there.y, a.radius);
    if (rest) contact.motion.height += std::max(0.0, rest->height + kContactGap - there.z);
    tell(a, contact, touch.time);
    return;
  }
  Way& b = ways_[*collision.b];
  const Touch back{touch.time, -1.0 * touch.normal};
  const double gap = a.moves && b.moves ? 0.5 * kContactGap : kContactGap;
  Contact toA = contactOf(a, touch, a.moves ? gap : 0.0, dt);
  Contact toB = contactOf(b, back, b.moves ? gap : 0.0, dt);
  toA.other = &at(b.index);
  toB.other = &at(a.index);
  toA.otherVelocity = {toB.motion.east, toB.motion.north, toB.motion.up};
  toB.otherVelocity = {toA.motion.east, toA.motion.north, toA.motion.up};
  tell(a, toA, touch.time);
  tell(b, toB, touch.time);
}

void ObjectSet::tell(Way& way, const Contact& contact, double time) {
  at(way.index).collided(contact);
  read(way.index);
  way.from = way.to = centre(way, motions_[way.index]);
  way.begin = time;
  way.moves = false;
  way.ground.reset();
}

void ObjectSet::lift(Way& way, const GroundSweep& sweep, double dt) {
  const Position& here = motions_[way.index].position;
  way.origin = {here.i, here.j, 0.0, 0.0};  // after a long way, what is small again is exact again
  way.from = way.to = centre(way, motions_[way.index]);
  way.moves = false;
  const auto rest = sweep.rest(way.origin, way.to.x, way.to.y, way.radius);
  if (!rest || way.to.z >= rest->height - kInGround) return;
  Contact contact = contactOf(way, {1.0, rest->normal}, 0.0, dt);
  contact.motion.height += rest->height + kContactGap - way.to.z;
  tell(way, contact, 1.0);
}

}  // namespace teren
