#include <algorithm>
#include <string>

#include "apps/check/Counterexample.h"
#include "apps/check/HeapUse.h"
#include "apps/check/MapComparison.h"
#include "apps/check/Properties.h"
#include "apps/check/deform/DeformTrial.h"

namespace teren::check {
namespace {

/// What lies between what is asked of malloc and what it takes, and what is made once and kept.
constexpr std::size_t kFree = 16 * 1024;
/// As many as malloc may need to fill what it keeps for later, which it counts as in use.
constexpr int kRounds = 40;

class Bytes final : public Property {
 public:
  std::string_view name() const noexcept override { return "bytes"; }
  std::string_view demand() const noexcept override {
    return "A surface counts about the bytes that it holds, and when it is gone they are free.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    const DeformTrial trial(subject);
    std::size_t counted = 0;
    for (const DeformTask& task : trial.tasks()) {
      counted = std::max(counted, count(trial, task));
      expectFreed(trial, task);
    }
    return "at most " + std::to_string(counted) + " bytes";
  }

 private:
  /// Both ways within a factor of two: an engine plans its memory by this.
  static std::size_t count(const DeformTrial& trial, const DeformTask& task) {
    const HeightMap ground = DeformTrial::hills(task.region);
    work(trial, task, ground);  // what is made once, and kept, is made here
    const std::size_t before = heapBytes();
    WatchedSurface surface(trial, task.region, ground.view());
    for (const TriedStamp& tried : task.stamps) {
      surface.apply(tried);
      surface.step(shortestSlice(), kToRest);
      const auto snapshot = surface.snapshot();
    }
    const std::size_t held = heapBytes() - before, counted = surface.bytes();
    if (counted > 2 * held + kFree || held > 2 * counted + kFree) {
      throw Counterexample{surface.past() + ": it counts " + std::to_string(counted) + " bytes, but " +
                           std::to_string(held) + " more are in use than before it began"};
    }
    return counted;
  }

  static void expectFreed(const DeformTrial& trial, const DeformTask& task) {
    const HeightMap ground = DeformTrial::hills(task.region);
    std::size_t last = heapBytes();
    const std::size_t before = last;
    for (int round = 0; round < kRounds; ++round) {
      for (int n = 0; n < kSurfaces; ++n) work(trial, task, ground);
      const std::size_t now = heapBytes();
      if (now < last + kSurfaces) return;
      last = now;
    }
    throw Counterexample{"after " + std::to_string(kRounds * kSurfaces) + " surfaces that are gone " +
                         std::to_string(last - before) +
                         " bytes more are in use, and more after each further one"};
  }

  static void work(const DeformTrial& trial, const DeformTask& task, const HeightMap& ground) {
    WatchedSurface surface(trial, task.region, ground.view());
    for (const TriedStamp& tried : task.stamps) surface.apply(tried);
    surface.advance(Slice::unlimited(), surface.steps() + 3);
    surface.snapshot();
  }

  static constexpr int kSurfaces = 8;
};

}  // namespace

PropertyPointer makeBytes() {
  return std::make_unique<Bytes>();
}

}  // namespace teren::check
