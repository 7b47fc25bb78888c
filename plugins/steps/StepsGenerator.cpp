// The plugin "steps": terraces (generators/steps).
#include "teren/Plugin.h"

#include "generators/steps/Staircase.h"

namespace {

class StepsGenerator final : public teren::Generator {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    using teren::Parameter;
    static constexpr Parameter table[] = {
        Parameter::real("rise", 2.0, 0.0, 1e5, "m", "Height of one step"),
        Parameter::integer("steps", 3, 1, teren::Staircase::kMaxSteps, "",
                           "Steps from the lowest terrace to the highest"),
        Parameter::integer("terraces", 12, 1, teren::Staircase::kMaxTerraces, "",
                           "Terraces across a base map, which is two pitches wide"),
    };
    return table;
  }

  explicit StepsGenerator(const teren::Values& values)
      : staircase_(values.real("rise"), static_cast<int>(values.integer("steps")),
                   static_cast<int>(values.integer("terraces"))) {}

  teren::HeightRange range() const override { return staircase_.range(); }
  double residual(int level, int samples, double) const override {
    return staircase_.residual(level, samples);
  }
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    return staircase_.begin(request, out);
  }

 private:
  teren::Staircase staircase_;
};

}  // namespace

TEREN_GENERATOR_PLUGIN(StepsGenerator, "steps", "1.0", "Terraces that climb eastwards and go down again")
