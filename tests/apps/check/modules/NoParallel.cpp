// Keeps a height in the generator while it makes it.
#include <atomic>
#include <thread>

#include "tests/apps/check/modules/Sound.h"

namespace {

class Broken final : public sound::Noise {
 public:
  using Noise::Noise;
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    return rows(request, out, [this, samples = request.samples, n = 0](float height) mutable {
      scratch_ = height;
      // Others get their turn on a single processor, too, but not so often that it takes long.
      if (n++ % samples == 0) std::this_thread::yield();
      return scratch_.load();
    });
  }

 private:
  mutable std::atomic<float> scratch_ = 0.0f;
};

}  // namespace

SOUND_PLUGIN(Broken, "no-parallel")
