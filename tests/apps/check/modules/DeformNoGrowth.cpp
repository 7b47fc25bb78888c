// Forgets what was pressed where it grows.
#include "tests/apps/check/modules/SoundDeformer.h"

namespace {

class Broken final : public sound::Pressing {
 public:
  using Pressing::Pressing;
  teren::Result<void> grow(const teren::DeformRegion& region, teren::ConstHeightView ground) override {
    grid_ = teren::DeformGrid(region, ground);
    return {};
  }
};

}  // namespace

SOUND_DEFORMER(Broken, "deform-no-growth")
