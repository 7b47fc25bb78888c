#include "apps/sandbox/SandEdges.h"

namespace teren {
namespace {

/// Whether an edge lies on one side of the box.
bool isOnBorder(const SandSnapshot& sand, VertexId a, VertexId b) {
  const LatticePoint p = sand.vertex(a).place, q = sand.vertex(b).place;
  const LatticeFrame& frame = sand.frame();
  return (p.x == q.x && (p.x == 0 || p.x == frame.width)) ||
         (p.y == q.y && (p.y == 0 || p.y == frame.height));
}

/// The edges of one page's triangles; of the two triangles beside a constrained edge the one where its ids
/// rise has it, and on the border the only one.
std::vector<VertexId> edgesOfPage(const SandSnapshot& sand, std::size_t page, SandEdges::Kind kind) {
  std::vector<VertexId> edges;
  for (std::size_t k = 0; k < SandTrianglePage::kSlots; ++k) {
    const auto t = static_cast<TriangleId>(page * SandTrianglePage::kSlots + k);
    if (!sand.isTriangle(t)) continue;
    for (int i = 0; i < 3; ++i) {
      const VertexId a = sand.corners(t)[static_cast<std::size_t>(following(i))];
      const VertexId b = sand.corners(t)[static_cast<std::size_t>(preceding(i))];
      const bool border = isOnBorder(sand, a, b);
      const bool wanted =
          kind == SandEdges::Kind::border ? border : sand.isConstrained(t, i) && (border || a < b);
      if (wanted) edges.insert(edges.end(), {a, b});
    }
  }
  return edges;
}

}  // namespace

const std::vector<VertexId>& SandEdges::of(const std::shared_ptr<const SandSnapshot>& sand) {
  if (last_ == sand) return all_;
  const SandSnapshot none;
  const auto& pages = sand->trianglePages();
  ofPage_.resize(pages.size());
  pages.forEachDifference((last_ ? *last_ : none).trianglePages(),
                          [&](std::size_t i) { ofPage_[i] = edgesOfPage(*sand, i, kind_); });
  all_.clear();
  for (const std::vector<VertexId>& edges : ofPage_) all_.insert(all_.end(), edges.begin(), edges.end());
  last_ = sand;
  return all_;
}

void SandEdges::clear() {
  last_.reset();
  ofPage_.clear();
  all_.clear();
}

}  // namespace teren
