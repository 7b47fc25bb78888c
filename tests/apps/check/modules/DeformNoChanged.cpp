// Forgets the last column of what has changed.
#include "tests/apps/check/modules/SoundDeformer.h"

namespace {

class Ground final : public sound::Behind {
 public:
  using Behind::Behind;
  teren::SampleRectangle changed() const override {
    teren::SampleRectangle rectangle = Behind::changed();
    if (rectangle.columns > 0) --rectangle.columns;
    return rectangle;
  }
};

}  // namespace

SOUND_DEFORMER(sound::Showing<Ground>, "deform-no-changed")
