// The proof that a triangulation is what it promises to be; written to be read, not to be fast.
#include <array>
#include <cstdint>
#include <string>

#include "generators/tin/Triangulation.h"

namespace teren {

/// The breach at one triangle, if there is one: it is what it should be towards its corners and neighbours.
Result<void> Triangulation::validateTriangle(TriangleId t) const {
  const auto breach = [t](const char* what) { return Error{"triangle " + std::to_string(t) + what}; };
  if (!isTriangle(t)) return breach(" is not in use");
  const TriangleMesh::Triangle& here = mesh_.triangle(t);
  for (const VertexId v : here.vertex) {
    if (!isVertex(v)) return breach(" has a corner that is no vertex");
  }
  if (orientation(point(here.vertex[0]), point(here.vertex[1]), point(here.vertex[2])) <= 0) {
    return breach(" does not turn left");
  }
  for (int i = 0; i < 3; ++i) {
    const VertexId a = here.vertex[following(i)];
    const VertexId b = here.vertex[preceding(i)];
    const Link over = here.link[i];
    if (over.isOutside()) {
      const LatticePoint p = point(a), q = point(b);
      const bool border = (p.x == q.x && (p.x == 0 || p.x == frame_.width)) ||
                          (p.y == q.y && (p.y == 0 || p.y == frame_.height));
      if (!border) return breach(" has no neighbour where the box goes on");
      continue;
    }
    if (!isTriangle(over.triangle()) || over.side() > 2)
      return breach(" has a neighbour that is no triangle");
    const TriangleMesh::Triangle& there = mesh_.triangle(over.triangle());
    const int j = over.side();
    if (there.link[j].withBarrier(false) != Link(t, i)) return breach(" is not its neighbour's neighbour");
    if (there.vertex[following(j)] != b || there.vertex[preceding(j)] != a) {
      return breach(" and a neighbour disagree about their edge");
    }
    if (over.isBarrier() != there.link[j].isBarrier() || over.isBarrier() != table_.contains(a, b)) {
      return breach(" has an edge whose constraint is not known everywhere");
    }
    if (!over.isBarrier() && inCircle(point(here.vertex[0]), point(here.vertex[1]), point(here.vertex[2]),
                                      point(there.vertex[j]))) {
      return breach(" has a vertex inside its circle");
    }
  }
  return {};
}

Result<void> Triangulation::validateAround(VertexId v) const {
  const auto breach = [v](const char* what) { return Error{"vertex " + std::to_string(v) + what}; };
  if (!isVertex(v)) return breach(" is not in use");
  if (!frame_.contains(point(v))) return breach(" lies outside the box");
  const Link star = mesh_.star(v);
  if (star.isOutside() || !isTriangle(star.triangle()) || mesh_.corner(star) != v) {
    return breach(" does not know a triangle of its own");
  }
  std::uint32_t constraints = 0;
  std::size_t visited = 0;
  Result<void> result;
  forEachCorner(v, [&](Link at) {
    if (result.ok()) result = validateTriangle(at.triangle());
    if (++visited > mesh_.triangleCount()) result = breach(" has an endless star");
  });
  if (!result.ok()) return result;
  forEachNeighbour(v, [&](VertexId w) { constraints += table_.contains(v, w) ? 1 : 0; });
  if (constraints != constraintsAt(v)) return breach(" miscounts its constrained edges");
  return {};
}

/// With the triangles proved one by one, these sums leave no room for gaps, overlaps and lost pieces.
Result<void> Triangulation::validate() const {
  std::size_t triangles = 0;
  std::int64_t area = 0;
  for (TriangleId t = 0; t < triangleSlots(); ++t) {
    if (!isTriangle(t)) continue;
    if (Result<void> result = validateTriangle(t); !result.ok()) return result;
    const std::array<VertexId, 3>& here = corners(t);
    area += orientation(point(here[0]), point(here[1]), point(here[2]));
    ++triangles;
  }
  std::size_t vertices = 0;
  std::size_t onBorder = 0;
  std::size_t ends = 0;
  for (VertexId v = 0; v < vertexSlots(); ++v) {
    if (!isVertex(v)) continue;
    if (Result<void> result = validateAround(v); !result.ok()) return result;
    ++vertices;
    onBorder += isOnBorder(v) ? 1 : 0;
    ends += constraintsAt(v);
  }
  if (triangles != triangleCount()) return Error{"the number of triangles is miscounted"};
  if (vertices != vertexCount()) return Error{"the number of vertices is miscounted"};
  if (area != 2 * static_cast<std::int64_t>(frame_.width) * frame_.height) {
    return Error{"the triangles' areas do not add up to the box's"};
  }
  if (triangles + onBorder + 2 != 2 * vertices) return Error{"Euler's formula does not hold"};
  if (ends != 2 * table_.size()) return Error{"there are constraints that are no edges"};
  return {};
}

}  // namespace teren
