// The plugin "thermal": thermal erosion (generators/filter).
#include "teren/Plugin.h"

#include "generators/filter/ThermalFilter.h"

namespace {

class ThermalFilterPlugin final : public teren::Filter {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    using teren::Parameter;
    static constexpr Parameter table[] = {
        Parameter::real("talus", 33.0, 0.0, teren::ThermalFilter::kMaxTalus, "degree",
                        "Steepest slope that stays; loose rock lies at 30 to 40"),
        Parameter::integer("passes", 20, 1, teren::ThermalFilter::kMaxPasses, "",
                           "How often material slides; more bring slopes nearer to rest and cost "
                           "proportionally more"),
    };
    return table;
  }

  explicit ThermalFilterPlugin(const teren::Values& values)
      : filter_(values.real("talus"), static_cast<int>(values.integer("passes"))) {}

  teren::HeightRange range(const teren::HeightRange& before) const override { return filter_.range(before); }
  double residual(double before, int level) const override { return filter_.residual(before, level); }
  std::unique_ptr<teren::SlicedTask> begin(const teren::MapRequest& request,
                                           teren::HeightView inOut) const override {
    return filter_.begin(request.spacing, inOut);
  }

 private:
  teren::ThermalFilter filter_;
};

}  // namespace

TEREN_FILTER_PLUGIN(ThermalFilterPlugin, "thermal", "1.0",
                    "Thermal erosion: what is steeper than the talus angle slides down")
