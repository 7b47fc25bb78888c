// Midpoint displacement the plain way: a height asks for those of its parents, which ask for theirs. The
// reference that MidpointDisplacement must match bit for bit, and its rival in the benchmark.
#pragma once

#include "teren/Generator.h"

#include "generators/midpoint/MidpointDisplacement.h"

namespace teren {

/// Fills `out` as the task of displacement.begin(request, out) would. Every height is made once and
/// remembered.
void midpointReference(const MidpointDisplacement& displacement, const MapRequest& request, HeightView out);

}  // namespace teren
