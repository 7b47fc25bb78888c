// The matrix filter the plain way, sample by sample from a copy of the map: the reference that MatrixFilter
// must match bit for bit, and its rival in the benchmark.
#pragma once

#include "generators/filter/MatrixFilter.h"

namespace teren {

/// Changes `inOut` as the task of filter.begin(inOut) would.
void matrixReference(const MatrixFilter& filter, HeightView inOut);

}  // namespace teren
