// The plugin "midpoint": midpoint displacement (generators/midpoint).
#include <string_view>

#include "teren/Plugin.h"

#include "generators/midpoint/MidpointDisplacement.h"

namespace {

constexpr std::string_view kRules[] = {"corrected", "published"};
constexpr std::string_view kSources[] = {"randG", "randR", "randN"};

teren::MidpointSource sourceOf(const teren::Values& values, std::string_view name) {
  const std::string& choice = values.choice(name);
  if (choice == "randR") return teren::MidpointSource::randR;
  return choice == "randN" ? teren::MidpointSource::randN : teren::MidpointSource::randG;
}

/// The published matrix has its first row in the north and its first column in the west.
teren::MidpointSettings settingsOf(const teren::Values& values) {
  return {.hurst = values.real("hurst"),
          .deviation = values.real("deviation"),
          .published = values.choice("rule") == "published",
          .corners = {values.real("m31"), values.real("m33"), values.real("m11"), values.real("m13")},
          .centre = sourceOf(values, "m22"),
          .south = sourceOf(values, "m32"),
          .west = sourceOf(values, "m21"),
          .north = sourceOf(values, "m12"),
          .east = sourceOf(values, "m23")};
}

class MidpointGenerator final : public teren::Generator {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    using teren::Parameter;
    static constexpr Parameter table[] = {
        Parameter::real("hurst", 0.8, 0.0, 1.0, "", "Hurst exponent; higher is smoother"),
        Parameter::real("deviation", 4.0, 0.0, 1e6, "m", "Standard deviation of the heights"),
        Parameter::choice("rule", "corrected", kRules,
                          "corrected keeps to hurst and deviation; published is the classical, biased rule"),
        Parameter::real("m11", 1.0, 0.0, 1.0, "", "Weight of a square's north-west corner in its centre"),
        Parameter::choice("m12", "randG", kSources, "Random source of points on northern edges"),
        Parameter::real("m13", 1.0, 0.0, 1.0, "", "Weight of a square's north-east corner in its centre"),
        Parameter::choice("m21", "randG", kSources, "Random source of points on the map's western rim"),
        Parameter::choice("m22", "randG", kSources, "Random source of centres and of the map's corners"),
        Parameter::choice("m23", "randG", kSources, "Random source of points on eastern edges"),
        Parameter::real("m31", 1.0, 0.0, 1.0, "", "Weight of a square's south-west corner in its centre"),
        Parameter::choice("m32", "randG", kSources, "Random source of points on the map's southern rim"),
        Parameter::real("m33", 1.0, 0.0, 1.0, "", "Weight of a square's south-east corner in its centre"),
    };
    return table;
  }

  explicit MidpointGenerator(const teren::Values& values) : displacement_(settingsOf(values)) {}

  teren::HeightRange range() const override { return displacement_.range(); }
  double residual(int level, int samples, double) const override {
    return displacement_.residual(level, samples);
  }
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    return displacement_.begin(request, out);
  }

 private:
  teren::MidpointDisplacement displacement_;
};

}  // namespace

TEREN_GENERATOR_PLUGIN(MidpointGenerator, "midpoint", "1.0",
                       "Midpoint displacement: ground made by halving squares and moving their midpoints")
