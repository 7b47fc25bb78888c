// How the sand of one island becomes another's: by whole steps of the lattice, and nothing is lost.
#pragma once

#include <cstdint>
#include <vector>

#include "generators/sand/SandSurface.h"

namespace teren {

/// Takes what is open in another surface into one that has those squares, `column` and `row` being where the
/// other's first one lies, closed, and none of them beside one of its own that is open. Vertices come with
/// their heights and what lies loose on them, edges with what constrains them, whose ids grow by `ids` but
/// for the fence's; where vertices lie on one circle diagonals are those that were, so that it is the same
/// surface, triangle by triangle, and its volume, loose and solid, the same number. What the other owes this
/// one owes: volume() + owed() - entered() stays. Nobody's triangles outside are left behind, and where both
/// lie in their boxes leaves no trace.
///
/// Returns the vertices that the other's have become, kNoVertex for those outside. O(n log n) of the other.
std::vector<VertexId> mergeSand(SandSurface& surface, const SandSurface& other, int column, int row,
                                std::uint32_t ids);

}  // namespace teren
