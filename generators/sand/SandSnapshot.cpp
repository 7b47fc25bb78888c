#include "generators/sand/SandSnapshot.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace teren {
namespace {

/// A ray as the boxes and triangles it may meet want it: sheared so that it runs along its main axis (Woop,
/// Benthin, Wald 2013). Two triangles at an edge then compute the same number for it but for its sign, so
/// that no ray passes between them.
class ShearedRay {
 public:
  explicit ShearedRay(const SandRay& ray) noexcept : from_(ray.from), direction_(ray.direction) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (std::fabs(direction_[axis]) > std::fabs(direction_[main_])) main_ = axis;
    }
    one_ = (main_ + 1) % 3;
    other_ = (main_ + 2) % 3;
    shearOne_ = direction_[one_] / direction_[main_];
    shearOther_ = direction_[other_] / direction_[main_];
  }

  /// Whether it meets a box before `end`.
  bool meets(const std::array<double, 3>& low, const std::array<double, 3>& high, double end) const noexcept {
    double begin = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (direction_[axis] == 0.0) {
        if (from_[axis] < low[axis] || from_[axis] > high[axis]) return false;
        continue;
      }
      const double a = (low[axis] - from_[axis]) / direction_[axis];
      const double b = (high[axis] - from_[axis]) / direction_[axis];
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    return begin <= end;
  }

  /// How far away it meets a triangle [lengths of its direction]; nothing where it does not, or in its edge.
  std::optional<double> distance(const std::array<std::array<double, 3>, 3>& corners) const noexcept {
    std::array<double, 3> along{}, u{}, v{};
    for (std::size_t k = 0; k < 3; ++k) {
      along[k] = (corners[k][main_] - from_[main_]) / direction_[main_];
      const double depth = corners[k][main_] - from_[main_];
      u[k] = (corners[k][one_] - from_[one_]) - shearOne_ * depth;
      v[k] = (corners[k][other_] - from_[other_]) - shearOther_ * depth;
    }
    const double a = u[2] * v[1] - v[2] * u[1];
    const double b = u[0] * v[2] - v[0] * u[2];
    const double c = u[1] * v[0] - v[1] * u[0];
    if ((a < 0.0 || b < 0.0 || c < 0.0) && (a > 0.0 || b > 0.0 || c > 0.0)) return std::nullopt;
    const double sum = a + b + c;
    if (sum == 0.0) return std::nullopt;
    const double distance = (a * along[0] + b * along[1] + c * along[2]) / sum;
    return distance >= 0.0 ? std::optional(distance) : std::nullopt;
  }

  std::array<double, 3> at(double distance) const noexcept {
    std::array<double, 3> place{};
    for (std::size_t axis = 0; axis < 3; ++axis) place[axis] = from_[axis] + distance * direction_[axis];
    return place;
  }

 private:
  std::array<double, 3> from_, direction_;
  std::size_t main_ = 0, one_ = 1, other_ = 2;
  double shearOne_ = 0.0, shearOther_ = 0.0;
};

bool isRay(const SandRay& ray) noexcept {
  const auto finite = [](double number) { return std::isfinite(number); };
  const auto notZero = [](double number) { return number != 0.0; };
  return std::all_of(ray.from.begin(), ray.from.end(), finite) &&
         std::all_of(ray.direction.begin(), ray.direction.end(), finite) &&
         std::any_of(ray.direction.begin(), ray.direction.end(), notZero);
}

/// Whether a ray meets bounds before `end`, a step of rounding allowed.
bool meets(const ShearedRay& ray, const LatticeFrame& frame, const SandBounds& bounds, double end) noexcept {
  if (bounds.isEmpty()) return false;
  const double low = static_cast<double>(bounds.low), high = static_cast<double>(bounds.high);
  const double margin = frame.step + 1e-12 * (std::fabs(low) + std::fabs(high));
  return ray.meets(
      {frame.placeX(bounds.southWest) - margin, frame.placeY(bounds.southWest) - margin, low - margin},
      {frame.placeX(bounds.northEast) + margin, frame.placeY(bounds.northEast) + margin, high + margin}, end);
}

}  // namespace

void SandBounds::extendBy(const SandBounds& other) noexcept {
  if (other.isEmpty()) return;
  if (isEmpty()) {
    *this = other;
    return;
  }
  southWest = {std::min(southWest.x, other.southWest.x), std::min(southWest.y, other.southWest.y)};
  northEast = {std::max(northEast.x, other.northEast.x), std::max(northEast.y, other.northEast.y)};
  low = std::min(low, other.low);
  high = std::max(high, other.high);
}

SandBounds SandSnapshot::bounds() const noexcept {
  SandBounds all;
  for (std::size_t i = 0; i < bounds_.size(); ++i) all.extendBy(bounds_[i].all);
  return all;
}

std::optional<SandHit> SandSnapshot::hit(const SandRay& ray) const {
  if (!isRay(ray)) return std::nullopt;
  const ShearedRay sheared(ray);
  double end = std::numeric_limits<double>::infinity();
  TriangleId nearest = kNoTriangle;
  const auto lookAt = [&](TriangleId t) {
    if (!isTriangle(t)) return;
    std::array<std::array<double, 3>, 3> places{};
    for (std::size_t k = 0; k < 3; ++k) {
      const SandVertex& one = vertex(corners(t)[k]);
      places[k] = {frame_.placeX(one.place), frame_.placeY(one.place), static_cast<double>(one.height)};
    }
    const std::optional<double> distance = sheared.distance(places);
    if (!distance || !(*distance < end)) return;
    end = *distance;
    nearest = t;
  };
  for (std::size_t g = 0; g < bounds_.size(); ++g) {
    if (!meets(sheared, frame_, bounds_[g].all, end)) continue;
    const std::size_t firstPage = g * SandBoundsPage::kSlots;
    const std::size_t pages = std::min(SandBoundsPage::kSlots, triangles_.size() - firstPage);
    for (std::size_t i = 0; i < pages; ++i) {
      if (!meets(sheared, frame_, bounds_[g].pages[i], end)) continue;
      const std::size_t first = (firstPage + i) * SandTrianglePage::kSlots;
      for (std::size_t t = first; t < first + SandTrianglePage::kSlots; ++t)
        lookAt(static_cast<TriangleId>(t));
    }
  }
  if (nearest == kNoTriangle) return std::nullopt;
  const std::array<double, 3> place = sheared.at(end);
  return SandHit{place[0], place[1], place[2], end, nearest};
}

std::size_t SandSnapshot::bytes() const noexcept {
  return sizeof(*this) + vertices_.bytes() + triangles_.bytes() + bounds_.bytes();
}

}  // namespace teren
