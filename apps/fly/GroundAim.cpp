#include "apps/fly/GroundAim.h"

#include <array>
#include <cmath>

#include "teren/SceneQuery.h"

namespace teren {
namespace {

using Direction = std::array<double, 3>;  // east, north, up

std::optional<Position> firstGround(const Flight& flight, const Pose& from, const Direction& direction) {
  const DetailEye eye = flight.detailEye();
  const SceneQuery query = flight.engine().sceneQuery()->seenFrom(eye);
  const Ray ray{from.position, from.height, direction};
  RayHit hit;
  query.firstHits({&ray, 1}, {&hit, 1});
  if (hit.end != RayEnd::ground) return std::nullopt;
  const Result<Position> place =
      from.position.movedBy(hit.way * direction[0], hit.way * direction[1], flight.engine().world().pitch());
  if (!place) return std::nullopt;
  return *place;
}

}  // namespace

std::optional<Position> groundAt(const Flight& flight, const Viewpoint& view, const PicturePoint& point,
                                 double aspect) {
  const Pose& eye = view.pose;
  const double sine = std::sin(eye.heading), cosine = std::cos(eye.heading);
  const double rise = std::sin(eye.pitch), level = std::cos(eye.pitch);
  const Direction ahead{sine * level, cosine * level, rise};
  const Direction right{cosine, -sine, 0.0}, up{-sine * rise, -cosine * rise, level};
  const double half = std::tan(0.5 * view.fieldOfView);
  const double x = half * aspect * point.right, y = half * point.up;
  // The right wing down is positive.
  const double aside = x * std::cos(eye.roll) + y * std::sin(eye.roll);
  const double above = y * std::cos(eye.roll) - x * std::sin(eye.roll);
  Direction direction{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    direction[axis] = ahead[axis] + aside * right[axis] + above * up[axis];
  }
  return firstGround(flight, eye, direction);
}

std::optional<Position> groundAhead(const Flight& flight, const Pose& object, double least) {
  const double sine = std::sin(object.heading), cosine = std::cos(object.heading);
  const double level = std::cos(kLookDown);
  const std::optional<Position> there =
      firstGround(flight, object, {sine * level, cosine * level, -std::sin(kLookDown)});
  const double pitch = flight.engine().world().pitch();
  if (there) {
    const Offset away = offset(object.position, *there, pitch);
    if (std::hypot(away.east, away.north) >= least) return there;
  }
  const Result<Position> near = object.position.movedBy(least * sine, least * cosine, pitch);
  if (!near || !flight.engine().drawnHeight(*near)) return std::nullopt;
  return *near;
}

}  // namespace teren
