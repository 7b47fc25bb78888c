#include <algorithm>
#include <cmath>

#include "apps/check/Counterexample.h"
#include "apps/check/MapComparison.h"
#include "apps/check/MapMaker.h"
#include "apps/check/Properties.h"
#include "apps/check/Rounded.h"
#include "apps/check/Subject.h"

namespace teren::check {
namespace {

constexpr int kCells = 16, kFiner = 3;  // cells a side, each looked at with 2^3 samples a side
constexpr int kSeeds = 4;

struct Distance {
  double most = 0.0;
  int x = 0, y = 0;  // fine samples
};

class FieldError final : public Property {
 public:
  std::string_view name() const noexcept override { return "field-error"; }
  std::string_view demand() const noexcept override {
    return "A continuous field is nowhere farther from the triangles through its samples than it promises.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    std::string figure;
    for (const Setting& setting : subject.settings()) {
      const MapMaker maker = subject.maker(setting);
      if (maker.continuous() == nullptr) continue;
      for (const double spacing : {0.5, 2.0, 8.0, 64.0}) {
        double most = 0.0;
        for (int seed = 0; seed < kSeeds; ++seed) most = std::max(most, measure(maker, spacing, seed));
        if (setting.empty() && spacing == 2.0) {
          figure = rounded(most) + " m of " + rounded(maker.continuous()->fieldError(spacing)) +
                   " m between samples 2 m apart";
        }
      }
    }
    return figure.empty() ? "no continuous field" : figure;
  }

 private:
  static double measure(const MapMaker& maker, double spacing, int seed) {
    const double promise = maker.continuous()->fieldError(spacing);
    if (!(std::isfinite(promise) && promise >= 0.0)) {
      throw Counterexample{"with " + maker.setting() + ": between samples " + rounded(spacing) +
                           " m apart it promises an error of " + rounded(promise) + " m"};
    }
    FieldRequest fine{.i = 11 * seed, .j = -seed, .seed = static_cast<std::uint64_t>(seed)};
    fine.pitch = kPitch;
    fine.spacing = spacing / (1 << kFiner);
    fine.columns = fine.rows = (kCells << kFiner) + 1;
    const Distance distance = farthest(maker.field(fine));
    const HeightRange range = maker.range();
    const double rounding = 0x1p-22 * std::max(std::fabs(range.min), std::fabs(range.max));
    if (distance.most <= promise + rounding) return distance.most;
    throw Counterexample{maker.place(fine) + ": sample (" + std::to_string(distance.x) + ", " +
                         std::to_string(distance.y) + ") is " + rounded(distance.most) +
                         " m from the triangles through samples " + rounded(spacing) +
                         " m apart, promised is " + rounded(promise) + " m"};
  }

  /// From the triangles through every 2^kFiner-th sample.
  static Distance farthest(const HeightMap& fine) {
    const HeightMap coarse = subsampled(fine, kFiner);
    Distance farthest;
    for (int y = 0; y < fine.rows(); ++y) {
      for (int x = 0; x < fine.columns(); ++x) {
        const double distance = std::fabs(fine(x, y) - drawnHeight(coarse, x, y, kFiner));
        if (distance > farthest.most) farthest = {distance, x, y};
      }
    }
    return farthest;
  }
};

}  // namespace

PropertyPointer makeFieldError() {
  return std::make_unique<FieldError>();
}

}  // namespace teren::check
