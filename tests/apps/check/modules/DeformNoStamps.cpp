// Takes no stamp with a strength that its table allows.
#include "tests/apps/check/modules/SoundDeformer.h"

namespace {

class Broken final : public sound::Pressing {
 public:
  using Pressing::Pressing;
  static teren::Result<double> reachOf(const teren::Stamp& stamp) {
    if (stamp.values.real("strength") > 1.5) return teren::Error{"that is too strong"};
    return Pressing::reachOf(stamp);
  }
};

}  // namespace

SOUND_DEFORMER(Broken, "deform-no-stamps")
