// Its levels are a little higher than the finest map.
#include "tests/apps/check/modules/Sound.h"

namespace {

class Broken final : public sound::Noise {
 public:
  using Noise::Noise;
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    const float shift = request.level == 0 ? 0.0f : 1e-4f;
    return rows(request, out, [shift](float height) { return height + shift; });
  }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-levels")
