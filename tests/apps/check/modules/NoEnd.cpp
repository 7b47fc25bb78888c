// Is never done where the finest map has 5 samples a side.
#include "tests/apps/check/modules/Sound.h"

namespace {

class Endless final : public teren::SlicedTask {
 public:
  bool step(const teren::Slice&) override { return false; }
};

class Broken final : public sound::Noise {
 public:
  using Noise::Noise;
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    if (request.finestIntervals == 4) return std::make_unique<Endless>();
    return Noise::begin(request, out);
  }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-end")
