#include "apps/check/Counterexample.h"
#include "apps/check/MapComparison.h"
#include "apps/check/MapMaker.h"
#include "apps/check/Properties.h"
#include "apps/check/Subject.h"
#include "apps/check/ThreadWork.h"

namespace teren::check {
namespace {

class Threads final : public Property {
 public:
  std::string_view name() const noexcept override { return "threads"; }
  std::string_view demand() const noexcept override {
    return "A task may be begun, stepped and ended by different threads, one after the other.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    int maps = 0;
    for (const Setting& setting : subject.settings()) {
      const MapMaker maker = subject.maker(setting);
      for (const int samples : {9, 33}) {
        handOver(maker, requestOf(1, samples));
        ++maps;
      }
    }
    return std::to_string(maps) + " maps, handed over twice each";
  }

 private:
  static void handOver(const MapMaker& maker, const MapRequest& request) {
    HeightMap map(request.samples, request.samples);
    maker.prepare(request, map.view());
    std::unique_ptr<SlicedTask> task;
    bool done = false;
    runElsewhere([&] { task = maker.begin(request, map.view()); });
    runElsewhere([&] {
      for (int step = 0; step < 3 && !done; ++step) done = task->step(shortestSlice());
    });
    runElsewhere([&] {
      while (!done) done = task->step(shortestSlice());
    });
    task.reset();
    const HeightMap alone = maker.make(request, shortestSlice());
    const std::string differs = difference(alone.view(), "made by one thread", map.view(),
                                           "begun by one thread and stepped by others");
    if (!differs.empty()) throw Counterexample{maker.place(request) + ": " + differs};
  }
};

}  // namespace

PropertyPointer makeThreads() {
  return std::make_unique<Threads>();
}

}  // namespace teren::check
