// Level ground of loose sand with vertices all over it: what experiments and benchmarks dig in.
#pragma once

#include <cstddef>

#include "generators/sand/SandSurface.h"

namespace teren {

/// A square metre of sand `loose` [m] deep on level 0, with this many vertices (4, the corners
/// included, to SandSurface::kMostVertices) at random places, the same for the same number; some fewer where
/// places coincide. Room for `spare` more is set aside.
SandSurface levelSand(int vertices, double loose, std::size_t spare);

}  // namespace teren
