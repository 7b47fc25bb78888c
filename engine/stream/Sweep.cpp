#include "stream/Sweep.h"

#include <cmath>
#include <utility>

namespace teren {
namespace {

/// When the point that moves from p by d comes within r of the origin, in the plane or space that p and d
/// live in; by the nearest approach, so that a long way loses no more than its length's last bits.
std::optional<double> timeWithin(const Vector3& p, const Vector3& d, double r) {
  const double speed2 = dot(d, d), towards = -dot(p, d);
  if (!(towards > 0.0)) return std::nullopt;  // moving away, or not at all
  const double nearest = towards / speed2;
  const Vector3 there = p + nearest * d;
  const double room = r * r - dot(there, there);
  if (room < 0.0) return std::nullopt;
  const double time = nearest - std::sqrt(room / speed2);
  if (time > 1.0) return std::nullopt;
  return time > 0.0 ? time : 0.0;  // below 0: they overlap already, and come nearer
}

Vector3 unit(const Vector3& v, const Vector3& otherwise) {
  const double length = std::sqrt(dot(v, v));
  return length > 0.0 ? (1.0 / length) * v : otherwise;
}

}  // namespace

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

std::optional<Touch> sweepPoint(const MovingBall& ball, const Vector3& point) {
  const Vector3 p = ball.from - point, d = ball.to - ball.from;
  const std::optional<double> time = timeWithin(p, d, ball.radius);
  if (!time) return std::nullopt;
  return Touch{*time, unit(p + *time * d, {0.0, 0.0, 1.0})};
}

std::optional<Touch> sweepSegment(const MovingBall& ball, const Vector3& a, const Vector3& b) {
  const Vector3 edge = b - a;
  const double length2 = dot(edge, edge);
  if (!(length2 > 0.0)) return std::nullopt;
  const Vector3 p = ball.from - a, d = ball.to - ball.from;
  const double alongP = dot(p, edge) / length2, alongD = dot(d, edge) / length2;
  const Vector3 across = p - alongP * edge, acrossD = d - alongD * edge;
  const std::optional<double> time = timeWithin(across, acrossD, ball.radius);
  if (!time) return std::nullopt;
  const double foot = alongP + *time * alongD;
  if (foot < 0.0 || foot > 1.0) return std::nullopt;  // the ends are points
  return Touch{*time, unit(across + *time * acrossD, {0.0, 0.0, 1.0})};
}

std::optional<Touch> sweepFace(const MovingBall& ball, const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 ab = b - a, ac = c - a, d = ball.to - ball.from;
  const Vector3 normal = unit(cross(ab, ac), {0.0, 0.0, 1.0});
  const double above = dot(ball.from - a, normal), sinking = -dot(d, normal);
  if (!(sinking > 0.0) || above < 0.0 || above - sinking > ball.radius) return std::nullopt;
  const double time = above > ball.radius ? (above - ball.radius) / sinking : 0.0;
  const double gap = above > ball.radius ? ball.radius : above;
  const Vector3 foot = ball.from + time * d - gap * normal;
  const double slack = sweepError(std::sqrt(dot(d, d)));
  for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) {
    const Vector3 side = to - from;
    if (dot(cross(side, foot - from), normal) < -slack * std::sqrt(dot(side, side))) return std::nullopt;
  }
  return Touch{time, normal};
}

}  // namespace teren
