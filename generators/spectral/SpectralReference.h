// Spectral synthesis the plain way: every sample asks every wave for its height. The reference for the
// transform, and its rival in the benchmark.
#pragma once

#include <vector>

#include "generators/spectral/SpectralSynthesis.h"

namespace teren {

/// The heights, in double, that the task of synthesis.begin(request, ...) rounds to floats: rows from south
/// to north, request.samples^2 of them (samples >= 2). Costs samples^2 harmonics^2 multiplications.
std::vector<double> spectralReference(const SpectralSynthesis& synthesis, const MapRequest& request);

/// The same as a plain programmer writes it, in float and with one sine table: the rival.
void spectralDirectSum(const SpectralSynthesis& synthesis, const MapRequest& request, HeightView out);

}  // namespace teren
