// Keeps the contract of deformers.
#include "tests/apps/check/modules/SoundDeformer.h"

SOUND_DEFORMER(sound::Pressing, "sound-press")
