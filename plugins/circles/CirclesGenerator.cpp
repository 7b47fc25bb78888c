// The plugin "circles": random discs (generators/circles).
#include "teren/Plugin.h"

#include "generators/circles/Circles.h"

namespace {

class CirclesGenerator final : public teren::Generator {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    using teren::Circles;
    using teren::Parameter;
    static constexpr Parameter table[] = {
        Parameter::integer("discs", 1000, 1, Circles::kMaxDiscs, "",
                           "How many discs; fewer leave flat ground between, more cost proportionally more"),
        Parameter::real("deviation", 4.0, 0.0, 1e6, "m", "Standard deviation of the heights"),
        Parameter::real("radius", 0.5, Circles::kMinRadius, Circles::kMaxRadius, "pitch",
                        "Radius of the largest discs; larger ones make broader hills and cost more"),
        Parameter::real("smallest", 0.1, Circles::kMinSmallest, 1.0, "",
                        "Radius of the smallest discs, in parts of the largest"),
    };
    return table;
  }

  explicit CirclesGenerator(const teren::Values& values)
      : circles_(static_cast<int>(values.integer("discs")), values.real("deviation"), values.real("radius"),
                 values.real("smallest")) {}

  teren::HeightRange range() const override { return circles_.range(); }
  double residual(int level, int samples, double) const override { return circles_.residual(level, samples); }
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    return circles_.begin(request, out);
  }

 private:
  teren::Circles circles_;
};

}  // namespace

TEREN_GENERATOR_PLUGIN(CirclesGenerator, "circles", "1.0", "Round hills and hollows of many sizes")
