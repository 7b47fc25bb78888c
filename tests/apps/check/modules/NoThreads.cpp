// Prepares each thread that begins a task, and forgets those that only step one.
#include "tests/apps/check/modules/Sound.h"

namespace {

thread_local float factor = 0.0f;

class Broken final : public sound::Noise {
 public:
  using Noise::Noise;
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    factor = 1.0f;
    return rows(request, out, [](float height) { return factor * height; });
  }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-threads")
