// Fault formation the plain way: every sample asks every fault on which side it lies. The reference that
// FaultFormation must match bit for bit, and its rival in the benchmark.
#pragma once

#include "teren/Generator.h"

#include "generators/fault/FaultFormation.h"

namespace teren {

/// Fills `out` as the task of formation.begin(request, out) would. Costs faults * side^2 side tests.
void faultReference(const FaultFormation& formation, const MapRequest& request, HeightView out);

}  // namespace teren
