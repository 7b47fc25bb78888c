#include "apps/sandbox/SandEdges.h"

namespace teren {
namespace {

/// The constrained edges of one page's triangles; of the two triangles beside an edge the one where it runs
/// upwards has it, and on the border the only one.
std::vector<VertexId> edgesOfPage(const SandSnapshot& sand, std::size_t page) {
  std::vector<VertexId> edges;
  const auto isOnBorder = [&](VertexId v) { return sand.frame().isOnBorder(sand.vertex(v).place); };
  for (std::size_t k = 0; k < SandTrianglePage::kSlots; ++k) {
    const auto t = static_cast<TriangleId>(page * SandTrianglePage::kSlots + k);
    for (int i = 0; i < 3; ++i) {
      if (!sand.isConstrained(t, i)) continue;
      const VertexId a = sand.corners(t)[static_cast<std::size_t>(following(i))];
      const VertexId b = sand.corners(t)[static_cast<std::size_t>(preceding(i))];
      if (a < b || (isOnBorder(a) && isOnBorder(b))) edges.insert(edges.end(), {a, b});
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
                          [&](std::size_t i) { ofPage_[i] = edgesOfPage(*sand, i); });
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
