#include <algorithm>
#include <string>

#include "teren/Quote.h"

#include "apps/check/Counterexample.h"
#include "apps/check/Properties.h"
#include "apps/check/deform/DeformTrial.h"

namespace teren::check {
namespace {

class Stamps final : public Property {
 public:
  std::string_view name() const noexcept override { return "stamps"; }
  std::string_view demand() const noexcept override {
    return "Every parameter is explained and takes its whole range in some stamp; stamps come to rest, stay "
           "there, and change ground.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    for (const Parameter& parameter : subject.info().parameters) {
      if (!parameter.doc.empty()) continue;
      throw Counterexample{"its parameter " + inQuotes(parameter.name) + " has no line of documentation"};
    }
    const DeformTrial trial(subject);
    for (const Setting& setting : subject.candidates()) {
      const Result<DeformTask> task = trial.taskOf(setting);
      if (!task) throw Counterexample{task.error().message};
    }
    std::size_t stamps = 0;
    std::uint64_t most = 0;
    for (const DeformTask& task : trial.tasks()) {
      const HeightMap ground = DeformTrial::hills(task.region);
      WatchedSurface surface(trial, task.region, ground.view());
      expectSame(ground.view(), "in the ground", surface.heights().view(), "in the surface", surface.past());
      if (!surface.atRest() || surface.steps() != 0) {
        throw Counterexample{"a surface does not begin at rest after 0 steps, but at step " +
                             std::to_string(surface.steps())};
      }
      for (const TriedStamp& tried : task.stamps) {
        surface.apply(tried);
        const std::uint64_t before = surface.steps();
        surface.advance(Slice::unlimited(), kToRest);
        most = std::max(most, surface.steps() - before);
        expectStill(surface);
        ++stamps;
      }
    }
    expectEffect(trial);
    return std::to_string(stamps) + " stamps, each at rest after at most " + std::to_string(most) + " steps";
  }

 private:
  static void expectStill(WatchedSurface& surface) {
    const HeightMap before = surface.heights();
    const std::uint64_t steps = surface.steps();
    for (const std::uint64_t upTo : {steps, steps + 1, steps + 1000, kToRest}) {
      if (surface.step(Slice::unlimited(), upTo) && surface.atRest() && surface.steps() == steps) continue;
      throw Counterexample{surface.past() + ": it came to rest after " + std::to_string(steps) +
                           " steps, and asked for " + std::to_string(upTo) + " it goes on to " +
                           std::to_string(surface.steps())};
    }
    expectSame(before.view(), "at rest", surface.heights().view(), "asked to go on", surface.past());
  }

  /// A deformer that never changes anything would keep every other property.
  static void expectEffect(const DeformTrial& trial) {
    const DeformTask task = trial.tasks().front();
    const HeightMap ground = DeformTrial::hills(task.region);
    WatchedSurface surface(trial, task.region, ground.view());
    for (const TriedStamp& tried : task.stamps) surface.apply(tried);
    surface.advance(Slice::unlimited(), kToRest);
    const HeightMap after = surface.heights();
    if (std::ranges::equal(ground.samples(), after.samples())) {
      throw Counterexample{surface.past() + ": no sample has changed"};
    }
  }
};

}  // namespace

PropertyPointer makeStamps() {
  return std::make_unique<Stamps>();
}

}  // namespace teren::check
