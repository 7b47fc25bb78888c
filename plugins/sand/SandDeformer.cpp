// The plugin "sand": tools pressed into ground that becomes loose where they cut it (generators/sand).
#include "teren/Plugin.h"

#include "generators/sand/SandIsland.h"

namespace {

class SandDeformer final : public teren::Deformer {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    using teren::Parameter;
    static constexpr std::string_view kTools[] = {"round", "square", "rake", "wedge", "ball"};
    static constexpr Parameter table[] = {
        Parameter::choice("tool", "round", kTools,
                          "what is pressed in, depth below the ground in its middle; what it takes is heaped "
                          "up around it. With a negative depth a mound of loose sand is poured instead"),
        Parameter::boolean("push", false, "the tool is pushed along, and heaps up ahead"),
        Parameter::real("direction", 0.0, 0.0, 360.0, "degree",
                        "which way it is pushed and turned, from east by north"),
        Parameter::real("repose", teren::kDryRepose, 20.0, 45.0, "degree",
                        "how steep dry loose material lies; holds from now on for all that moves"),
        Parameter::real("moisture", 0.0, 0.0, 1.0, "",
                        "damp material lies steeper, by up to 15 degrees; holds from now on, too"),
    };
    return table;
  }

  teren::Result<double> reach(const teren::Stamp& stamp, double spacing) const override {
    const teren::Result<teren::SandPress> press = teren::SandIsland::read(stamp, spacing);
    if (!press) return press.error();
    return press->reach;
  }

  teren::Result<std::unique_ptr<teren::LiveSurface>> begin(const teren::DeformRegion& region,
                                                           teren::ConstHeightView ground) const override {
    return teren::SandIsland::begin(region, ground);
  }
};

}  // namespace

TEREN_DEFORMER_PLUGIN(
    SandDeformer, "sand", "1.4",
    "Loose and solid sand on triangles of its own, dug, raked and heaped with tools; slides")
