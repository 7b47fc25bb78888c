// Tells another height at a sample than the sample's.
#include "tests/apps/check/modules/SoundDeformer.h"

namespace {

class Ground final : public sound::Behind {
 public:
  using Behind::Behind;
  double height(double east, double north) const override {
    return Behind::height(east, north) + (east > 8.0 ? 0.25 : 0.0);
  }
};

}  // namespace

SOUND_DEFORMER(sound::Showing<Ground>, "deform-no-heights")
