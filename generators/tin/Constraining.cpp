// Constrained edges: the way from a to b is traced, crossings with older constraints become vertices, and
// what else it crosses is flipped away (Sloan 1993).
#include <algorithm>
#include <cassert>
#include <cstdlib>

#include "generators/tin/Triangulation.h"

namespace teren {

/// True where a vertex w, |turn| beside the way from a to b, is within half a step of it, measured along an
/// axis, and both ways to w are shorter.
bool Triangulation::isNearWay(LatticePoint a, LatticePoint b, LatticePoint w, std::int64_t turn) noexcept {
  const auto square = [](LatticePoint p, LatticePoint q) {
    const std::int64_t x = p.x - q.x, y = p.y - q.y;
    return x * x + y * y;
  };
  const std::int64_t whole = square(a, b);
  return 2 * std::abs(turn) <= std::max(std::abs(b.x - a.x), std::abs(b.y - a.y)) && square(a, w) < whole &&
         square(w, b) < whole;
}

/// Follows the way from a to b up to the first vertex on it, where it ends, or the first constrained edge
/// across it, which becomes `barrier`, or, if it bends, the first vertex near it, a detour. The edges it
/// crosses go to crossed_, each as (right, left).
Triangulation::Way Triangulation::trace(VertexId a, VertexId b, bool bends) {
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
  if (bends && way.end == kNoVertex) {
    for (const int i : {following(side.side()), preceding(side.side())}) {
      const VertexId w = corners(side.triangle())[i];
      if (isNearWay(from, to, point(w), orientation(from, to, point(w)))) way.detour = w;
    }
  }
  while (way.end == kNoVertex && way.detour == kNoVertex) {
    const Link over = mesh_.across(side);
    const std::array<VertexId, 3>& here = corners(side.triangle());
    crossed_.push_back({here[following(side.side())], here[preceding(side.side())]});
    if (over.isBarrier()) {
      way.barrier = side;
      return way;
    }
    const VertexId w = mesh_.corner(over);
    const std::int64_t turn = orientation(from, to, point(w));
    if (turn == 0) {
      way.end = w;
    } else if (bends && isNearWay(from, to, point(w), turn)) {
      way.detour = w;
    }
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
/// the segment's ends, so each piece is shorter than what it replaces. Why it does so soon: pieces bend to
/// vertices within half a step (as in snap rounding), so that bundles of almost equal constraints become one.
bool Triangulation::cross(const Piece& piece, Link barrier) {
  const VertexId c = corners(barrier.triangle())[following(barrier.side())];
  const VertexId d = corners(barrier.triangle())[preceding(barrier.side())];
  const LatticePoint p = roundedCrossing(point(piece.a), point(piece.b), point(c), point(d));
  if (p == point(c) || p == point(d)) {
    const VertexId end = p == point(c) ? c : d;
    pieces_.push_back({end, piece.b, piece.id, true});
    pieces_.push_back({piece.a, end, piece.id, true});
    return false;
  }
  const std::uint32_t id = table_.id(c, d);
  const double height = heightAt(p, barrier.triangle());
  unconstrain(c, d);
  const Insertion crossing = insert(p, height, triangleAt(c));
  const VertexId x = crossing.vertex;
  pieces_.push_back({x, piece.b, piece.id, true});
  pieces_.push_back({piece.a, x, piece.id, true});
  pieces_.push_back({c, x, id, true});
  pieces_.push_back({x, d, id, true});
  bendTo(x);
  return crossing.isNew;
}

/// Constrained edges that pass a new crossing within half a step go through it from now on.
void Triangulation::bendTo(VertexId x) {
  made_.clear();
  forEachCorner(x, [&](Link at) {
    if (!mesh_.across(at).isBarrier()) return;
    const VertexId e = corners(at.triangle())[following(at.side())];
    const VertexId f = corners(at.triangle())[preceding(at.side())];
    const std::int64_t turn = orientation(point(e), point(f), point(x));
    if (table_.contains(e, f) && isNearWay(point(e), point(f), point(x), turn)) made_.push_back({e, f});
  });
  const std::vector<Edge> edges = made_;
  for (const Edge& edge : edges) {
    const std::uint32_t id = table_.id(edge.a, edge.b);
    unconstrain(edge.a, edge.b);
    pieces_.push_back({edge.a, x, id, true});
    pieces_.push_back({x, edge.b, id, true});
  }
}

int Triangulation::constrain(VertexId a, VertexId b, std::uint32_t id) {
  assert(isVertex(a) && isVertex(b));
  int added = 0;
  pieces_.assign(1, {a, b, id, false});
  while (!pieces_.empty()) {
    const Piece piece = pieces_.back();
    pieces_.pop_back();
    if (piece.a == piece.b) continue;
    const Way way = trace(piece.a, piece.b, piece.bends);
    if (way.detour != kNoVertex) {
      pieces_.push_back({way.detour, piece.b, piece.id, true});
      pieces_.push_back({piece.a, way.detour, piece.id, true});
      continue;
    }
    if (way.end == kNoVertex) {
      if (cross(piece, way.barrier)) ++added;
      continue;
    }
    // An older constraint, broken where this one crosses it, takes no edge from a newer one.
    if (piece.id == id || !table_.contains(piece.a, way.end)) forceEdge(piece.a, way.end, piece.id);
    pieces_.push_back({way.end, piece.b, piece.id, piece.bends});
  }
  return added;
}

}  // namespace teren
