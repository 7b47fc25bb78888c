// Removal by cutting ears in Delaunay order (Devillers 1999).
#include <algorithm>
#include <cassert>
#include <limits>

#include "generators/tin/Triangulation.h"

namespace teren {

/// Takes away the triangles at v; what surrounds them goes to ring_, counter-clockwise, and on the border one
/// more side that closes it.
void Triangulation::collectRing(VertexId v) {
  const LatticePoint p = point(v);
  ring_.clear();
  freed_.clear();
  const auto add = [&](VertexId from, Link outer) {
    const LatticePoint q = point(from);
    const auto n = static_cast<std::uint32_t>(ring_.size());
    ring_.push_back({{from, outer}, q.x - p.x, q.y - p.y, n - 1, n + 1, 0.0});
  };
  VertexId end = kNoVertex;
  forEachCorner(v, [&](Link at) {
    const TriangleMesh::Triangle& here = mesh_.triangle(at.triangle());
    add(here.vertex[following(at.side())], here.link[at.side()]);
    end = here.vertex[preceding(at.side())];
    freed_.push_back(at.triangle());
    note(at.triangle(), false);
  });
  if (end != ring_.front().rim.from) add(end, Link::outside());
  ring_.front().before = static_cast<std::uint32_t>(ring_.size()) - 1;
  ring_.back().after = 0;
}

/// Were the vertex to rise above the paraboloid over which Delaunay triangles are the lower hull, its edges
/// would vanish one by one: this is the height at which the one to corner b does. Infinite where the ear at b
/// is not convex or holds the vertex. Whether it is infinite is decided exactly; the height is rounded.
double Triangulation::earTime(const RingCorner& b) const noexcept {
  const RingCorner& a = ring_[b.before];
  const RingCorner& c = ring_[b.after];
  const std::int64_t ca =
      c.x * a.y - c.y * a.x;  // negative: the corner to be removed sees c to the left of a
  const std::int64_t area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (ca >= 0 || area <= 0) return std::numeric_limits<double>::infinity();
  const std::int64_t bc = b.x * c.y - b.y * c.x;
  const std::int64_t ab = a.x * b.y - a.y * b.x;
  const auto square = [](const RingCorner& corner) {
    return static_cast<double>(corner.x * corner.x + corner.y * corner.y);
  };
  const double power = square(a) * static_cast<double>(bc) + square(b) * static_cast<double>(ca) +
                       square(c) * static_cast<double>(ab);
  return power / static_cast<double>(area);
}

/// Makes the triangle between three consecutive sides of a gap.
TriangleId Triangulation::fillTriangle(const Rim& a, const Rim& b, const Rim& c) {
  const TriangleId t = freed_.back();
  freed_.pop_back();
  mesh_.triangle(t) = {{a.from, b.from, c.from}, {b.outer, c.outer, a.outer}};
  mesh_.join(Link(t, 2), a.outer);
  mesh_.join(Link(t, 0), b.outer);
  mesh_.join(Link(t, 1), c.outer);
  mesh_.setStar(a.from, Link(t, 0));
  mesh_.setStar(b.from, Link(t, 1));
  mesh_.setStar(c.from, Link(t, 2));
  note(t, true);
  return t;
}

/// The last four corners: the diagonal that is inside, or if both are, the Delaunay one.
void Triangulation::fillQuadrangle(std::uint32_t first) {
  std::array<Rim, 4> rim;
  for (Rim& side : rim) {
    side = ring_[first].rim;
    first = ring_[first].after;
  }
  const auto at = [&](int i) { return point(rim[i % 4].from); };
  const auto convexAt = [&](int i) { return orientation(at(i + 3), at(i), at(i + 1)) > 0; };
  const bool zeroToTwo = convexAt(1) && convexAt(3);
  const bool oneToThree = convexAt(0) && convexAt(2);
  assert(zeroToTwo || oneToThree);
  const bool turned = !zeroToTwo || (oneToThree && inCircle(at(0), at(1), at(2), at(3)));
  const int n = turned ? 1 : 0;
  // The diagonal is a placeholder of the first triangle until the second is made.
  const TriangleId t = freed_.back();
  fillTriangle(rim[n], rim[n + 1], {rim[(n + 2) % 4].from, Link::outside()});
  fillTriangle({rim[n].from, Link(t, 1)}, rim[(n + 2) % 4], rim[(n + 3) % 4]);
}

/// A corner's ear is due at another time than before.
void Triangulation::reschedule(std::uint32_t corner, bool queued) {
  const double time = earTime(ring_[corner]);
  ring_[corner].time = time;
  if (!queued || time == std::numeric_limits<double>::infinity()) return;
  due_.push_back({time, corner});
  std::push_heap(due_.begin(), due_.end());
}

/// The corner whose ear is due first, of those that are left, `any` among them.
std::uint32_t Triangulation::firstDue(std::uint32_t any, bool queued) {
  std::uint32_t best = any;
  if (!queued) {
    for (std::uint32_t i = ring_[any].after; i != any; i = ring_[i].after) {
      if (ring_[i].time < ring_[best].time) best = i;
    }
  } else {
    for (bool current = false; !current; due_.pop_back()) {
      assert(!due_.empty());
      std::pop_heap(due_.begin(), due_.end());
      best = due_.back().corner;
      current = due_.back().time == ring_[best].time;  // else it has been cut or rescheduled since
    }
  }
  assert(ring_[best].time < std::numeric_limits<double>::infinity());
  return best;
}

/// Fills the gap in ring_. Four corners are decided exactly. Of more, the ear that is due first is cut; since
/// the times are rounded, the new edges are then checked exactly and flipped where the rounding misled.
void Triangulation::cutEars() {
  constexpr std::size_t kFew = 24;  // up to so many corners looking at each is faster than a queue
  const bool queued = ring_.size() > kFew;
  suspects_.clear();
  due_.clear();
  if (ring_.size() > 4) {
    for (std::uint32_t i = 0; i < ring_.size(); ++i) reschedule(i, queued);
  }
  std::uint32_t any = 0;
  for (std::size_t left = ring_.size(); left > 4; --left) {
    const std::uint32_t best = firstDue(any, queued);
    const std::uint32_t before = ring_[best].before, after = ring_[best].after;
    const TriangleId t =
        fillTriangle(ring_[before].rim, ring_[best].rim, {ring_[after].rim.from, Link::outside()});
    suspects_.push_back(Link(t, 1));
    ring_[best].time = std::numeric_limits<double>::infinity();
    ring_[before].rim.outer = Link(t, 1);
    ring_[before].after = after;
    ring_[after].before = before;
    reschedule(before, queued);
    reschedule(after, queued);
    any = before;
  }
  if (ring_[ring_[ring_[any].after].after].after == any) {
    fillTriangle(ring_[any].rim, ring_[ring_[any].after].rim, ring_[ring_[any].before].rim);
  } else {
    fillQuadrangle(any);
  }
  restore();
}

bool Triangulation::remove(VertexId v) {
  assert(isVertex(v));
  if (v < 4 || constraintsAt(v) > 0) return false;
  const LatticePoint p = point(v);
  collectRing(v);
  grid_.replace(p, v, ring_.front().rim.from);
  mesh_.freeVertex(v);
  cutEars();
  while (!freed_.empty()) {
    mesh_.freeTriangle(freed_.back());
    freed_.pop_back();
  }
  return true;
}

}  // namespace teren
