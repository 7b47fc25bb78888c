// The generator "plain": flat land, PLAIN_HEIGHT metres high.
#include <algorithm>

#include "teren/Plugin.h"
#include "teren/RowTask.h"

namespace {

class Plain final : public teren::Generator {
 public:
  static std::span<const teren::Parameter> parameters() noexcept { return {}; }
  explicit Plain(const teren::Values&) {}

  teren::HeightRange range() const override { return {PLAIN_HEIGHT, 0.0, PLAIN_HEIGHT, PLAIN_HEIGHT}; }
  double residual(int, int, double) const override { return 0.0; }
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest&,
                                               teren::HeightView out) const override {
    return teren::makeRowTask(
        out, [out](int row) { std::fill_n(out.row(row), out.columns(), float{PLAIN_HEIGHT}); });
  }
};

}  // namespace

TEREN_GENERATOR_PLUGIN(Plain, "plain", "1.0", "flat land")
