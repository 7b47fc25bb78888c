#include "generators/tin/Triangulation.h"

#include <cassert>
#include <cmath>
#include <cstdlib>

namespace teren {

Triangulation::Triangulation(const LatticeFrame& frame, double height)
    : frame_(frame), grid_({0, 0}, frame.width, frame.height) {
  assert(1 <= frame.width && frame.width <= kLatticeSide);
  assert(1 <= frame.height && frame.height <= kLatticeSide);
  assert(frame.step > 0.0 && std::isfinite(height));
  newVertex({0, 0}, height);
  newVertex({frame.width, 0}, height);
  newVertex({frame.width, frame.height}, height);
  newVertex({0, frame.height}, height);
  const TriangleId east = mesh_.addTriangle();
  const TriangleId west = mesh_.addTriangle();
  mesh_.triangle(east) = {{0, 1, 2}, {Link::outside(), Link(west, 1), Link::outside()}};
  mesh_.triangle(west) = {{0, 2, 3}, {Link::outside(), Link::outside(), Link(east, 1)}};
  mesh_.join(Link(east, 1), Link(west, 2));
  mesh_.setStar(0, Link(east, 0));
  mesh_.setStar(1, Link(east, 1));
  mesh_.setStar(2, Link(west, 1));
  mesh_.setStar(3, Link(west, 2));
  rebuildGrid();
}

void Triangulation::reserve(std::size_t vertices) {
  mesh_.reserve(vertices, 2 * vertices);
  heights_.reserve(vertices);
}

std::size_t Triangulation::bytes() const noexcept {
  return sizeof(*this) + mesh_.bytes() + heights_.bytes() + table_.bytes() + grid_.bytes() +
         (rim_.capacity() + pending_.capacity()) * sizeof(Rim) + freed_.capacity() * sizeof(TriangleId) +
         ring_.capacity() * sizeof(RingCorner) + due_.capacity() * sizeof(Due) +
         suspects_.capacity() * sizeof(Link) + (crossed_.capacity() + made_.capacity()) * sizeof(Edge) +
         pieces_.capacity() * sizeof(Piece);
}

void Triangulation::expectWithin(LatticePoint corner, std::int32_t width, std::int32_t height) {
  grid_ = JumpGrid(corner, width, height);
  rebuildGrid();
}

void Triangulation::rebuildGrid() {
  grid_.rebuildFor(mesh_.vertexCount());
  for (VertexId v = 0; v < vertexSlots(); ++v) {
    if (isVertex(v)) grid_.add(point(v), v);
  }
}

VertexId Triangulation::newVertex(LatticePoint p, double height) {
  const VertexId v = mesh_.addVertex(p);
  if (v == heights_.size()) {
    heights_.push_back(height);
  } else {
    heights_[v] = height;
  }
  return v;
}

/// The hint if p lies in it; else the hint, or the jump grid's vertex, whichever is nearer to p.
TriangleId Triangulation::startFor(LatticePoint p, TriangleId hint) const noexcept {
  const bool hinted = isTriangle(hint);
  LatticePoint at;
  if (hinted) {
    const std::array<VertexId, 3>& corner = corners(hint);
    at = point(corner[0]);
    const LatticePoint b = point(corner[1]), c = point(corner[2]);
    if (orientation(at, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, at, p) >= 0) return hint;
  }
  const VertexId near = grid_.near(p, [this](VertexId v) { return isVertex(v); });
  if (!hinted) return triangleAt(near == kNoVertex ? 0 : near);
  if (near == kNoVertex) return hint;
  const LatticePoint other = point(near);
  const auto distance = [p](LatticePoint q) { return std::abs(q.x - p.x) + std::abs(q.y - p.y); };
  return distance(at) <= distance(other) ? hint : triangleAt(near);
}

/// The remembering visibility walk (Devillers, Pion, Teillaud 2002): from triangle to triangle across a side
/// that has p beyond it, never back. Among constrained edges a fixed choice between two such sides could go
/// round in circles, so the choice alternates as the bits of a pseudo-random sequence do, the same in every
/// run. Latency bounds it: two dependent loads a triangle.
Location Triangulation::walk(LatticePoint p, TriangleId start) const noexcept {
  const auto place = [](TriangleId t, int i, std::int64_t u, std::int64_t v, std::int64_t w) -> Location {
    const std::array<std::int64_t, 3> areas{u, v, w};
    const int zeros = (u == 0) + (v == 0) + (w == 0);
    if (zeros == 0) return {Location::Kind::face, t, 0};
    int k = 0;
    while ((areas[k] == 0) != (zeros == 1)) ++k;
    return {zeros == 1 ? Location::Kind::edge : Location::Kind::vertex, t, (i + k) % 3};
  };

  Link at(start, 0);
  std::uint32_t choice = 0x9e3779b9U;
  std::int64_t entered = 1;  // the area over side 0: known to be positive except in the first triangle
  {
    const TriangleMesh::Triangle& first = mesh_.triangle(start);
    entered = orientation(point(first.vertex[1]), point(first.vertex[2]), p);
    if (entered < 0) {
      at = first.link[0];
      entered = 1;
    }
  }
  for (;;) {
    assert(!at.isOutside());
    const TriangleMesh::Triangle& here = mesh_.triangle(at.triangle());
    const int i = at.side();
    const LatticePoint a = point(here.vertex[i]);
    const LatticePoint b = point(here.vertex[following(i)]);
    const LatticePoint c = point(here.vertex[preceding(i)]);
    const std::int64_t overB = orientation(c, a, p);
    const std::int64_t overC = orientation(a, b, p);
    if (overB >= 0 && overC >= 0) return place(at.triangle(), i, entered, overB, overC);
    choice = choice * 1664525U + 1013904223U;
    const bool both = overB < 0 && overC < 0;
    const bool throughB = both ? (choice >> 31) != 0 : overB < 0;
    at = here.link[throughB ? following(i) : preceding(i)];
    entered = 1;
  }
}

Location Triangulation::locate(LatticePoint p, TriangleId hint) const noexcept {
  assert(frame_.contains(p));
  const Location found = walk(p, startFor(p, hint));
  if (found.kind == Location::Kind::face) return found;
  const std::array<VertexId, 3>& corner = corners(found.triangle);
  if (found.kind == Location::Kind::vertex) {
    const Link star = mesh_.star(corner[found.corner]);
    return {found.kind, star.triangle(), star.side()};
  }
  const Link side = leftOf(Link(found.triangle, found.corner));
  return {found.kind, side.triangle(), side.side()};
}

/// Of the two sides that are one edge the one on the left on the way from its more western (southern) end.
Link Triangulation::leftOf(Link side) const noexcept {
  const std::array<VertexId, 3>& corner = corners(side.triangle());
  const LatticePoint from = point(corner[following(side.side())]), to = point(corner[preceding(side.side())]);
  const Link over = mesh_.across(side);
  if (over.isOutside() || from.x < to.x || (from.x == to.x && from.y < to.y)) return side;
  return Link(over.triangle(), over.side());
}

void Triangulation::turn(TriangleId t, VertexId first) noexcept {
  const TriangleMesh::Triangle before = mesh_.triangle(t);
  int side = 0;
  while (before.vertex[side] != first) ++side;
  for (int n = 0; n < 3; ++n, side = following(side)) {
    mesh_.triangle(t).vertex[n] = before.vertex[side];
    mesh_.join(Link(t, n), before.link[side]);
    mesh_.setStar(before.vertex[side], Link(t, n));
  }
}

VertexId Triangulation::vertexAt(LatticePoint p, TriangleId hint) const noexcept {
  const Location place = locate(p, hint);
  return place.kind == Location::Kind::vertex ? corners(place.triangle)[place.corner] : kNoVertex;
}

double Triangulation::heightAt(LatticePoint p, TriangleId hint) const noexcept {
  return heightAt(p, locate(p, hint));
}

double Triangulation::heightAt(LatticePoint p, const Location& place) const noexcept {
  const std::array<VertexId, 3>& corner = corners(place.triangle);
  if (place.kind == Location::Kind::vertex) return heights_[corner[place.corner]];
  if (place.kind == Location::Kind::edge) {
    VertexId a = corner[following(place.corner)];
    VertexId b = corner[preceding(place.corner)];
    if (a > b) std::swap(a, b);  // the same from both sides
    const LatticePoint from = point(a);
    const LatticePoint to = point(b);
    const bool eastward = std::abs(to.x - from.x) >= std::abs(to.y - from.y);
    const double part = eastward ? static_cast<double>(p.x - from.x) / (to.x - from.x)
                                 : static_cast<double>(p.y - from.y) / (to.y - from.y);
    return heights_[a] + part * (heights_[b] - heights_[a]);
  }
  const LatticePoint a = point(corner[0]);
  const LatticePoint b = point(corner[1]);
  const LatticePoint c = point(corner[2]);
  const auto whole = static_cast<double>(orientation(a, b, c));
  const double partB = static_cast<double>(orientation(c, a, p)) / whole;
  const double partC = static_cast<double>(orientation(a, b, p)) / whole;
  const double base = heights_[corner[0]];
  return base + (partB * (heights_[corner[1]] - base) + partC * (heights_[corner[2]] - base));
}

namespace {

/// Looks through the triangles at one vertex for an edge to another, a triangle at a time.
class StarSearch {
 public:
  StarSearch(const TriangleMesh& mesh, VertexId centre, VertexId other) noexcept
      : mesh_(mesh), other_(other), first_(mesh.star(centre)), at_(first_) {}

