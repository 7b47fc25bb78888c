#include <algorithm>
#include <chrono>
#include <vector>

#include "teren/ProcessorTime.h"

#include "apps/check/Allowance.h"
#include "apps/check/Counterexample.h"
#include "apps/check/MapMaker.h"
#include "apps/check/Properties.h"
#include "apps/check/SliceTimes.h"
#include "apps/check/Subject.h"

namespace teren::check {
namespace {

using std::chrono::microseconds;
using std::chrono::nanoseconds;

constexpr int kSamples = 257;
/// Maps that are made in a few slices are not worth the waiting.
constexpr int kMostMaps = 100, kFewestMaps = 8;

/// Steps a map as the engine does: the first slice includes `begin`.
void measure(const MapMaker& maker, const MapRequest& request, HeightView map,
             std::vector<nanoseconds>& times) {
  maker.prepare(request, map);
  std::unique_ptr<SlicedTask> task;
  for (bool done = false; !done && times.size() < 8 * kEnoughSlices;) {
    const nanoseconds start = threadProcessorTime();
    const Slice slice = Slice::lasting(kAskedSlice);
    if (task == nullptr) task = maker.begin(request, map);
    done = task->step(slice);
    times.push_back(threadProcessorTime() - start);
  }
}

class SliceLength final : public Property {
 public:
  std::string_view name() const noexcept override { return "slice-length"; }
  std::string_view demand() const noexcept override {
    return "Of slices asked for 100 us, 99 % use less than 200 us of processor time, those that begin a map "
           "included.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort& effort) const override {
    nanoseconds worst(0);
    for (const Setting& setting : subject.settings()) {
      const MapMaker maker = subject.maker(setting);
      nanoseconds best = nanoseconds::max();
      std::size_t slices = 0;
      for (int attempt = 0; attempt < kSliceAttempts && best >= kLongestSlice; ++attempt) {
        std::vector<nanoseconds> times = timesOf(maker, effort);
        slices = times.size();
        best = std::min(best, percentile99(times));
      }
      if (best >= kLongestSlice) {
        throw Counterexample{maker.place(requestOf(0, kSamples)) + ": 1 % of " + std::to_string(slices) +
                             " slices asked for " + microsecondsText(kAskedSlice) + " used " +
                             microsecondsText(best) + " or more"};
      }
      worst = std::max(worst, best);
    }
    return "99 % below " + microsecondsText(worst + microseconds(1)) + " with every setting";
  }

 private:
  static std::vector<nanoseconds> timesOf(const MapMaker& maker, const Effort& effort) {
    HeightMap map(kSamples, kSamples);
    std::vector<nanoseconds> times;
    times.reserve(8 * kEnoughSlices);
    const Allowance allowance(effort.perSetting);
    const auto wanted = [&](int maps) {
      if (times.size() >= kEnoughSlices || maps >= kMostMaps) return false;
      return allowance.left() || (times.size() < kFewestSlices && maps < kFewestMaps);
    };
    for (int maps = 0; wanted(maps); ++maps) measure(maker, requestOf(maps, kSamples), map.view(), times);
    return times;
  }
};

}  // namespace

PropertyPointer makeSliceLength() {
  return std::make_unique<SliceLength>();
}

}  // namespace teren::check
