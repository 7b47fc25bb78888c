// The light of the demo, in one place: the sky, the sun, the haze and the water's level must agree.
#pragma once

#include <Inventor/SbColor.h>
#include <Inventor/SbVec3f.h>

namespace teren {

struct Daylight {
  SbColor haze{0.76F, 0.84F, 0.92F};    // horizon, background, and what the ground fades into
  SbColor zenith{0.16F, 0.37F, 0.70F};  // straight above
  SbColor sunlight{1.0F, 0.95F, 0.86F};
  SbVec3f sun{-0.80F, -0.25F, 0.45F};  // direction towards the sun; any length
  float waterLevel = -150.0F;          // [m]
};

}  // namespace teren
