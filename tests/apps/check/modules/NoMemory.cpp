// Keeps something of every map for ever.
#include <list>
#include <mutex>

#include "tests/apps/check/modules/Sound.h"

namespace {

std::mutex mutex;
std::list<teren::MapRequest> kept;

class Broken final : public sound::Noise {
 public:
  using Noise::Noise;
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    const std::lock_guard lock(mutex);
    kept.push_back(request);
    return Noise::begin(request, out);
  }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-memory")
