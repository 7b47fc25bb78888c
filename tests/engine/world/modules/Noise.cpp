// HashNoise as a module, for worlds that are made from a description.
#include "teren/Plugin.h"

#include "tests/engine/world/HashNoise.h"

TEREN_GENERATOR_PLUGIN(teren::HashNoise, "noise", "1.0", "a random number a sample")
