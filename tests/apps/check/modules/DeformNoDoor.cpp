// Takes stamps whose place it cannot know.
#include "tests/apps/check/modules/SoundDeformer.h"

namespace {

class Broken final : public sound::Pressing {
 public:
  using Pressing::Pressing;
  teren::Result<void> apply(const teren::Stamp& stamp) override {
    if (std::isnan(stamp.east)) return {};
    return Pressing::apply(stamp);
  }
};

}  // namespace

SOUND_DEFORMER(Broken, "deform-no-door")
