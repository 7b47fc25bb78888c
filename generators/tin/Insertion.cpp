// Insertion by digging: the triangles whose circles hold the new vertex go, and a fan around it comes
// instead. That is what Lawson's flips would end with, with each triangle written once.
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "generators/tin/SpatialOrder.h"
#include "generators/tin/Triangulation.h"

namespace teren {

/// Takes away triangle t and all that can be reached from it across `sides` of its sides, counter-clockwise
/// from firstSide, through triangles whose circles hold p and across no barrier; what surrounds the gap goes
/// to rim_, counter-clockwise. The gap is visible from p, whether or not constraints bound it: where a
/// triangle's circle holds a point beyond one of its sides, the two other sides turn towards that point.
void Triangulation::dig(LatticePoint p, TriangleId t, int firstSide, int sides) {
  const auto takeAway = [this](TriangleId dug) {
    note(dug, false);
    freed_.push_back(dug);
  };
  rim_.clear();
  freed_.clear();
  pending_.clear();
  const auto pend = [this](const TriangleMesh::Triangle& of, int side) {
    pending_.push_back({of.vertex[following(side)], of.link[side]});
  };
  const TriangleMesh::Triangle& first = mesh_.triangle(t);
  takeAway(t);
  for (int n = sides; n-- > 0;) pend(first, (firstSide + n) % 3);
  while (!pending_.empty()) {
    const Rim edge = pending_.back();
    pending_.pop_back();
    if (!edge.outer.isBarrier()) {
      const TriangleMesh::Triangle& beyond = mesh_.triangle(edge.outer.triangle());
      if (inCircle(point(beyond.vertex[0]), point(beyond.vertex[1]), point(beyond.vertex[2]), p)) {
        takeAway(edge.outer.triangle());
        pend(beyond, preceding(edge.outer.side()));
        pend(beyond, following(edge.outer.side()));
        continue;
      }
    }
    rim_.push_back(edge);
  }
}

/// Joins v to the gap's rim, whose last entry, where the gap is not closed, only says where it ends: the two
/// edges from v there are the border.
void Triangulation::fillWithFan(VertexId v, bool closed) {
  const std::size_t count = closed ? rim_.size() : rim_.size() - 1;
  assert(freed_.size() < count);
  while (freed_.size() < count) freed_.push_back(mesh_.addTriangle());
  for (std::size_t i = 0; i < count; ++i) {
    const TriangleId t = freed_[i];
    const Rim& edge = rim_[i];
    const std::size_t next = i + 1 < rim_.size() ? i + 1 : 0;
    const Link after = i + 1 < count ? Link(freed_[i + 1], 2) : closed ? Link(freed_[0], 2) : Link::outside();
    const Link before = i > 0    ? Link(freed_[i - 1], 1)
                        : closed ? Link(freed_[count - 1], 1)
                                 : Link::outside();
    mesh_.triangle(t) = {{v, edge.from, rim_[next].from}, {edge.outer, after, before}};
    mesh_.join(Link(t, 0), edge.outer);
    mesh_.setStar(edge.from, Link(t, 1));
    note(t, true);
  }
  if (!closed) mesh_.setStar(rim_[count].from, Link(freed_[count - 1], 2));
  mesh_.setStar(v, Link(freed_[0], 0));
}

/// Connects a new vertex that lies at a place, not on another vertex.
void Triangulation::insertAt(VertexId v, const Location& place) {
  const LatticePoint p = point(v);
  const TriangleMesh::Triangle& there = mesh_.triangle(place.triangle);
  if (place.kind != Location::Kind::edge || !there.link[place.corner].isBarrier()) {
    dig(p, place.triangle, 0, 3);
    fillWithFan(v, true);
    return;
  }
  const VertexId a = there.vertex[following(place.corner)];
  const VertexId b = there.vertex[preceding(place.corner)];
  const Link side(place.triangle, place.corner);
  const std::optional<std::uint32_t> id = constraint(a, b);
  const bool border = there.link[place.corner].isOutside();
  if (id) {
    table_.erase(a, b);
    mesh_.changeConstraints(a, -1);
    mesh_.changeConstraints(b, -1);
  }
  if (border) {
    dig(p, place.triangle, following(place.corner), 2);
    rim_.push_back({a, Link::outside()});
  } else {
    mesh_.join(side, mesh_.across(side).withBarrier(false));
    dig(p, place.triangle, 0, 3);
  }
  fillWithFan(v, !border);
  if (id) {
    setConstrained(findEdge(v, a), *id);
    setConstrained(findEdge(v, b), *id);
  }
}

Insertion Triangulation::insert(LatticePoint p, double height, TriangleId hint) {
  assert(std::isfinite(height));
  const Location place = locate(p, hint);
  if (place.kind == Location::Kind::vertex) return {corners(place.triangle)[place.corner], false};
  const VertexId v = newVertex(p, height);
  insertAt(v, place);
  grid_.add(p, v);
  if (grid_.isCoarseFor(mesh_.vertexCount())) rebuildGrid();
  return {v, true};
}

Insertion Triangulation::insertOnSurface(LatticePoint p, TriangleId hint) {
  const Location place = locate(p, hint);
  return insert(p, heightAt(p, place), place.triangle);
}

Result<Insertion> Triangulation::insert(double x, double y, double height, TriangleId hint) {
  const std::optional<LatticePoint> p = frame_.snap(x, y);
  if (!p) {
    return Error{"the place (" + std::to_string(x) + ", " + std::to_string(y) + ") lies outside the mesh"};
  }
  if (!std::isfinite(height)) return Error{"the height of a vertex must be a finite number"};
  return insert(*p, height, hint);
}

std::vector<VertexId> Triangulation::insert(std::span<const LatticePoint> points,
                                            std::span<const double> heights) {
  assert(points.size() == heights.size());
  std::vector<std::uint32_t> order = hilbertOrder(points);
  if (points.size() >= mesh_.vertexCount()) return insertMany(points, heights, std::move(order));
  std::vector<VertexId> vertices(points.size());
  TriangleId near = kNoTriangle;
  for (const std::uint32_t i : order) {
    vertices[i] = insert(points[i], heights[i], near).vertex;
    near = triangleAt(vertices[i]);
  }
  return vertices;
}

/// Vertices get consecutive ids along the curve; every eighth of them is connected first and the others then,
/// for along the curve alone each would dig up half as many triangles again.
std::vector<VertexId> Triangulation::insertMany(std::span<const LatticePoint> points,
                                                std::span<const double> heights,
                                                std::vector<std::uint32_t> order) {
  const std::size_t count = points.size();
  mesh_.reserve(mesh_.vertexSlots() + count, mesh_.triangleSlots() + 2 * count);
  heights_.reserve(heights_.size() + count);
  const VertexId base = vertexSlots();
  for (const std::uint32_t i : order) {
    assert(frame_.contains(points[i]) && std::isfinite(heights[i]));
    mesh_.appendVertex(points[i]);
    heights_.push_back(heights[i]);
  }
  std::vector<VertexId> vertices(count);
  TriangleId near = kNoTriangle;
  const auto connect = [&](std::size_t n) {
    VertexId v = base + static_cast<VertexId>(n);
    const LatticePoint p = point(v);
    const Location place = near == kNoTriangle ? locate(p) : walk(p, near);
    if (place.kind != Location::Kind::vertex) {
      insertAt(v, place);
    } else {
      mesh_.freeVertex(v);
      v = corners(place.triangle)[place.corner];
      if (v >= base && order[n] < order[v - base]) {  // the first of equal points counts
        heights_[v] = heights[order[n]];
        order[v - base] = order[n];
      }
    }
    vertices[order[n]] = v;
    near = triangleAt(v);
  };
  for (std::size_t n = 0; n < count; n += 8) connect(n);
  for (std::size_t n = 0; n < count; ++n) {
    if (n % 8 != 0) connect(n);
  }
  mesh_.sortTriangles();
  rebuildGrid();
  return vertices;
}

}  // namespace teren
