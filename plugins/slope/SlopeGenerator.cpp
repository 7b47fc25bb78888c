// The plugin "slope": every base map is a plane through its lattice point, tilted one of four ways. Blended
// smoothly and without preserveVariance, the landscape is gradient noise (Perlin 2002) with these four
// gradients and the pitch as its cell.
#include <cmath>

#include "teren/Hash.h"
#include "teren/Plugin.h"
#include "teren/RowTask.h"

namespace {

class SlopeGenerator final : public teren::Generator {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    using teren::Parameter;
    static constexpr Parameter table[] = {
        Parameter::real("east", 4.0, 0.0, 1e6, "m", "Rise or fall (a coin decides) over one pitch eastwards"),
        Parameter::real("north", 4.0, 0.0, 1e6, "m",
                        "Rise or fall (a coin decides) over one pitch northwards"),
    };
    return table;
  }

  explicit SlopeGenerator(const teren::Values& values)
      : east_(values.real("east")), north_(values.real("north")) {}

  // At (u, v) pitches from the lattice point the height is +-east u +- north v. The coins make the mean 0 at
  // every sample. No plane through a fixed point deviates equally everywhere: here sqrt(east^2 u^2 + north^2
  // v^2), which is 0 in the middle, sqrt 3 times `deviation` in the corners, and in the root mean square over
  // the map's area `deviation`.
  teren::HeightRange range() const override {
    return {.mean = 0.0,
            .deviation = std::sqrt((east_ * east_ + north_ * north_) / 3.0),
            .min = -static_cast<float>(east_ + north_),
            .max = static_cast<float>(east_ + north_)};
  }
  // Triangles through samples of a plane are the plane, but for the rounding to float.
  double residual(int, int, double) const override { return 0.0; }

  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    teren::RandomSequence random(request.seed);
    const double east = random.nextBits(1) == 0 ? east_ : -east_;
    const double north = random.nextBits(1) == 0 ? north_ : -north_;
    // From -1 at the first sample to 1 at the last: exact, for the side is 2^k + 1, so that every level has
    // the bits of the finest. A map of one sample is its middle.
    const int intervals = request.samples - 1;
    const double share = intervals == 0 ? 0.0 : 1.0 / intervals;
    const auto pitches = [=](int sample) { return (2.0 * sample - intervals) * share; };
    return teren::makeRowTask(out, [=](int row) {
      for (int column = 0; column < out.columns(); ++column) {
        out(column, row) = static_cast<float>(east * pitches(column) + north * pitches(row));
      }
    });
  }

 private:
  double east_, north_;
};

}  // namespace

TEREN_GENERATOR_PLUGIN(SlopeGenerator, "slope", "1.0", "Planes through the lattice points, tilted at random")
