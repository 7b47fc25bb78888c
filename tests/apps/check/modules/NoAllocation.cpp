// Takes memory for each row.
#include <algorithm>
#include <vector>

#include "tests/apps/check/modules/Sound.h"

namespace {

class Broken final : public sound::Noise {
 public:
  using Noise::Noise;
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    return teren::makeRowTask(out, [this, request, out](int row) {
      std::vector<float> heights(static_cast<std::size_t>(out.columns()));
      for (int column = 0; column < out.columns(); ++column)
        heights[static_cast<std::size_t>(column)] = height(request, column, row);
      std::copy(heights.begin(), heights.end(), out.row(row));
    });
  }
};

}  // namespace

SOUND_PLUGIN(Broken, "no-allocation")
