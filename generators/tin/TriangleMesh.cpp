#include "generators/tin/TriangleMesh.h"

#include <algorithm>
#include <vector>

namespace teren {

void TriangleMesh::sortTriangles() {
  const auto lowest = [](const Triangle& t) { return std::min({t.vertex[0], t.vertex[1], t.vertex[2]}); };
  std::vector<TriangleId> next(vertices_.size() + 1,
                               0);  // the next id for triangles whose lowest vertex this is
  for (TriangleId t = 0; t < triangles_.size(); ++t) {
    if (isTriangle(t)) ++next[lowest(triangles_[t]) + 1];
  }
  for (std::size_t v = 1; v < next.size(); ++v) next[v] += next[v - 1];
  std::vector<TriangleId> renamed(triangles_.size(), kNoTriangle);
  for (TriangleId t = 0; t < triangles_.size(); ++t) {
    if (isTriangle(t)) renamed[t] = next[lowest(triangles_[t])]++;
  }

  CompactArray<Triangle> sorted;
  sorted.resize(triangleCount(), Triangle{});
  for (TriangleId t = 0; t < triangles_.size(); ++t) {
    if (!isTriangle(t)) continue;
    Triangle& to = sorted[renamed[t]];
    to = triangles_[t];
    for (Link& link : to.link) {
      if (!link.isOutside()) link = Link(renamed[link.triangle()], link.side(), link.isBarrier());
    }
    for (int i = 0; i < 3; ++i) vertices_[to.vertex[i]].star = Link(renamed[t], i);
  }
  triangles_ = std::move(sorted);
  freeTriangle_ = kNoTriangle;
  freeTriangles_ = 0;
}

}  // namespace teren
