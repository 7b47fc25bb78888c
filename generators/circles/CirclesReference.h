// Circles the plain way: every sample asks every disc. The reference that Circles must match bit for bit, and
// its rival in the benchmark.
#pragma once

#include "generators/circles/Circles.h"

namespace teren {

/// Fills `out` as the task of circles.begin(request, out) would. Costs discs * side^2 profiles.
void circlesReference(const Circles& circles, const MapRequest& request, HeightView out);

}  // namespace teren
