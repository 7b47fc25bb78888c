// The plugin "spectral": spectral synthesis (generators/spectral).
#include "teren/Plugin.h"

#include "generators/spectral/SpectralSynthesis.h"

namespace {

class SpectralGenerator final : public teren::Generator {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    using teren::Parameter;
    static constexpr std::string_view rules[] = {"isotropic", "published"};
    static constexpr Parameter table[] = {
        Parameter::choice("rule", "isotropic", rules,
                          "isotropic: waves in all directions; published: as first described, with a grain"),
        Parameter::real("hurst", 0.8, 0.0, 1.0, "", "Hurst exponent; larger is smoother"),
        Parameter::real("deviation", 60.0, 0.0, 1e6, "m", "Standard deviation of the heights"),
        Parameter::integer("harmonics", 32, 1, teren::SpectralSynthesis::kMaxHarmonics, "",
                           "How many waves along each axis; more make finer ground"),
        Parameter::real("time", 0.0, -1e6, 1e6, "s", "The moment shown, for clouds and the like"),
        Parameter::real("windEast", 0.0, -1e3, 1e3, "rad/s", "By how much phases advance eastward"),
        Parameter::real("windNorth", 0.0, -1e3, 1e3, "rad/s", "By how much phases advance northward"),
    };
    return table;
  }

  explicit SpectralGenerator(const teren::Values& values)
      : synthesis_(values.choice("rule") == "published" ? teren::SpectralRule::published
                                                        : teren::SpectralRule::isotropic,
                   values.real("hurst"), values.real("deviation"),
                   static_cast<int>(values.integer("harmonics")),
                   {.east = turns(values, "windEast"), .north = turns(values, "windNorth")}) {}

  teren::HeightRange range() const override { return synthesis_.range(); }
  double residual(int level, int samples, double) const override {
    return synthesis_.residual(level, samples);
  }
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    return synthesis_.begin(request, out);
  }

 private:
  static double turns(const teren::Values& values, std::string_view wind) {
    constexpr double kTurnsPerRadian = 0.15915494309189535;
    return values.real("time") * values.real(wind) * kTurnsPerRadian;
  }

  teren::SpectralSynthesis synthesis_;
};

}  // namespace

TEREN_GENERATOR_PLUGIN(SpectralGenerator, "spectral", "1.0",
                       "Spectral synthesis: a sum of random waves that fall by a power law")
