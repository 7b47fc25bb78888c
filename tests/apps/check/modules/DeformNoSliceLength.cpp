// Works for half a millisecond more before it looks at the clock.
#include <chrono>

#include "teren/ProcessorTime.h"

#include "tests/apps/check/modules/SoundDeformer.h"

namespace {

class Broken final : public sound::Pressing {
 public:
  using Pressing::Pressing;
  bool step(const teren::Slice& slice, std::uint64_t upTo) override {
    if (slice.over()) return Pressing::step(slice, upTo);
    const auto start = teren::threadProcessorTime();
    const bool done = Pressing::step(slice, upTo);
    while (!done && teren::threadProcessorTime() < start + std::chrono::microseconds(kTime)) {
    }
    return done;
  }

 private:
  static constexpr int kTime = teren::kSanitizerWord == 0 ? 500 : 2500;
};

}  // namespace

SOUND_DEFORMER(Broken, "deform-no-slice-length")
