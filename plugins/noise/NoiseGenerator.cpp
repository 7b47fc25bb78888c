// The plugin "noise": gradient noise in octaves (generators/noise).
#include "teren/Plugin.h"

#include "generators/noise/Noise.h"

namespace {

constexpr std::string_view kKinds[] = {"perlin", "simplex"};
constexpr std::string_view kFractals[] = {"fbm", "ridged", "billow"};

teren::NoiseFractal fractalOf(const teren::Values& values) {
  const std::string& fractal = values.choice("fractal");
  if (fractal == "ridged") return teren::NoiseFractal::ridged;
  return fractal == "billow" ? teren::NoiseFractal::billow : teren::NoiseFractal::fbm;
}

teren::NoiseSettings settingsOf(const teren::Values& values) {
  return {.kind = values.choice("kind") == "simplex" ? teren::NoiseKind::simplex : teren::NoiseKind::perlin,
          .fractal = fractalOf(values),
          .octaves = static_cast<int>(values.integer("octaves")),
          .frequency = values.real("frequency"),
          .lacunarity = values.real("lacunarity"),
          .hurst = values.real("hurst"),
          .deviation = values.real("deviation"),
          .warp = values.real("warp")};
}

class NoiseGenerator final : public teren::ContinuousGenerator {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    using teren::Parameter;
    static constexpr Parameter table[] = {
        Parameter::choice("kind", "perlin", kKinds,
                          "perlin is fastest; simplex has no axes, and finer grain at the same frequency"),
        Parameter::choice("fractal", "fbm", kFractals,
                          "fbm is plain ground, ridged has crests, billow has round hills and creases"),
        Parameter::integer("octaves", 8, 1, teren::kMostNoiseOctaves, "",
                           "How many octaves; more add finer detail and cost proportionally more"),
        Parameter::real("frequency", 0.002, 1e-5, 10.0, "1/m",
                        "Frequency of the first octave; higher makes smaller hills"),
        Parameter::real("lacunarity", 2.0, 1.25, 4.0, "",
                        "Frequency of each octave in parts of the one before"),
        Parameter::real("hurst", 0.9, 0.0, 1.0, "", "Hurst exponent; higher is smoother"),
        Parameter::real("deviation", 20.0, 0.0, 1e6, "m", "Standard deviation of the heights"),
        Parameter::real("warp", 0.0, 0.0, 1e5, "m",
                        "How far places are moved (standard deviation); higher bends ridges and valleys"),
    };
    return table;
  }

  explicit NoiseGenerator(const teren::Values& values) : noise_(settingsOf(values)) {}

  teren::HeightRange range() const override { return noise_.range(); }
  double residual(int level, int samples, double spacing) const override {
    return noise_.residual(level, samples, spacing);
  }
  double fieldError(double spacing) const override { return noise_.fieldError(spacing); }
  std::unique_ptr<teren::GenerationTask> beginField(const teren::FieldRequest& request,
                                                    teren::HeightView out) const override {
    return noise_.begin(request, out);
  }

 private:
  teren::Noise noise_;
};

}  // namespace

TEREN_GENERATOR_PLUGIN(NoiseGenerator, "noise", "1.0",
                       "Gradient noise in octaves: one field over the whole plane, without blending")
