#include <cmath>
#include <string>
#include <vector>

#include "teren/Parameter.h"

#include "apps/check/Called.h"
#include "apps/check/Counterexample.h"
#include "apps/check/MapMaker.h"
#include "apps/check/Properties.h"
#include "apps/check/deform/DeformTrial.h"

namespace teren::check {
namespace {

class Heights final : public Property {
 public:
  std::string_view name() const noexcept override { return "heights"; }
  std::string_view demand() const noexcept override {
    return "A height asked for at a sample is that sample's, any rectangle of samples is part of all of "
           "them, and every height is finite, on the roughest ground as well.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    const DeformTrial trial(subject);
    std::int64_t heights = 0;
    for (const DeformTask& task : trial.tasks()) {
      for (const HeightMap& ground : {DeformTrial::hills(task.region), DeformTrial::rubble(task.region)}) {
        WatchedSurface surface(trial, task.region, ground.view());
        heights += look(surface, task.region);
        for (const TriedStamp& tried : task.stamps) surface.apply(tried);
        surface.step(Slice::unlimited(), surface.steps() + 3);
        heights += look(surface, task.region);
        surface.advance(Slice::unlimited(), kToRest);
        heights += look(surface, task.region);
      }
    }
    return std::to_string(heights) + " heights";
  }

 private:
  static std::int64_t look(WatchedSurface& surface, const DeformRegion& region) {
    const auto snapshot = surface.snapshot();
    const HeightMap samples = heightsOf(*snapshot, region);
    const auto where = [&] { return surface.past(); };
    called(where, [&] {
      for (int y = 0; y < samples.rows(); ++y) {
        for (int x = 0; x < samples.columns(); ++x) lookAt(surface, *snapshot, region, samples, x, y);
      }
      lookAtParts(surface, *snapshot, samples);
    });
    return static_cast<std::int64_t>(samples.samples().size());
  }

  static void lookAt(WatchedSurface& surface, const DeformedGround& snapshot, const DeformRegion& region,
                     const HeightMap& samples, int x, int y) {
    const std::string sample = "sample (" + std::to_string(x) + ", " + std::to_string(y) + ") ";
    if (!std::isfinite(samples(x, y))) {
      throw Counterexample{surface.past() + ": " + sample + "is not finite, or was not written"};
    }
    const double asked = snapshot.height(x * region.spacing, y * region.spacing);
    if (static_cast<float>(asked) != samples(x, y)) {
      throw Counterexample{surface.past() + ": " + sample + "is " + numberText(samples(x, y)) +
                           " m, but the height asked for there is " + numberText(asked) + " m"};
    }
    if (x + 1 == samples.columns() || y + 1 == samples.rows()) return;
    const double between = snapshot.height((x + 0.3125) * region.spacing, (y + 0.8125) * region.spacing);
    if (std::isfinite(between)) return;
    throw Counterexample{surface.past() + ": the height north-east of " + sample + "is not finite"};
  }

  /// Into the middle of a larger map, of which nothing else may change.
  static void lookAtParts(WatchedSurface& surface, const DeformedGround& snapshot, const HeightMap& samples) {
    const int columns = samples.columns(), rows = samples.rows();
    for (const SampleRectangle& part :
         {SampleRectangle{0, 0, 1, 1}, SampleRectangle{columns - 1, rows - 1, 1, 1},
          SampleRectangle{columns / 3, rows / 4, columns / 2, rows / 3},
          SampleRectangle{0, rows / 2, columns, 1}, SampleRectangle{columns / 2, 0, 1, rows}}) {
      HeightMap out(part.columns + 2, part.rows + 2), expected(part.columns + 2, part.rows + 2);
      snapshot.samples(part, out.view().part(1, 1, part.columns, part.rows));
      for (int y = 0; y < part.rows; ++y) {
        for (int x = 0; x < part.columns; ++x)
          expected(x + 1, y + 1) = samples(part.column + x, part.row + y);
      }
      expectSame(expected.view(), "in all samples", out.view(), "in a part of them", surface.past());
    }
  }
};

}  // namespace

PropertyPointer makeHeights() {
  return std::make_unique<Heights>();
}

}  // namespace teren::check
