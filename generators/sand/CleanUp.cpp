#include "generators/sand/CleanUp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace teren {
namespace {

constexpr double kParts = 65535.0;
/// A removal and what gives its volume back move places by at most so many widths of the band.
constexpr double kErrorPerBand = 2.5;

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

/// What lies on both sides of the edge from one vertex to another.
struct Quadrangle {
  VertexId left = kNoVertex;
  VertexId right = kNoVertex;
  Link ahead;   // the edge as a side of the triangle to the left
  Link behind;  // and to the right
};

Quadrangle quadrangleAt(const Triangulation& mesh, VertexId a, VertexId b) {
  Quadrangle found;
  mesh.forEachCorner(a, [&](Link at) {
    const std::array<VertexId, 3>& corners = mesh.corners(at.triangle());
    const int after = following(at.side()), before = preceding(at.side());
    if (corners[after] == b) {
      found.left = corners[before];
      found.ahead = Link(at.triangle(), before);
    } else if (corners[before] == b) {
      found.right = corners[after];
      found.behind = Link(at.triangle(), after);
    }
  });
  return found;
}

/// Whether, once the edge a b has flipped, the four edges around it stay.
bool flipsAlone(const Triangulation& mesh, const Quadrangle& around) {
  const auto stays = [&](Link edge, int side, VertexId newCorner) {
    const std::array<VertexId, 3>& corners = mesh.corners(edge.triangle());
    const VertexId from = corners[following(side)], to = corners[preceding(side)];
    const TriangleId beyond = mesh.neighbour(edge.triangle(), side);
    if (beyond == kNoTriangle || mesh.constraint(from, to)) return true;
    for (const VertexId far : mesh.corners(beyond)) {
      if (far == from || far == to) continue;
      return !inCircle(mesh.point(from), mesh.point(to), mesh.point(newCorner), mesh.point(far));
    }
    return false;
  };
  const auto bothStay = [&](Link edge, VertexId newCorner) {
    return stays(edge, following(edge.side()), newCorner) && stays(edge, preceding(edge.side()), newCorner);
  };
  return bothStay(around.ahead, around.right) && bothStay(around.behind, around.left);
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

void CleanUp::take(const CleanUp& other, std::span<const VertexId> taken) {
  for (VertexId v = 0; v < taken.size(); ++v) {
    if (taken[v] != kNoVertex) carry(taken[v], other.carried(v));
  }
  for (const VertexId v : other.queue_) {
    if (v < taken.size() && taken[v] != kNoVertex) add(taken[v]);
  }
}

void CleanUp::run(SandSurface& surface, Slides& slides, std::uint32_t kept, std::size_t most) {
  const std::size_t looked = std::min(most, queue_.size());
  for (const VertexId v : std::span(queue_.data(), looked)) {
    waiting_.erase(v);
    if (!surface.mesh().isVertex(v)) continue;
    ++count_.looked;
    if (surface.mesh().constraintsAt(v) > 0) dissolveAt(surface, slides, v, kept);
    if (surface.mesh().constraintsAt(v) == 0) removeIfFlat(surface, slides, v);
  }
  queue_.serve(looked);
}

void CleanUp::dissolveAt(SandSurface& surface, Slides& slides, VertexId v, std::uint32_t kept) {
  const Triangulation& mesh = surface.mesh();
  ring_.clear();
  mesh.forEachNeighbour(v, [this](VertexId n) { ring_.push_back(n); });
  for (const VertexId to : ring_) {
    if (mesh.constraintsAt(to) == 0) continue;
    const auto id = mesh.constraint(v, to);
    if (id && *id < kept) dissolve(surface, slides, v, to);
  }
}

/// Dissolves the constrained edge between two vertices, where that moves no place too far.
void CleanUp::dissolve(SandSurface& surface, Slides& slides, VertexId a, VertexId b) {
  const Quadrangle around = quadrangleAt(surface.mesh(), a, b);
  const auto place = [&](VertexId v) { return surface.mesh().point(v); };
  const bool onBorder = around.left == kNoVertex || around.right == kNoVertex;
  if (onBorder || !inCircle(place(a), place(around.right), place(b), place(around.left))) {
    surface.unconstrain(a, b);
    ++count_.dissolved;
    return;
  }
  double error = 0.0;
  for (const VertexId v : {a, b, around.left, around.right}) error = std::max(error, carried(v));
  error += kErrorPerBand * foldOf(surface, a, around.right, b, around.left);
  if (error > tolerance_ || !flipsAlone(surface.mesh(), around)) return;
  surface.unconstrain(a, b);
  ++count_.dissolved;
  count_.largestError = std::max(count_.largestError, error);
  const std::array<VertexId, 4> touched{a, around.right, b, around.left};
  surface.settle(touched);
  for (const VertexId v : touched) {
    carry(v, std::max(error, carried(v)));
    slides.addAround(surface, v);
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
  return sizeof(*this) + waiting_.bytes() + carried_.bytes() + queue_.bytes() +
         ring_.capacity() * sizeof(VertexId);
}

}  // namespace teren
