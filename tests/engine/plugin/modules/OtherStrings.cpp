// Compiled for another std::string, with visible symbols.
#include "Broken.h"

using Flat = broken::Flat;
TEREN_GENERATOR_PLUGIN(Flat, "other-strings", "1.0", "one height everywhere")
