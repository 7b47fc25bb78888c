#include <chrono>

#include "teren/Hash.h"

#include "apps/check/Counterexample.h"
#include "apps/check/MapComparison.h"
#include "apps/check/MapMaker.h"
#include "apps/check/Properties.h"
#include "apps/check/Subject.h"

namespace teren::check {
namespace {

using std::chrono::microseconds;

/// Against what the map is when made in one step.
void compare(const MapMaker& maker, const MapRequest& request, const HeightMap& whole,
             const HeightMap& sliced, const std::string& slices) {
  const std::string differs = difference(whole.view(), "made in one step", sliced.view(), "in " + slices);
  if (!differs.empty()) throw Counterexample{maker.place(request) + ": " + differs};
}

class Slicing final : public Property {
 public:
  std::string_view name() const noexcept override { return "slicing"; }
  std::string_view demand() const noexcept override {
    return "A map has the same bits whether it is made in one step or in slices of any length.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    std::int64_t steps = 0;
    for (const Setting& setting : subject.settings()) {
      const MapMaker maker = subject.maker(setting);
      for (const int samples : {3, 33}) tryAll(maker, requestOf(1, samples), steps);
      tryAll(maker, requestOf(1, 33, 7), steps);
    }
    const MapMaker maker = subject.maker({});
    tryAll(maker, requestOf(2, 257), steps);
    tryRandom(maker, requestOf(2, 257));
    return std::to_string(subject.settings().size()) + " settings, " + std::to_string(steps) + " steps";
  }

 private:
  static void tryAll(const MapMaker& maker, const MapRequest& request, std::int64_t& steps) {
    const HeightMap whole = maker.make(request);
    std::int64_t taken = 0;
    compare(maker, request, whole, maker.make(request, shortestSlice(), &taken),
            "slices that are over from the start");
    steps += taken;
    HeightMap map(request.samples, request.samples);
    maker.prepare(request, map.view());
    const auto task = maker.begin(request, map.view());
    while (!task->step(Slice::lasting(microseconds(20)))) ++steps;
    compare(maker, request, whole, map, "slices of 20 us");
  }

  static void tryRandom(const MapMaker& maker, const MapRequest& request) {
    RandomSequence random(2);
    HeightMap map(request.samples, request.samples);
    maker.prepare(request, map.view());
    const auto task = maker.begin(request, map.view());
    while (!task->step(Slice::lasting(microseconds(random.nextBits(6))))) {
    }
    compare(maker, request, maker.make(request), map, "slices of 0 to 63 us");
  }
};

}  // namespace

PropertyPointer makeSlicing() {
  return std::make_unique<Slicing>();
}

}  // namespace teren::check
