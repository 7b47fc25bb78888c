#include "apps/check/Allowance.h"
#include "apps/check/Counterexample.h"
#include "apps/check/MapComparison.h"
#include "apps/check/MapMaker.h"
#include "apps/check/Properties.h"
#include "apps/check/Subject.h"

namespace teren::check {
namespace {

/// Tasks are given up after every number of steps up to this one, and then at wider and wider distances.
constexpr std::int64_t kEvery = 64;
constexpr std::int64_t kFewest = 16;  // tasks, however slow the plugin is

class Cancellation final : public Property {
 public:
  std::string_view name() const noexcept override { return "cancellation"; }
  std::string_view demand() const noexcept override {
    return "A task may be given up after any step, and neither maps in the making nor later ones change.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort& effort) const override {
    std::int64_t tasks = 0;
    for (const Setting& setting : subject.settings()) {
      for (const int samples : {9, 33}) {
        const MapMaker maker = subject.maker(setting);
        const MapRequest request = requestOf(3, samples);
        std::int64_t steps = 0;
        const HeightMap expected = subject.maker(setting).make(request, shortestSlice(), &steps);
        const Allowance allowance(effort.perSetting);
        for (std::int64_t k = 0; k < steps && (k < kFewest || allowance.left()); k += 1 + k / kEvery, ++tasks)
          giveUp(maker, request, k, expected);
      }
    }
    return std::to_string(tasks) + " tasks given up";
  }

 private:
  static void giveUp(const MapMaker& maker, const MapRequest& request, std::int64_t steps,
                     const HeightMap& expected) {
    HeightMap beside(request.samples, request.samples), givenUp(request.samples, request.samples);
    maker.prepare(request, beside.view());
    const auto other = maker.begin(request, beside.view());
    const bool done = other->step(shortestSlice());
    {
      maker.prepare(request, givenUp.view());
      const auto task = maker.begin(request, givenUp.view());
      for (std::int64_t step = 0; step < steps; ++step) task->step(shortestSlice());
    }
    if (!done) finish(*other, shortestSlice());
    const std::string after = " after a task was given up after " + std::to_string(steps) + " steps";
    compare(maker, request, expected, beside, "completed" + after);
    compare(maker, request, expected, maker.make(request, shortestSlice()), "begun" + after);
  }

  static void compare(const MapMaker& maker, const MapRequest& request, const HeightMap& expected,
                      const HeightMap& map, const std::string& how) {
    const std::string differs = difference(expected.view(), "made before", map.view(), how);
    if (!differs.empty()) throw Counterexample{maker.place(request) + ": " + differs};
  }
};

}  // namespace

PropertyPointer makeCancellation() {
  return std::make_unique<Cancellation>();
}

}  // namespace teren::check
