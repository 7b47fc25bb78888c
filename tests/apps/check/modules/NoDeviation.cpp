// Deviates by a quarter more than promised.
#include "tests/apps/check/modules/Sound.h"

namespace {

class Broken final : public sound::Noise {
 public:
  using Noise::Noise;
  teren::HeightRange range() const override { return {0.0, deviation(), -1.3 * largest(), 1.3 * largest()}; }
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    return rows(request, out, [](float height) { return 1.25f * height; });
  }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-deviation")
