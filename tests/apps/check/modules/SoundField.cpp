// Keeps its contract.
#include "tests/apps/check/modules/SoundField.h"

SOUND_PLUGIN(sound::Field, "sound-field")
