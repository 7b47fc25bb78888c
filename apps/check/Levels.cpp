#include "apps/check/Counterexample.h"
#include "apps/check/MapComparison.h"
#include "apps/check/MapMaker.h"
#include "apps/check/Properties.h"
#include "apps/check/Subject.h"

namespace teren::check {
namespace {

class Levels final : public Property {
 public:
  std::string_view name() const noexcept override { return "levels"; }
  std::string_view demand() const noexcept override {
    return "A map of level L is every 2^L-th sample of the finest map, bit for bit, down to the centre "
           "alone, "
           "unless the plugin says that it is approximate.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    int maps = 0;
    for (const Setting& setting : subject.settings()) {
      const MapMaker maker = subject.maker(setting);
      if (!maker.exactLevels()) continue;
      for (const int samples : {3, 65}) {
        for (int n = 0; n < 3; ++n) maps += compare(maker, n, samples);
      }
    }
    return maps == 0 ? "approximate" : std::to_string(maps) + " maps";
  }

 private:
  static int compare(const MapMaker& maker, int n, int samples) {
    const HeightMap finest = maker.make(requestOf(n, samples));
    int level = 1;
    for (; (samples - 1) >> (level - 1) > 0; ++level) {
      const MapRequest request = requestOf(n, samples, level);
      const std::string differs = difference(maker.make(request).view(), "at this level",
                                             subsampled(finest, level).view(), "in the finest map");
      if (!differs.empty()) throw Counterexample{maker.place(request) + ": " + differs};
    }
    return level;
  }
};

}  // namespace

PropertyPointer makeLevels() {
  return std::make_unique<Levels>();
}

}  // namespace teren::check
