// The good module of these tests.
#include "Broken.h"

using Flat = broken::Flat;
TEREN_GENERATOR_PLUGIN(Flat, "flat", "1.0", "one height everywhere")
