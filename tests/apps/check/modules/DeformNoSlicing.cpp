// Raises a sample whenever it goes on in the middle of a step.
#include "tests/apps/check/modules/SoundDeformer.h"

namespace {

class Broken final : public sound::Pressing {
 public:
  using Pressing::Pressing;
  bool step(const teren::Slice& slice, std::uint64_t upTo) override {
    const bool within = isWithinStep();
    const bool done = Pressing::step(slice, upTo);
    const teren::SampleRectangle middle = grid_.changed();
    if (within && !middle.isEmpty()) {
      grid_.set(middle.column, middle.row, grid_(middle.column, middle.row) + 1e-2);
    }
    return done;
  }
};

}  // namespace

SOUND_DEFORMER(Broken, "deform-no-slicing")
