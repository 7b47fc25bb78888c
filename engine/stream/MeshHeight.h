// What the triangles of one mesh say at a place.
#pragma once

#include <cstdint>
#include <optional>

#include "teren/Scene.h"

#include "stream/SeenVertices.h"

namespace teren {

/// [m] The height of the first triangle of a mesh, in the order of its indices, that holds a place, rims
/// included, with its vertices moved as `seen` (nullptr: as they lie): with the bits of SceneQuery::points.
/// The place is that of level-0 sample (column, row) and a share, 0 ... 1, of the way to the next one on both
/// axes. Empty where no triangle lies. O(triangles).
std::optional<double> meshHeight(const Mesh& mesh, std::int64_t column, std::int64_t row, double east,
                                 double north, const SeenVertices* seen) noexcept;

/// [m] Of a vertex; `seen` counts from the world's zero.
float heightOf(const Mesh& mesh, const SurfaceVertex& vertex, const SeenVertices* seen) noexcept;

}  // namespace teren
