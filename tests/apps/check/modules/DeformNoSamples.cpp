// Leaves a row of a part out.
#include "tests/apps/check/modules/SoundDeformer.h"

namespace {

class Ground final : public sound::Behind {
 public:
  using Behind::Behind;
  void samples(const teren::SampleRectangle& rectangle, teren::HeightView out) const override {
    teren::SampleRectangle part = rectangle;
    if (part.row > 0 && part.rows > 1) --part.rows;
    Behind::samples(part, out.part(0, 0, part.columns, part.rows));
  }
};

}  // namespace

SOUND_DEFORMER(sound::Showing<Ground>, "deform-no-samples")
