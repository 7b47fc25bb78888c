// Noise that is the same at every lattice point, so that the landscape repeats itself with the pitch: what
// differs between two periods is the arithmetic's.
#include "teren/Plugin.h"

#include "tests/engine/world/HashNoise.h"

namespace {

class SameNoise final : public teren::Generator {
 public:
  static std::span<const teren::Parameter> parameters() noexcept { return teren::HashNoise::parameters(); }
  explicit SameNoise(const teren::Values& values) : noise_(values) {}

  teren::HeightRange range() const override { return noise_.range(); }
  double residual(int level, int samples, double spacing) const override {
    return noise_.residual(level, samples, spacing);
  }
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    teren::MapRequest same = request;
    same.seed = 1;
    return noise_.begin(same, out);
  }

 private:
  teren::HashNoise noise_;
};

}  // namespace

TEREN_GENERATOR_PLUGIN(SameNoise, "same", "1.0", "a random number a sample, the same at every lattice point")
