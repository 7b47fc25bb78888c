// HashNoise as a module, for worlds that are made from a description. It counts the maps it has begun.
#include "tests/engine/world/HashNoise.h"

#include <atomic>

#include "teren/Plugin.h"

namespace {

std::atomic<int> begun = 0;

class Noise final : public teren::Generator {
 public:
  static std::span<const teren::Parameter> parameters() noexcept { return teren::HashNoise::parameters(); }
  explicit Noise(const teren::Values& values) : noise_(values) {}
  teren::HeightRange range() const override { return noise_.range(); }
  double residual(int level, int samples, double spacing) const override {
    return noise_.residual(level, samples, spacing);
  }
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    ++begun;
    return noise_.begin(request, out);
  }

 private:
  teren::HashNoise noise_;
};

}  // namespace

extern "C" __attribute__((visibility("default"))) int terenTestMapsBegun() {
  return begun;
}

TEREN_GENERATOR_PLUGIN(Noise, "hash-noise", "1.0", "a random number a sample")
