#include "tests/engine/world/ValueNoise.h"

#include "teren/Plugin.h"

TEREN_GENERATOR_PLUGIN(teren::ValueNoise, "value-noise", "1.0",
                       "random heights at lattice points, smoothly joined")
