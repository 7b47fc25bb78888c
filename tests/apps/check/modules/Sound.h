// What the modules of the checker's tests have in common: a generator that keeps its contract. Each broken
// module then breaks one property of it.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "teren/Hash.h"
#include "teren/Plugin.h"
#include "teren/RowTask.h"

namespace sound {

/// Uniform in [-1, 1).
inline double number(std::uint64_t seed, std::int64_t x, std::int64_t y) {
  const std::uint64_t hash =
      teren::hashWith(teren::hashWith(seed, static_cast<std::uint64_t>(x)), static_cast<std::uint64_t>(y));
  return static_cast<double>(static_cast<std::int64_t>(hash)) * 0x1p-63;
}

/// Of the finest map.
inline int finest(const teren::MapRequest& request, int sample) {
  return request.samples == 1 ? request.finestIntervals / 2 : sample << request.level;
}

/// Every sample is a random number of its own.
class Noise : public teren::Generator {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    static constexpr teren::Parameter table[] = {
        teren::Parameter::real("deviation", 1.0, 0.5, 2.0, "m", "Standard deviation of the heights")};
    return table;
  }
  explicit Noise(const teren::Values& values) : deviation_(values.real("deviation")) {}

  teren::HeightRange range() const override { return {0.0, deviation_, -largest(), largest()}; }
  double residual(int level, int, double) const override {
    const int stride = 1 << level;
    double sum = 0.0;
    for (int y = 0; y < stride; ++y) {
      for (int x = 0; x < stride; ++x) {
        if (x == 0 && y == 0) continue;
        const double u = static_cast<double>(x) / stride, v = static_cast<double>(y) / stride;
        const double low = std::fmin(u, v), high = std::fmax(u, v);
        sum += 1.0 + (1.0 - high) * (1.0 - high) + (high - low) * (high - low) + low * low;
      }
    }
    return deviation_ * std::sqrt(sum) / stride;
  }
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    return rows(request, out, [](float height) { return height; });
  }

 protected:
  double deviation() const { return deviation_; }
  /// A float's rounding may lead a little beyond it.
  double largest() const { return 1.74 * deviation_; }
  float height(const teren::MapRequest& request, int column, int row) const {
    return static_cast<float>(deviation_ * 1.7320508075688772 *
                              number(request.seed, finest(request, column), finest(request, row)));
  }
  /// A sound map, each height of which is changed.
  template <class Change>
  std::unique_ptr<teren::GenerationTask> rows(const teren::MapRequest& request, teren::HeightView out,
                                              Change change) const {
    return teren::makeRowTask(out, [this, request, out, change = std::move(change)](int row) mutable {
      for (int column = 0; column < out.columns(); ++column)
        out(column, row) = change(height(request, column, row));
    });
  }

 private:
  double deviation_;
};

}  // namespace sound

#define SOUND_PLUGIN(Class, id) TEREN_GENERATOR_PLUGIN(Class, id, "1.0", "A generator of the checker's tests")
