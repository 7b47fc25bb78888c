// Constrained edges: the way from a to b is traced, crossings with older constraints become vertices, and
// what else it crosses is flipped away (Sloan 1993).
#include <cassert>

#include "generators/tin/Triangulation.h"

namespace teren {

/// Follows the way from a to b up to the first vertex on it, where it ends, or the first constrained edge
/// across it, which becomes `barrier`. The edges it crosses go to crossed_, each as (right, left).
Triangulation::Way Triangulation::trace(VertexId a, VertexId b) {
  const LatticePoint from = point(a);
  const LatticePoint to = point(b);
  crossed_.clear();
  Way way;
  Link side = Link::outside();
  forEachCorner(a, [&](Link at) {
    if (way.end != kNoVertex || !side.isOutside()) return;
    const std::array<VertexId, 3>& here = corners(at.triangle());
    const VertexId right = here[following(at.side())];
    const VertexId left = here[preceding(at.side())];
    const std::int64_t ofRight = orientation(from, point(right), to);
    const std::int64_t ofLeft = orientation(from, point(left), to);
    if (ofRight >= 0 && ofLeft < 0) {
      if (ofRight == 0) way.end = right;
      side = at;
    } else if (ofLeft == 0 && ofRight > 0) {
      way.end = left;
    }
  });
  while (way.end == kNoVertex) {
    const Link over = mesh_.across(side);
    const std::array<VertexId, 3>& here = corners(side.triangle());
    crossed_.push_back({here[following(side.side())], here[preceding(side.side())]});
    if (over.isBarrier()) {
      way.barrier = side;
      return way;
    }
    const VertexId w = mesh_.corner(over);
    const std::int64_t turn = orientation(from, to, point(w));
    if (turn == 0) way.end = w;
    side = Link(over.triangle(), turn > 0 ? following(over.side()) : preceding(over.side()));
  }
  return way;
}

/// Flips the edges in crossed_ until a and b, between which no vertex lies, share an edge. An edge whose two
/// triangles do not make a strictly convex quadrangle waits until others have been flipped.
void Triangulation::flipAway(VertexId a, VertexId b) {
  const LatticePoint from = point(a);
  const LatticePoint to = point(b);
  made_.clear();
  for (std::size_t head = 0; head < crossed_.size(); ++head) {
    const Edge edge = crossed_[head];
    const Link side = findEdge(edge.a, edge.b);
    const VertexId x = mesh_.corner(side);
    const VertexId y = mesh_.corner(mesh_.across(side));
    const std::int64_t ofA = orientation(point(x), point(y), point(edge.a));
    const std::int64_t ofB = orientation(point(x), point(y), point(edge.b));
    if (ofA == 0 || ofB == 0 || (ofA > 0) == (ofB > 0)) {
      crossed_.push_back(edge);
      continue;
    }
    flip(side);
    const std::int64_t ofX = orientation(from, to, point(x));
    const std::int64_t ofY = orientation(from, to, point(y));
    const bool crosses = (ofX > 0 && ofY < 0) || (ofX < 0 && ofY > 0);
    (crosses ? crossed_ : made_).push_back({x, y});
  }
}

/// Makes a and b, between which no vertex and no barrier lies, share a constrained edge.
void Triangulation::forceEdge(VertexId a, VertexId b, std::uint32_t id) {
  flipAway(a, b);
  setConstrained(findEdge(a, b), id);
  suspects_.clear();
  for (const Edge& edge : made_) suspects_.push_back(findEdge(edge.a, edge.b));
  restore();
}

/// The way from a to b crosses a constrained edge: their crossing becomes a vertex, and four pieces go to the
/// list of those to be forced, or two where the crossing is an end already.
/// Why this comes to an end: the lattice point nearest to a point X of a segment is no farther from X than
/// the segment's ends, so each piece is shorter than what it replaces.
bool Triangulation::cross(const Piece& piece, Link barrier) {
  const VertexId c = corners(barrier.triangle())[following(barrier.side())];
  const VertexId d = corners(barrier.triangle())[preceding(barrier.side())];
  const LatticePoint p = roundedCrossing(point(piece.a), point(piece.b), point(c), point(d));
  if (p == point(c) || p == point(d)) {
    const VertexId end = p == point(c) ? c : d;
    pieces_.push_back({end, piece.b, piece.id});
    pieces_.push_back({piece.a, end, piece.id});
    return false;
  }
  const std::uint32_t id = table_.id(c, d);
  const double height = heightAt(p, barrier.triangle());
  unconstrain(c, d);
  const Insertion crossing = insert(p, height, triangleAt(c));
  const VertexId x = crossing.vertex;
  pieces_.push_back({x, piece.b, piece.id});
  pieces_.push_back({piece.a, x, piece.id});
  pieces_.push_back({c, x, id});
  pieces_.push_back({x, d, id});
  return crossing.isNew;
}

int Triangulation::constrain(VertexId a, VertexId b, std::uint32_t id) {
  assert(isVertex(a) && isVertex(b));
  int added = 0;
  pieces_.assign(1, {a, b, id});
  while (!pieces_.empty()) {
    const Piece piece = pieces_.back();
    pieces_.pop_back();
    if (piece.a == piece.b) continue;
    const Way way = trace(piece.a, piece.b);
    if (way.end == kNoVertex) {
      if (cross(piece, way.barrier)) ++added;
      continue;
    }
    forceEdge(piece.a, way.end, piece.id);
    pieces_.push_back({way.end, piece.b, piece.id});
  }
  return added;
}

}  // namespace teren
