#include <algorithm>
#include <cmath>
#include <limits>

#include "teren/Parameter.h"

#include "apps/check/Counterexample.h"
#include "apps/check/MapMaker.h"
#include "apps/check/Properties.h"
#include "apps/check/Subject.h"

namespace teren::check {
namespace {

std::string text(double low, double high) {
  return numberText(low) + " to " + numberText(high) + " m";
}

class Range final : public Property {
 public:
  std::string_view name() const noexcept override { return "range"; }
  std::string_view demand() const noexcept override {
    return "The promised range is finite with the mean inside, and no sample lies outside it.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    std::string figure;
    for (const Setting& setting : subject.settings()) {
      const MapMaker maker = subject.maker(setting);
      const HeightRange range = maker.range();
      checkPromise(maker, range);
      float low = std::numeric_limits<float>::max(), high = -low;
      for (int n = 0; n < 8; ++n) look(maker, requestOf(n, 33), range, low, high);
      for (int level = 1; level <= 5; ++level) look(maker, requestOf(level, 33, level), range, low, high);
      look(maker, requestOf(9, 129), range, low, high);
      if (figure.empty()) figure = text(low, high) + " within " + text(range.min, range.max);
    }
    return figure;
  }

 private:
  static void checkPromise(const MapMaker& maker, const HeightRange& range) {
    const bool finite =
        std::isfinite(range.min) && std::isfinite(range.max) && std::isfinite(range.deviation);
    if (finite && range.min <= range.mean && range.mean <= range.max && range.deviation >= 0.0) return;
    throw Counterexample{"with " + maker.setting() + ": it promises a mean of " + numberText(range.mean) +
                         " m, a deviation of " + numberText(range.deviation) + " m and heights from " +
                         text(range.min, range.max)};
  }

  /// Heights that are not finite are another property's.
  static void look(const MapMaker& maker, const MapRequest& request, const HeightRange& range, float& low,
                   float& high) {
    const HeightMap map = maker.make(request);
    for (int row = 0; row < map.rows(); ++row) {
      for (int column = 0; column < map.columns(); ++column) {
        const float height = map(column, row);
        if (!std::isfinite(height)) continue;
        low = std::min(low, height);
        high = std::max(high, height);
        if (range.min <= height && height <= range.max) continue;
        throw Counterexample{maker.place(request) + ": sample (" + std::to_string(column) + ", " +
                             std::to_string(row) + ") is " + numberText(height) + " m, promised is " +
                             text(range.min, range.max)};
      }
    }
  }
};

}  // namespace

PropertyPointer makeRange() {
  return std::make_unique<Range>();
}

}  // namespace teren::check
