// Writes one sample too many in each row, where there is room for it.
#include "tests/apps/check/modules/Sound.h"

namespace {

class Broken final : public sound::Noise {
 public:
  using Noise::Noise;
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    return teren::makeRowTask(out, [this, request, out](int row) {
      for (int column = 0; column < out.columns(); ++column) out(column, row) = height(request, column, row);
      if (out.stride() > out.columns()) out.row(row)[out.columns()] = 7.0f;
    });
  }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-margins")
