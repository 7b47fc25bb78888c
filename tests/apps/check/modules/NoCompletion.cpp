// Throws where the finest map has 5 samples a side.
#include <stdexcept>

#include "tests/apps/check/modules/Sound.h"

namespace {

class Broken final : public sound::Noise {
 public:
  using Noise::Noise;
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    return rows(request, out, [small = request.finestIntervals == 4](float height) {
      if (small) throw std::runtime_error("too small");
      return height;
    });
  }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-completion")
