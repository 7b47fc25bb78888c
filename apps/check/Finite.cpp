#include <cmath>
#include <limits>

#include "apps/check/Counterexample.h"
#include "apps/check/MapMaker.h"
#include "apps/check/Properties.h"
#include "apps/check/Subject.h"

namespace teren::check {
namespace {

class Finite final : public Property {
 public:
  std::string_view name() const noexcept override { return "finite"; }
  std::string_view demand() const noexcept override {
    return "Every sample is written with a finite height, for every seed and at the ends of the world.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();
    int maps = 0;
    for (const Setting& setting : subject.settings()) {
      const MapMaker maker = subject.maker(setting);
      for (const std::uint64_t seed : {std::uint64_t{0}, ~std::uint64_t{0}, std::uint64_t{1} << 63}) {
        for (const std::int64_t i : {std::int64_t{0}, least, ~least}) {
          for (const int samples : {3, 33}) {
            MapRequest request = requestOf(0, samples);
            request.seed = seed;
            request.i = i;
            request.j = ~i;
            look(maker, request);
            ++maps;
          }
        }
      }
      for (int level = 0; level <= 6; ++level, ++maps) look(maker, requestOf(level, 65, level));
    }
    return std::to_string(maps) + " maps";
  }

 private:
  static std::string text(const MapMaker& maker, float height) {
    if (!std::isnan(height)) return height > 0.0f ? "infinity" : "minus infinity";
    return maker.filters() ? "NaN" : "NaN, as it was before the map was begun";
  }

  static void look(const MapMaker& maker, const MapRequest& request) {
    const HeightMap map = maker.make(request);
    for (int row = 0; row < map.rows(); ++row) {
      for (int column = 0; column < map.columns(); ++column) {
        if (std::isfinite(map(column, row))) continue;
        throw Counterexample{maker.place(request) + ": sample (" + std::to_string(column) + ", " +
                             std::to_string(row) + ") is " + text(maker, map(column, row))};
      }
    }
  }
};

}  // namespace

PropertyPointer makeFinite() {
  return std::make_unique<Finite>();
}

}  // namespace teren::check
