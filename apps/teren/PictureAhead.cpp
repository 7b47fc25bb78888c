#include "apps/teren/PictureAhead.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace teren {

namespace {

using Vector = std::array<double, 3>;

constexpr double kAspect = 16.0 / 9.0;

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector unitOr(const Vector& vector, const Vector& otherwise) {
  const double length = std::sqrt(dot(vector, vector));
  if (!(length > 0.0)) return otherwise;
  return {vector[0] / length, vector[1] / length, vector[2] / length};
}

/// `along` * share + `across`.
Vector leaning(const Vector& along, double share, const Vector& across) {
  return {share * along[0] + across[0], share * along[1] + across[1], share * along[2] + across[2]};
}

}  // namespace

PictureAhead::PictureAhead(const World& world, const Motion& eye, const DetailSettings& detail)
    : world_(world), eye_(eye), distance_(detail.distance) {
  const Vector forwards = unitOr({eye.east, eye.north, eye.up}, {0.0, 1.0, 0.0});
  const Vector right = unitOr(cross(forwards, {0.0, 0.0, 1.0}), {1.0, 0.0, 0.0});
  const Vector up = cross(right, forwards);
  const auto turned = [](const Vector& vector) { return Vector{-vector[0], -vector[1], -vector[2]}; };
  const double high = std::tan(0.5 * detail.fieldOfView), wide = kAspect * high;
  inwards_ = {forwards, leaning(forwards, wide, right), leaning(forwards, wide, turned(right)),
              leaning(forwards, high, up), leaning(forwards, high, turned(up))};
}

bool PictureAhead::mayShow(const Mesh& mesh) const noexcept {
  const auto n = static_cast<std::int64_t>(world_.intervals());
  const auto metres = [&](std::int64_t origin, std::int64_t patch, double share) {
    return (static_cast<double>(origin - patch * n) - share * static_cast<double>(n)) * world_.spacing(0);
  };
  const double spacing = world_.spacing(mesh.level);
  const Vector low{metres(mesh.originColumn, eye_.position.i, eye_.position.u),
                   metres(mesh.originRow, eye_.position.j, eye_.position.v),
                   static_cast<double>(mesh.minHeight) - eye_.height};
  const Vector high{low[0] + mesh.columns * spacing, low[1] + mesh.rows * spacing,
                    static_cast<double>(mesh.maxHeight) - eye_.height};
  const auto away = [&](std::size_t axis) { return std::max({low[axis], -high[axis], 0.0}); };
  if (away(0) * away(0) + away(1) * away(1) > distance_ * distance_) return false;
  return std::all_of(inwards_.begin(), inwards_.end(), [&](const Vector& inwards) {
    double farthest = 0.0;  // of the box's corners, to the inside
    for (std::size_t k = 0; k < 3; ++k) farthest += std::max(inwards[k] * low[k], inwards[k] * high[k]);
    return farthest >= 0.0;
  });
}

Scene PictureAhead::of(const Scene& scene) const {
  std::vector<std::shared_ptr<const Mesh>> shown;
  for (const auto& mesh : scene.meshes()) {
    if (mayShow(*mesh)) shown.push_back(mesh);
  }
  return {scene.serial(), scene.spacing(), std::move(shown), scene.morph()};
}

}  // namespace teren
