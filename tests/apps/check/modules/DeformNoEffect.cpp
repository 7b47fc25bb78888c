// Never changes anything.
#include "tests/apps/check/modules/SoundDeformer.h"

namespace {

class Broken final : public sound::Pressing {
 public:
  using Pressing::Pressing;
  teren::Result<void> apply(const teren::Stamp& stamp) override {
    const teren::Result<double> reach = reachOf(stamp);
    if (!reach) return reach.error();
    return teren::checkPlace(grid_.region(), stamp, *reach);
  }
};

}  // namespace

SOUND_DEFORMER(Broken, "deform-no-effect")
