// The plugin "constant": one height everywhere. The smallest useful generator, and the ground on which other
// layers are measured.
#include <algorithm>

#include "teren/Plugin.h"
#include "teren/RowTask.h"

namespace {

class ConstantGenerator final : public teren::Generator {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    static constexpr teren::Parameter table[] = {
        teren::Parameter::real("height", 0.0, -1e6, 1e6, "m", "Height of every sample"),
    };
    return table;
  }

  explicit ConstantGenerator(const teren::Values& values)
      : height_(static_cast<float>(values.real("height"))) {}

  // All maps are the same, so the mean over all seeds is the height itself and nothing deviates from it.
  teren::HeightRange range() const override {
    return {.mean = height_, .deviation = 0.0, .min = height_, .max = height_};
  }
  // Triangles through any samples lie at the height too.
  double residual(int, int, double) const override { return 0.0; }

  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest&,
                                               teren::HeightView out) const override {
    return teren::makeRowTask(
        out, [out, height = height_](int row) { std::fill_n(out.row(row), out.columns(), height); });
  }

 private:
  float height_;
};

}  // namespace

TEREN_GENERATOR_PLUGIN(ConstantGenerator, "constant", "1.0", "One height everywhere")
