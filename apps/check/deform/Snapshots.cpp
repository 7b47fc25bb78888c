#include <memory>
#include <string>
#include <vector>

#include "apps/check/Counterexample.h"
#include "apps/check/MapComparison.h"
#include "apps/check/Properties.h"
#include "apps/check/deform/DeformTrial.h"

namespace teren::check {
namespace {

class Snapshots final : public Property {
 public:
  std::string_view name() const noexcept override { return "snapshots"; }
  std::string_view demand() const noexcept override {
    return "A snapshot stays as it is, whatever becomes of the surface, and also when that is gone.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    const DeformTrial trial(subject);
    std::size_t snapshots = 0;
    for (const DeformTask& task : trial.tasks()) {
      const HeightMap ground = DeformTrial::hills(task.region);
      std::vector<std::shared_ptr<const DeformedGround>> taken;
      std::vector<HeightMap> heights;
      std::string past;
      const auto look = [&](const char* when) {
        for (std::size_t n = 0; n < taken.size(); ++n) {
          expectSame(heights[n].view(), "when it was taken", heightsOf(*taken[n], task.region).view(), when,
                     past + ", snapshot number " + std::to_string(n));
        }
      };
      {
        WatchedSurface surface(trial, task.region, ground.view());
        const auto take = [&] {
          taken.push_back(surface.snapshot());
          heights.push_back(heightsOf(*taken.back(), task.region));
        };
        take();
        for (const TriedStamp& tried : task.stamps) {
          surface.apply(tried);
          take();
          surface.step(shortestSlice(), kToRest);
          take();
          surface.advance(Slice::unlimited(), surface.steps() + 2);
          take();
        }
        surface.advance(Slice::unlimited(), kToRest);
        past = surface.past();
        look("when the surface had gone on");
      }
      look("when the surface was gone");
      snapshots += taken.size();
    }
    return std::to_string(snapshots) + " snapshots";
  }
};

}  // namespace

PropertyPointer makeSnapshots() {
  return std::make_unique<Snapshots>();
}

}  // namespace teren::check
