// The plugin "fault": fault formation (generators/fault).
#include "teren/Plugin.h"

#include "generators/fault/FaultFormation.h"

namespace {

class FaultGenerator final : public teren::Generator {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    using teren::Parameter;
    static constexpr Parameter table[] = {
        Parameter::integer("faults", 150, 1, teren::FaultFormation::kMaxFaults, "",
                           "How many faults; more make finer ground and cost proportionally more"),
        Parameter::real("deviation", 4.0, 0.0, 1e6, "m", "Standard deviation of the heights"),
    };
    return table;
  }

  explicit FaultGenerator(const teren::Values& values)
      : formation_(static_cast<int>(values.integer("faults")), values.real("deviation")) {}

  teren::HeightRange range() const override { return formation_.range(); }
  double residual(int level, int samples, double) const override {
    return formation_.residual(level, samples);
  }
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    return formation_.begin(request, out);
  }

 private:
  teren::FaultFormation formation_;
};

}  // namespace

TEREN_GENERATOR_PLUGIN(FaultGenerator, "fault", "1.0",
                       "Fault formation: ground cracked along random straight lines")
