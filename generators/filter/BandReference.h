// The band filter the plain way, one sample after the other: the reference that BandFilter must match bit for
// bit, and its rival in the benchmark.
#pragma once

#include "generators/filter/BandFilter.h"

namespace teren {

/// Changes `inOut` as the task of filter.begin(inOut) would.
void bandReference(const BandFilter& filter, HeightView inOut);

}  // namespace teren
