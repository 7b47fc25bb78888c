// When a moving ball first touches a triangle of the ground or another ball: the geometry of collisions.
// Exact but for rounding, so nothing is too fast or too thin.
#pragma once

#include <optional>

namespace teren {

/// [m] East, north, up of some origin nearby.
struct Vector3 {
  double x = 0.0, y = 0.0, z = 0.0;

  friend Vector3 operator+(const Vector3& a, const Vector3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector3 operator-(const Vector3& a, const Vector3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector3 operator*(double s, const Vector3& a) { return {s * a.x, s * a.y, s * a.z}; }
};
inline double dot(const Vector3& a, const Vector3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vector3 cross(const Vector3& a, const Vector3& b);

/// A ball on its way, in a straight line at an even speed.
struct MovingBall {
  Vector3 from, to;     ///< its centre at times 0 and 1; finite, below 1e22
  double radius = 0.0;  ///< > 0

  Vector3 at(double time) const { return from + time * (to - from); }
};

/// `normal` points from what is touched to the ball's centre, unit length.
struct Touch {
  double time = 0.0;  ///< 0 ... 1
  Vector3 normal{0.0, 0.0, 1.0};
};

/// [m] How far from the ball's rim the touched thing is at the time of the touch, at most: positions are as
/// good as the longest distance involved allows.
inline double sweepError(double distance) {
  return 1e-9 + 0x1p-48 * distance;
}

/// The first touch with the point, the segment from a to b, and the face of the triangle a b c, seen
/// anticlockwise from its upper side. A ball that overlaps the thing at time 0 touches it then if it comes
/// nearer, and not at all if it moves away. The face is touched from its upper side only; it reaches
/// sweepError() beyond its rim, so that nothing slips between two.
std::optional<Touch> sweepPoint(const MovingBall& ball, const Vector3& point);
std::optional<Touch> sweepSegment(const MovingBall& ball, const Vector3& a, const Vector3& b);
std::optional<Touch> sweepFace(const MovingBall& ball, const Vector3& a, const Vector3& b, const Vector3& c);

/// Keeps the earlier.
inline void takeEarlier(std::optional<Touch>& best, const std::optional<Touch>& other) {
  if (other && (!best || other->time < best->time)) best = other;
}

}  // namespace teren
