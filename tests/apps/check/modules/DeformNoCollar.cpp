// Changes ground twice as far away as it says.
#include "tests/apps/check/modules/SoundDeformer.h"

namespace {

class Broken final : public sound::Pressing {
 public:
  using Pressing::Pressing;
  static teren::Result<double> reachOf(const teren::Stamp& stamp) {
    teren::Result<double> reach = Pressing::reachOf(stamp);
    if (reach) *reach *= 0.5;
    return reach;
  }
  teren::Result<void> apply(const teren::Stamp& stamp) override {
    const teren::Result<double> reach = reachOf(stamp);
    if (!reach) return reach.error();
    if (teren::Result<void> place = teren::checkPlace(grid_.region(), stamp, *reach); !place) return place;
    press(stamp);
    return {};
  }
};

}  // namespace

SOUND_DEFORMER(Broken, "deform-no-collar")
