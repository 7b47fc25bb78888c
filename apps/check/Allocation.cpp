#include "apps/check/AllocationCount.h"
#include "apps/check/Counterexample.h"
#include "apps/check/MapComparison.h"
#include "apps/check/MapMaker.h"
#include "apps/check/Properties.h"
#include "apps/check/Subject.h"

namespace teren::check {
namespace {

class Allocation final : public Property {
 public:
  std::string_view name() const noexcept override { return "allocation"; }
  std::string_view demand() const noexcept override {
    return "After its first step a task allocates no memory.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    std::int64_t steps = 0;
    for (const Setting& setting : subject.settings()) {
      const MapMaker maker = subject.maker(setting);
      for (const int samples : {9, 65}) steps += watch(maker, requestOf(2, samples));
    }
    return std::to_string(steps) + " steps";
  }

 private:
  static std::int64_t watch(const MapMaker& maker, const MapRequest& request) {
    HeightMap map(request.samples, request.samples);
    maker.prepare(request, map.view());
    const auto task = maker.begin(request, map.view());
    std::int64_t steps = 1;
    for (bool done = task->step(shortestSlice()); !done; ++steps) {
      const long before = allocationCount();
      done = task->step(shortestSlice());
      const long allocations = allocationCount() - before;
      if (allocations == 0) continue;
      throw Counterexample{maker.place(request) + ": step number " + std::to_string(steps + 1) +
                           " allocates " + std::to_string(allocations) +
                           (allocations == 1 ? " time" : " times")};
    }
    return steps;
  }
};

}  // namespace

PropertyPointer makeAllocation() {
  return std::make_unique<Allocation>();
}

}  // namespace teren::check
