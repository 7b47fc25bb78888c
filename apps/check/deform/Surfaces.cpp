#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/check/Counterexample.h"
#include "apps/check/MapComparison.h"
#include "apps/check/Properties.h"
#include "apps/check/ThreadWork.h"
#include "apps/check/deform/DeformTrial.h"

namespace teren::check {
namespace {

constexpr int kThreads = 4;

class Surfaces final : public Property {
 public:
  std::string_view name() const noexcept override { return "parallel"; }
  std::string_view demand() const noexcept override {
    return "Any number of threads may work on surfaces of one deformer, one each or one after the other, and "
           "ask snapshots meanwhile; the ground is the same.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    const DeformTrial trial(subject);
    int surfaces = 0;
    for (const DeformTask& task : trial.tasks()) {
      const HeightMap ground = DeformTrial::hills(task.region);
      const HeightMap alone = work(trial, task, ground, false);
      std::vector<HeightMap> made(kThreads);
      std::vector<std::function<void()>> threads;
      for (int n = 0; n < kThreads; ++n) {
        threads.emplace_back([&, n] { made[n] = work(trial, task, ground, n % 2 == 0); });
      }
      runAtOnce(threads);
      for (const HeightMap& map : made) {
        expectSame(alone.view(), "by one thread alone", map.view(), "beside other threads",
                   task.stamps[0].text);
        ++surfaces;
      }
    }
    return std::to_string(surfaces) + " surfaces, " + std::to_string(kThreads) + " at once";
  }

 private:
  /// With `handsOver`, each stamp and its steps are another thread's, while yet another one reads the
  /// snapshot before.
  static HeightMap work(const DeformTrial& trial, const DeformTask& task, const HeightMap& ground,
                        bool handsOver) {
    WatchedSurface surface(trial, task.region, ground.view());
    for (const TriedStamp& tried : task.stamps) {
      const auto press = [&] {
        surface.apply(tried);
        surface.advance(shortestSlice(), surface.steps() + 2);
      };
      if (!handsOver) {
        press();
        continue;
      }
      const auto snapshot = surface.snapshot();
      const HeightMap before = heightsOf(*snapshot, task.region);
      HeightMap meanwhile;
      const std::function<void()> both[] = {press, [&] { meanwhile = heightsOf(*snapshot, task.region); }};
      runAtOnce(both);
      expectSame(before.view(), "before", meanwhile.view(), "while another thread works", tried.text);
    }
    surface.advance(Slice::unlimited(), kToRest);
    return surface.heights();
  }
};

}  // namespace

PropertyPointer makeSurfaces() {
  return std::make_unique<Surfaces>();
}

}  // namespace teren::check
