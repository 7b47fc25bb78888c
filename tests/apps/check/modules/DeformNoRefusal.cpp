// Has pressed the tool in before it finds that it must not.
#include "tests/apps/check/modules/SoundDeformer.h"

namespace {

class Broken final : public sound::Pressing {
 public:
  using Pressing::Pressing;
  teren::Result<void> apply(const teren::Stamp& stamp) override {
    teren::Result<void> applied = Pressing::apply(stamp);
    const teren::SampleRectangle middle = grid_.changed();
    if (!applied && !middle.isEmpty()) grid_.set(middle.column, middle.row, 7.0);
    return applied;
  }
};

}  // namespace

SOUND_DEFORMER(Broken, "deform-no-refusal")
