// Refuses without a word.
#include "tests/apps/check/modules/SoundDeformer.h"

namespace {

class Broken final : public sound::Pressing {
 public:
  using Pressing::Pressing;
  teren::Result<void> apply(const teren::Stamp& stamp) override {
    if (Pressing::apply(stamp)) return {};
    return teren::Error{};
  }
};

}  // namespace

SOUND_DEFORMER(Broken, "deform-no-sentence")
