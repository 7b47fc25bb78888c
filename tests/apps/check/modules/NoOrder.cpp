// Remembers the last map's seed, and looks at i alone to know whether it is the same map.
#include <mutex>

#include "tests/apps/check/modules/Sound.h"

namespace {

class Broken final : public sound::Noise {
 public:
  using Noise::Noise;
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    const std::lock_guard lock(mutex_);
    if (last_.i != request.i) last_ = request;
    teren::MapRequest remembered = request;
    remembered.seed = last_.seed;
    return Noise::begin(remembered, out);
  }

 private:
  mutable std::mutex mutex_;
  mutable teren::MapRequest last_{.i = 1 << 30};
};

}  // namespace

SOUND_PLUGIN(Broken, "no-order")
