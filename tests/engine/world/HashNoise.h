// The simplest generator there is, for the tests of layers and worlds: every sample of every map is a random
// number of its own. Rougher than any real plugin, so what holds for it holds for them.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>

#include "teren/Generator.h"
#include "teren/Hash.h"

namespace teren {

class HashNoise final : public Generator {
 public:
  static std::span<const Parameter> parameters() noexcept {
    static constexpr std::array table = {
        Parameter::real("mean", 0.0, -1e6, 1e6, "m", "mean height"),
        Parameter::real("deviation", 1.0, 0.0, 1e6, "m", "standard deviation")};
    return table;
  }

  HashNoise(double mean, double deviation) : mean_(mean), deviation_(deviation) {}
  explicit HashNoise(const Values& values) : HashNoise(values.real("mean"), values.real("deviation")) {}

  HeightRange range() const override {
    // A float's rounding may lead a little beyond the ends.
    const double reach = 1.74 * deviation_ + 1e-6 * std::fabs(mean_);
    return {mean_, deviation_, mean_ - reach, mean_ + reach};
  }
  double residual(int level, int, double) const override { return level == 0 ? 0.0 : 2.0 * deviation_; }
  std::unique_ptr<GenerationTask> begin(const MapRequest& request, HeightView out) const override {
    return std::make_unique<Task>(mean_, deviation_, request, out);
  }

 private:
  class Task final : public GenerationTask {
   public:
    Task(double mean, double deviation, const MapRequest& request, HeightView out)
        : mean_(mean), deviation_(deviation), request_(request), out_(out) {}
    bool step(const Slice& slice) override {
      while (row_ < out_.rows()) {
        for (int x = 0; x < out_.columns(); ++x) out_(x, row_) = sample(finest(x), finest(row_));
        ++row_;
        if (slice.over()) break;
      }
      return row_ == out_.rows();
    }

   private:
    /// Uniform, so that sqrt(3) deviations are its reach.
    float sample(int x, int y) const {
      const std::uint64_t hash =
          hashWith(hashWith(request_.seed, static_cast<std::uint64_t>(x)), static_cast<std::uint64_t>(y));
      const double uniform = std::ldexp(static_cast<double>(hash >> 11), -52) - 1.0;  // [-1, 1)
      return static_cast<float>(mean_ + deviation_ * 1.7320508075688772 * uniform);
    }
    int finest(int sample) const {
      return request_.samples == 1 ? request_.finestIntervals / 2 : sample << request_.level;
    }
    const double mean_, deviation_;
    const MapRequest request_;
    HeightView out_;
    int row_ = 0;
  };

  double mean_, deviation_;
};

}  // namespace teren
