// Sound, but ends its process by a signal where the finest map has 5 samples a side; and says something on
// standard output.
#include <csignal>
#include <cstdio>

#include "tests/apps/check/modules/Sound.h"

namespace {

class Crash final : public sound::Noise {
 public:
  using Noise::Noise;
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    if (request.finestIntervals == 4) {
      std::puts("here I fall");
      std::fflush(stdout);
      std::raise(SIGKILL);
    }
    return Noise::begin(request, out);
  }
};

}  // namespace

SOUND_PLUGIN(Crash, "crash")
