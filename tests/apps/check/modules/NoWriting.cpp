// Leaves out the last sample where the seed is 0.
#include "tests/apps/check/modules/Sound.h"

namespace {

class Broken final : public sound::Noise {
 public:
  using Noise::Noise;
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    if (request.seed != 0) return Noise::begin(request, out);
    return teren::makeRowTask(out, [this, request, out](int row) {
      for (int column = 0; column < out.columns() - row / (out.rows() - 1); ++column)
        out(column, row) = height(request, column, row);
    });
  }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-writing")
