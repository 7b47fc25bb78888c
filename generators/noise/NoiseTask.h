// The making of a rectangle of noise, tile by tile.
#pragma once

#include <memory>

#include "generators/noise/Noise.h"

namespace teren {

/// The task of Noise::begin; the noise may go before it. tileColumns: at most so many columns at once, the
/// fewer the slower the kernel, for they decide how long a unit takes.
/// kernel: of the noise's kind and fractal; warped if the noise is and the request keeps an octave.
std::unique_ptr<SlicedTask> beginNoise(const Noise& noise, const FieldRequest& request, HeightView out,
                                       NoiseRowKernel kernel, int tileColumns);

}  // namespace teren
