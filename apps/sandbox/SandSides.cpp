#include "apps/sandbox/SandSides.h"

#include "apps/sandbox/SandPainter.h"

namespace teren {

float SandSides::bottomOf(const SandSnapshot& sand) noexcept {
  return sand.bounds().low - 0.05F * sideOf(sand);
}

const std::vector<SandVertex>& SandSides::of(const std::shared_ptr<const SandSnapshot>& sand) {
  if (last_ == sand) return triangles_;
  last_ = sand;
  triangles_.clear();
  const float bottom = bottomOf(*sand);
  const auto sign = [](std::int32_t n) {
    return static_cast<std::int16_t>(n > 0 ? 32767 : n < 0 ? -32767 : 0);
  };
  const std::vector<VertexId>& edges = border_.of(sand);
  for (std::size_t k = 0; k + 1 < edges.size(); k += 2) {
    SandVertex a = sand->vertex(edges[k]), b = sand->vertex(edges[k + 1]);
    a.normal = b.normal = {sign(b.place.y - a.place.y), sign(a.place.x - b.place.x)};
    SandVertex belowA = a, belowB = b;
    belowA.height = belowB.height = bottom;
    triangles_.insert(triangles_.end(), {a, belowA, belowB, a, belowB, b});
  }
  return triangles_;
}

void SandSides::clear() {
  border_.clear();
  last_.reset();
  triangles_.clear();
}

}  // namespace teren
