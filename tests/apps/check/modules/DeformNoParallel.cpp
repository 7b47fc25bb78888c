// Knows the thread that began it, and raises a sample for others.
#include <thread>

#include "tests/apps/check/modules/SoundDeformer.h"

namespace {

class Broken final : public sound::Pressing {
 public:
  using Pressing::Pressing;
  teren::Result<void> apply(const teren::Stamp& stamp) override {
    teren::Result<void> applied = Pressing::apply(stamp);
    const teren::SampleRectangle middle = grid_.changed();
    if (applied && std::this_thread::get_id() != thread_) grid_.set(middle.column, middle.row, 7.0);
    return applied;
  }

 private:
  std::thread::id thread_ = std::this_thread::get_id();
};

}  // namespace

SOUND_DEFORMER(Broken, "deform-no-parallel")
