#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "teren/ProcessorTime.h"

#include "apps/check/Counterexample.h"
#include "apps/check/Properties.h"
#include "apps/check/SliceTimes.h"
#include "apps/check/deform/DeformTrial.h"

namespace teren::check {
namespace {

using std::chrono::nanoseconds;

/// Enough slices come of so many even where each has but one.
constexpr std::size_t kMostSurfaces = kEnoughSlices;

class StepLength final : public Property {
 public:
  std::string_view name() const noexcept override { return "slice-length"; }
  std::string_view demand() const noexcept override {
    return "Of slices asked for 100 us, 99 % use less than 200 us of processor time.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    const DeformTrial trial(subject);
    nanoseconds worst(0);
    for (const DeformTask& task : trial.tasks()) {
      nanoseconds best = nanoseconds::max();
      std::size_t slices = 0;
      for (int attempt = 0; attempt < kSliceAttempts && best >= kLongestSlice; ++attempt) {
        std::vector<nanoseconds> times = timesOf(trial, task);
        slices = times.size();
        best = std::min(best, percentile99(times));
      }
      if (best >= kLongestSlice) {
        throw Counterexample{"with " + task.stamps.back().text + " and others: 1 % of " +
                             std::to_string(slices) + " slices asked for " + microsecondsText(kAskedSlice) +
                             " used " + microsecondsText(best) + " or more"};
      }
      worst = std::max(worst, best);
    }
    return "99 % below " + microsecondsText(worst + std::chrono::microseconds(1)) + " with every setting";
  }

 private:
  /// All stamps at once, to rest, on as many surfaces as it takes.
  static std::vector<nanoseconds> timesOf(const DeformTrial& trial, const DeformTask& task) {
    const HeightMap ground = DeformTrial::hills(task.region);
    std::vector<nanoseconds> times;
    for (std::size_t n = 0; n < kMostSurfaces && times.size() < kEnoughSlices; ++n) {
      WatchedSurface surface(trial, task.region, ground.view());
      for (const TriedStamp& tried : task.stamps) surface.apply(tried);
      for (bool done = false; !done && times.size() < 8 * kEnoughSlices;) {
        const nanoseconds start = threadProcessorTime();
        done = surface.step(Slice::lasting(kAskedSlice), kToRest);
        times.push_back(threadProcessorTime() - start);
      }
    }
    return times;
  }
};

}  // namespace

PropertyPointer makeStepLength() {
  return std::make_unique<StepLength>();
}

}  // namespace teren::check
