#include <string>

#include "apps/check/Counterexample.h"
#include "apps/check/MapComparison.h"
#include "apps/check/Properties.h"
#include "apps/check/deform/DeformTrial.h"

namespace teren::check {
namespace {

class Changed final : public Property {
 public:
  std::string_view name() const noexcept override { return "changed"; }
  std::string_view demand() const noexcept override {
    return "All samples that differ from the ground lie in the rectangle that a snapshot calls changed, and "
           "that lies inside the collar.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    const DeformTrial trial(subject);
    int snapshots = 0;
    for (const DeformTask& task : trial.tasks()) {
      const HeightMap ground = DeformTrial::hills(task.region);
      WatchedSurface surface(trial, task.region, ground.view());
      snapshots += look(surface, task.region, ground);
      for (const TriedStamp& tried : task.stamps) {
        surface.apply(tried);
        snapshots += look(surface, task.region, ground);
        surface.step(shortestSlice(), kToRest);
        snapshots += look(surface, task.region, ground);
        surface.advance(Slice::unlimited(), surface.steps() + 3);
        snapshots += look(surface, task.region, ground);
      }
    }
    return std::to_string(snapshots) + " snapshots";
  }

 private:
  static int look(WatchedSurface& surface, const DeformRegion& region, const HeightMap& ground) {
    const auto snapshot = surface.snapshot();
    const SampleRectangle changed = snapshot->changed(), changeable = region.changeable();
    const auto text = [&] {
      return std::to_string(changed.columns) + " x " + std::to_string(changed.rows) + " samples from (" +
             std::to_string(changed.column) + ", " + std::to_string(changed.row) + ")";
    };
    const bool inside =
        changed.columns >= 0 && changed.rows >= 0 && changeable.contains(changed.column, changed.row) &&
        changeable.contains(changed.column + changed.columns - 1, changed.row + changed.rows - 1);
    if (!changed.isEmpty() && !inside) {
      throw Counterexample{surface.past() + ": changed are " + text() +
                           ", which are not all inside the collar"};
    }
    const HeightMap after = heightsOf(*snapshot, region);
    for (int y = 0; y < ground.rows(); ++y) {
      for (int x = 0; x < ground.columns(); ++x) {
        if (after(x, y) == ground(x, y) || changed.contains(x, y)) continue;
        throw Counterexample{surface.past() + ": changed are " + text() + ", but sample (" +
                             std::to_string(x) + ", " + std::to_string(y) + ") has changed, too"};
      }
    }
    return 1;
  }
};

}  // namespace

PropertyPointer makeChanged() {
  return std::make_unique<Changed>();
}

}  // namespace teren::check
