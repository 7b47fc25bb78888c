// Thermal erosion the plain way, neighbour by neighbour from a copy of the map: the reference that
// ThermalFilter must match bit for bit, and its rival in the benchmark.
#pragma once

#include "generators/filter/ThermalFilter.h"

namespace teren {

/// Changes `inOut` as the task of filter.begin(spacing, inOut) would.
void thermalReference(const ThermalFilter& filter, double spacing, HeightView inOut);

}  // namespace teren
