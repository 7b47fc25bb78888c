// Flips, and what is made of them: Lawson's restoring of the Delaunay property and Sloan's forcing of edges.
#include <cassert>
#include <utility>

#include "generators/tin/Triangulation.h"

namespace teren {

/// Exchanges the diagonal of a convex quadrangle. The triangles t and u at the side keep their ids: before, t
/// is (a, b, c) with the side opposite a, and u has d opposite it; after, t is (a, b, d) and u (a, d, c).
void Triangulation::flip(Link side) {
  const TriangleId t = side.triangle();
  const Link over = mesh_.across(side);
  assert(!over.isBarrier());
  const TriangleId u = over.triangle();
  note(t, false);
  note(u, false);
  const TriangleMesh::Triangle here = mesh_.triangle(t);
  const TriangleMesh::Triangle there = mesh_.triangle(u);
  const int i = side.side();
  const int j = over.side();
  const VertexId a = here.vertex[i];
  const VertexId b = here.vertex[following(i)];
  const VertexId c = here.vertex[preceding(i)];
  const VertexId d = there.vertex[j];

  mesh_.triangle(t).vertex = {a, b, d};
  mesh_.triangle(u).vertex = {a, d, c};
  mesh_.join(Link(t, 2), here.link[preceding(i)]);
  mesh_.join(Link(t, 0), there.link[following(j)]);
  mesh_.join(Link(u, 0), there.link[preceding(j)]);
  mesh_.join(Link(u, 1), here.link[following(i)]);
  mesh_.join(Link(t, 1), Link(u, 2));
  mesh_.setStar(a, Link(t, 0));
  mesh_.setStar(b, Link(t, 1));
  mesh_.setStar(c, Link(u, 2));
  mesh_.setStar(d, Link(t, 2));
  note(t, true);
  note(u, true);
}

/// Flips until no edge near suspects_ has a vertex inside its circle (Lawson 1977). A suspect whose triangle
/// has changed meanwhile names another edge, which does no harm, and its own was made a suspect again then.
void Triangulation::restore() {
  while (!suspects_.empty()) {
    const Link side = suspects_.back();
    suspects_.pop_back();
    const Link over = mesh_.across(side);
    if (over.isBarrier()) continue;
    const std::array<VertexId, 3>& here = corners(side.triangle());
    if (!inCircle(point(here[0]), point(here[1]), point(here[2]), point(mesh_.corner(over)))) continue;
    const TriangleId t = side.triangle();
    const TriangleId u = over.triangle();
    flip(side);
    suspects_.insert(suspects_.end(), {Link(t, 0), Link(t, 2), Link(u, 0), Link(u, 1)});
  }
}

/// Records the triangles on both sides of an edge that has become or ceased to be constrained.
void Triangulation::noteFence(Link side) {
  if (fenced_ == nullptr) return;
  fenced_->push_back(side.triangle());
  const Link over = mesh_.across(side);
  if (!over.isOutside()) fenced_->push_back(over.triangle());
}

/// Makes an edge a constrained one, if it is not, and sets its id.
void Triangulation::setConstrained(Link side, std::uint32_t id) {
  const VertexId a = corners(side.triangle())[following(side.side())];
  const VertexId b = corners(side.triangle())[preceding(side.side())];
  if (!table_.contains(a, b)) {
    mesh_.join(side, mesh_.across(side).withBarrier(true));
    mesh_.changeConstraints(a, 1);
    mesh_.changeConstraints(b, 1);
    noteFence(side);
  }
  table_.set(a, b, id);
}

bool Triangulation::isConstrained(TriangleId t, int i) const noexcept {
  const Link over = mesh_.triangle(t).link[i];
  if (!over.isOutside()) return over.isBarrier();
  return table_.contains(corners(t)[following(i)], corners(t)[preceding(i)]);
}

std::optional<std::uint32_t> Triangulation::constraint(VertexId a, VertexId b) const noexcept {
  if (!table_.contains(a, b)) return std::nullopt;
  return table_.id(a, b);
}

bool Triangulation::unconstrain(VertexId a, VertexId b) {
  if (!table_.contains(a, b)) return false;
  const Link side = findEdge(a, b);
  table_.erase(a, b);
  mesh_.changeConstraints(a, -1);
  mesh_.changeConstraints(b, -1);
  noteFence(side);
  if (mesh_.across(side).isOutside()) return true;
  mesh_.join(side, mesh_.across(side).withBarrier(false));
  suspects_.assign(1, side);
  restore();
  return true;
}

}  // namespace teren
