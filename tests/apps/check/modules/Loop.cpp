// Loops for ever where the finest map has 5 samples a side.
#include <atomic>

#include "tests/apps/check/modules/Sound.h"

namespace {

std::atomic<bool> go = true;

class Loop final : public sound::Noise {
 public:
  using Noise::Noise;
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    while (request.finestIntervals == 4 && go) {
    }
    return Noise::begin(request, out);
  }
};

}  // namespace

SOUND_PLUGIN(Loop, "loop")
