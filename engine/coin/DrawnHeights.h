// Between which heights a vertex is drawn, wherever it is seen from.
#pragma once

#include <algorithm>
#include <utility>

#include "teren/SurfaceVertex.h"

namespace teren {

/// [m] The lowest and the highest: its own and the coarser surface's, where it has one (Morph.h).
inline std::pair<float, float> drawnHeights(const SurfaceVertex& vertex) noexcept {
  if (vertex.level() == SurfaceVertex::kFixed) return {vertex.height, vertex.height};
  return std::minmax({vertex.height, vertex.coarserHeight});
}

}  // namespace teren
