#include <vector>

#include "apps/check/Counterexample.h"
#include "apps/check/MapComparison.h"
#include "apps/check/MapMaker.h"
#include "apps/check/Properties.h"
#include "apps/check/Subject.h"
#include "apps/check/ThreadWork.h"

namespace teren::check {
namespace {

constexpr int kThreads = 4;

class Parallel final : public Property {
 public:
  std::string_view name() const noexcept override { return "parallel"; }
  std::string_view demand() const noexcept override {
    return "Any number of threads may make maps with one instance at once, and each map has the same bits.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    int maps = 0;
    for (const Setting& setting : subject.settings()) {
      const bool defaults = setting.empty();
      maps += together(subject.maker(setting), defaults ? 64 : 8, defaults ? 65 : 17);
    }
    return std::to_string(maps) + " maps by " + std::to_string(kThreads) + " threads";
  }

 private:
  /// Two threads make the same map at about the same time.
  static int together(const MapMaker& maker, int count, int samples) {
    std::vector<HeightMap> maps(static_cast<std::size_t>(count));
    std::vector<std::function<void()>> work;
    for (int first = 0; first < kThreads; ++first) {
      work.emplace_back([&maker, &maps, first, count, samples] {
        for (int n = first; n < count; n += kThreads)
          maps[n] = maker.make(requestOf(n / 2, samples), shortestSlice());
      });
    }
    runAtOnce(work);
    for (int n = 0; n < count; ++n) {
      const MapRequest request = requestOf(n / 2, samples);
      const HeightMap alone = maker.make(request, shortestSlice());
      const std::string differs = difference(alone.view(), "made by one thread alone", maps[n].view(),
                                             "while other threads made other maps");
      if (!differs.empty()) throw Counterexample{maker.place(request) + ": " + differs};
    }
    return count;
  }
};

}  // namespace

PropertyPointer makeParallel() {
  return std::make_unique<Parallel>();
}

}  // namespace teren::check
