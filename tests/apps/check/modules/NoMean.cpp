// Lies a seventh of a deviation higher than promised.
#include "tests/apps/check/modules/Sound.h"

namespace {

class Broken final : public sound::Noise {
 public:
  using Noise::Noise;
  teren::HeightRange range() const override { return {0.0, deviation(), -largest(), 1.1 * largest()}; }
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    const auto shift = static_cast<float>(deviation() / 7.0);
    return rows(request, out, [shift](float height) { return height + shift; });
  }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-mean")