  /// The side that is the edge, if it belongs to the triangle at hand.
  Link found() const noexcept {
    const std::array<VertexId, 3>& here = mesh_.triangle(at_.triangle()).vertex;
    if (here[following(at_.side())] == other_) return Link(at_.triangle(), preceding(at_.side()));
    if (here[preceding(at_.side())] == other_) return Link(at_.triangle(), following(at_.side()));
    return Link::outside();
  }
  /// Goes on to the next triangle; false when all have been seen.
  bool advance() noexcept {
    if (!backward_) {
      at_ = mesh_.nextAround(at_);
      if (!at_.isOutside()) return at_ != first_;
      at_ = first_;
      backward_ = true;
    }
    at_ = mesh_.previousAround(at_);
    return !at_.isOutside();
  }

 private:
  const TriangleMesh& mesh_;
  VertexId other_;
  Link first_;
  Link at_;
  bool backward_ = false;  // the border was met
};

}  // namespace

/// leftOf() the edge between a and b, or outside. Looks at both ends in turn: O(the smaller number of
/// neighbours).
Link Triangulation::findEdge(VertexId a, VertexId b) const noexcept {
  StarSearch atA(mesh_, a, b);
  StarSearch atB(mesh_, b, a);
  do {
    if (const Link side = atA.found(); !side.isOutside()) return leftOf(side);
    if (const Link side = atB.found(); !side.isOutside()) return leftOf(side);
  } while (atA.advance() && atB.advance());
  return Link::outside();
}

}  // namespace teren
