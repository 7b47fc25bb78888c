#include "generators/sand/CleanUp.h"

#include <algorithm>
#include <cmath>

namespace teren {
namespace {

constexpr double kParts = 65535.0;
/// A removal and what gives its volume back move places by at most so many widths of the band.
constexpr double kErrorPerBand = 2.5;
constexpr std::size_t kChangesOfFlip = 4;  // two triangles go and two come

/// How far the two diagonals of the quadrangle a, b, c, d (counter-clockwise, convex) are apart where they
/// cross [m].
double foldOf(const SandSurface& surface, VertexId a, VertexId b, VertexId c, VertexId d) noexcept {
  const auto place = [&](VertexId v) { return surface.mesh().point(v); };
  const auto height = [&](VertexId v) { return surface.mesh().height(v); };
  const auto along = [&](VertexId from, VertexId to, VertexId one, VertexId other) {
    const double part = static_cast<double>(orientation(place(one), place(other), place(from)));
    const double whole = part - static_cast<double>(orientation(place(one), place(other), place(to)));
    return height(from) + part / whole * (height(to) - height(from));
  };
  return std::fabs(along(a, c, b, d) - along(b, d, a, c));
}

}  // namespace

double CleanUp::carried(VertexId v) const noexcept {
  return v < carried_.size() ? carried_[v] / kParts * tolerance_ : 0.0;
}

/// Rounds upwards, so that the bound stays one.
void CleanUp::carry(VertexId v, double error) {
  while (v >= carried_.size()) carried_.push_back(0);
  const double parts = error > 0.0 ? -std::floor(-(error / tolerance_ * kParts)) : 0.0;
  carried_[v] = static_cast<std::uint16_t>(std::min(parts, kParts));
}

void CleanUp::addMoved(VertexId v) {
  if (v < carried_.size()) carried_[v] = 0;
  add(v);
}

void CleanUp::run(SandSurface& surface, Slides& slides, std::uint32_t kept) {
  for (const VertexId v : queue_) {
    waiting_.erase(v);
    if (!surface.mesh().isVertex(v)) continue;
    ++count_.looked;
    if (surface.mesh().constraintsAt(v) > 0) dissolveAt(surface, slides, v, kept);
    if (surface.mesh().constraintsAt(v) == 0) removeIfFlat(surface, slides, v);
  }
  queue_.clear();
}

void CleanUp::dissolveAt(SandSurface& surface, Slides& slides, VertexId v, std::uint32_t kept) {
  const Triangulation& mesh = surface.mesh();
  ring_.clear();
  mesh.forEachNeighbour(v, [this](VertexId n) { ring_.push_back(n); });
  const std::size_t count = ring_.size();
  const bool closed = !mesh.isOnBorder(v);
  for (std::size_t i = 0; i < count; ++i) {
    if (!closed && (i == 0 || i + 1 == count)) continue;
    const VertexId to = ring_[i], left = ring_[(i + 1) % count], right = ring_[(i + count - 1) % count];
    if (mesh.constraintsAt(to) == 0) continue;
    const auto id = mesh.constraint(v, to);
    if (!id || *id >= kept || !mesh.isEdge(v, left) || !mesh.isEdge(v, right)) continue;
    const bool flips = inCircle(mesh.point(v), mesh.point(to), mesh.point(left), mesh.point(right));
    const double fold = flips ? foldOf(surface, v, right, to, left) : 0.0;
    const double error =
        kErrorPerBand * fold + std::max({carried(v), carried(to), carried(left), carried(right)});
    if (flips && error > tolerance_) continue;
    const std::uint32_t was = *id;
    surface.unconstrain(v, to);
    if (surface.lastChangeCount() != (flips ? kChangesOfFlip : 0)) {  // more than was judged has changed
      surface.constrain(v, to, was);
      const std::vector<VertexId> touched(surface.lastTouched().begin(), surface.lastTouched().end());
      surface.settle(touched);
      continue;
    }
    ++count_.dissolved;
    if (!flips) continue;
    count_.largestError = std::max(count_.largestError, error);
    const std::vector<VertexId> touched(surface.lastTouched().begin(), surface.lastTouched().end());
    surface.settle(touched);
    for (const VertexId n : touched) {
      carry(n, std::max(error, carried(n)));
      slides.addAround(surface, n);
    }
  }
}

/// The width [m] of the band around a plane through v in which its neighbours lie; these go to ring_.
double CleanUp::bandAround(const SandSurface& surface, VertexId v) {
  const Triangulation& mesh = surface.mesh();
  const LatticePoint p = mesh.point(v);
  const double h = mesh.height(v);
  double gradientX = 0.0, gradientY = 0.0, areas = 0.0;
  mesh.forEachCorner(v, [&](Link at) {
    const std::array<VertexId, 3>& corners = mesh.corners(at.triangle());
    const VertexId b = corners[following(at.side())], c = corners[preceding(at.side())];
    const double xb = mesh.point(b).x - p.x, yb = mesh.point(b).y - p.y, hb = mesh.height(b) - h;
    const double xc = mesh.point(c).x - p.x, yc = mesh.point(c).y - p.y, hc = mesh.height(c) - h;
    areas += xb * yc - xc * yb;
    gradientX += hb * yc - hc * yb;
    gradientY += xb * hc - xc * hb;
  });
  gradientX /= areas;
  gradientY /= areas;
  slope_ = std::sqrt(gradientX * gradientX + gradientY * gradientY) / surface.step();
  double lowest = 0.0, highest = 0.0;
  ring_.clear();
  mesh.forEachNeighbour(v, [&](VertexId n) {
    ring_.push_back(n);
    const double plane = h + gradientX * (mesh.point(n).x - p.x) + gradientY * (mesh.point(n).y - p.y);
    lowest = std::min(lowest, mesh.height(n) - plane);
    highest = std::max(highest, mesh.height(n) - plane);
  });
  return highest - lowest;
}

/// Whether loose material lies at a vertex or at one of ring_.
bool CleanUp::bearsLoose(const SandSurface& surface, VertexId v) const {
  const auto bears = [&](VertexId n) { return surface.loose(n) > kBareTicks; };
  return bears(v) || std::any_of(ring_.begin(), ring_.end(), bears);
}

void CleanUp::removeIfFlat(SandSurface& surface, Slides& slides, VertexId v) {
  double error = kErrorPerBand * bandAround(surface, v);
  if (slope_ > slides.repose().start && bearsLoose(surface, v)) return;
  double most = carried(v);
  for (const VertexId n : ring_) most = std::max(most, carried(n));
  error += most;
  if (!(error <= tolerance_) || !surface.remove(v)) return;
  ++count_.removed;
  count_.largestError = std::max(count_.largestError, error);
  surface.settle(ring_);
  for (const VertexId n : ring_) {
    carry(n, error);
    slides.addAround(surface, n);
  }
}

std::size_t CleanUp::bytes() const noexcept {
  return sizeof(*this) + waiting_.bytes() + carried_.bytes() +
         (queue_.capacity() + ring_.capacity()) * sizeof(VertexId);
}

}  // namespace teren
