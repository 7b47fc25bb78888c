// The plugin "crater": impact craters, and smoothing (generators/crater).
#include "teren/Plugin.h"

#include "generators/crater/CraterSurface.h"

namespace {

class CraterDeformer final : public teren::Deformer {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    using teren::Parameter;
    static constexpr std::string_view kTools[] = {"crater", "smooth"};
    static constexpr Parameter table[] = {
        Parameter::choice(
            "tool", "crater", kTools,
            "crater digs a bowl with a rim and ejecta at once, or with a negative depth heaps up "
            "its mould; smooth blurs the ground over the depth, step by step"),
        Parameter::real("rim", teren::kCraterRim, 0.0, 1.0, "",
                        "crater: height of the rim over the ground before, in parts of the depth"),
        Parameter::real(
            "irregularity", 0.1, 0.0, teren::CraterShape::kMostIrregular, "",
            "crater: how far its outline leaves a circle at most, in parts of the size, by the seed"),
    };
    return table;
  }

  teren::Result<double> reach(const teren::Stamp& stamp, double spacing) const override {
    const teren::Result<teren::CraterTool> tool = teren::CraterSurface::read(stamp, spacing);
    if (!tool) return tool.error();
    return tool->reach;
  }

  teren::Result<std::unique_ptr<teren::LiveSurface>> begin(const teren::DeformRegion& region,
                                                           teren::ConstHeightView ground) const override {
    return std::unique_ptr<teren::LiveSurface>(std::make_unique<teren::CraterSurface>(region, ground));
  }
};

}  // namespace

TEREN_DEFORMER_PLUGIN(CraterDeformer, "crater", "1.1",
                      "Impact craters with rim and ejecta, and smoothing; a small example of a deformer")
