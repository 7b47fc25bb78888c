// Divides by the seed.
#include "tests/apps/check/modules/Sound.h"

namespace {

class Broken final : public sound::Noise {
 public:
  using Noise::Noise;
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    const float factor = static_cast<float>(request.seed) / static_cast<float>(request.seed);
    return rows(request, out, [factor](float height) { return factor * height; });
  }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-finite")
