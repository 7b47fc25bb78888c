// Keeps its contract.
#include "tests/apps/check/modules/Sound.h"

SOUND_PLUGIN(sound::Noise, "sound")
