// Says that its levels are half as wrong as they are.
#include "tests/apps/check/modules/Sound.h"

namespace {

class Broken final : public sound::Noise {
 public:
  using Noise::Noise;
  double residual(int level, int samples, double spacing) const override {
    return 0.5 * Noise::residual(level, samples, spacing);
  }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-residual")
