// Which parts of a tool's outline run through the box of sand: what lies beyond the border is cut off.
#pragma once

#include <span>
#include <vector>

#include "generators/sand/ToolShape.h"
#include "generators/tin/LatticeFrame.h"

namespace teren {

/// Consecutive lattice points of an outline, no two neighbours equal.
struct LatticeChain {
  std::vector<LatticePoint> points;  // at least 1
  bool closed = false;               // all of the outline; otherwise both ends lie on the border
};

/// The parts of a closed outline, or of a single point, that lie in the box. Its points are in the frame's
/// coordinates [m]; those inside but within `margin` [m] of a border are put on it, so that no part runs
/// along the border nearer than that. Nothing where it lies wholly outside. Finite numbers only.
std::vector<LatticeChain> clippedOutline(const LatticeFrame& frame, std::span<const ToolPoint> outline,
                                         double margin);

}  // namespace teren
