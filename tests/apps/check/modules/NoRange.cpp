// Promises bounds at one deviation.
#include "tests/apps/check/modules/Sound.h"

namespace {

class Broken final : public sound::Noise {
 public:
  using Noise::Noise;
  teren::HeightRange range() const override { return {0.0, deviation(), -deviation(), deviation()}; }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-range")
