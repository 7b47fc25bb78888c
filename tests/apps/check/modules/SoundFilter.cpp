// Keeps its contract: halves every height.
#include "tests/apps/check/modules/Sound.h"

namespace {

class Half final : public teren::Filter {
 public:
  static std::span<const teren::Parameter> parameters() noexcept { return {}; }
  explicit Half(const teren::Values&) {}
  teren::HeightRange range(const teren::HeightRange& before) const override {
    return {0.5 * before.mean, 0.5 * before.deviation, 0.5 * before.min, 0.5 * before.max};
  }
  double residual(double before, int) const override { return 0.5 * before; }
  std::unique_ptr<teren::SlicedTask> begin(const teren::MapRequest&, teren::HeightView inOut) const override {
    return teren::makeRowTask(inOut, [inOut](int row) {
      for (int column = 0; column < inOut.columns(); ++column) inOut(column, row) *= 0.5f;
    });
  }
};

}  // namespace

TEREN_FILTER_PLUGIN(Half, "sound-filter", "1.0", "A filter of the checker's tests")
