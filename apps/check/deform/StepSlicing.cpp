#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "teren/Hash.h"

#include "apps/check/Counterexample.h"
#include "apps/check/MapComparison.h"
#include "apps/check/Properties.h"
#include "apps/check/deform/DeformTrial.h"

namespace teren::check {
namespace {

using Advance = std::function<void(WatchedSurface&, std::uint64_t)>;

/// Where a program has led: the heights after each stamp's steps, how many those were, and the words.
struct Outcome {
  std::vector<HeightMap> heights;
  std::vector<std::uint64_t> steps;
  std::vector<std::string> past;
};

void inOneStep(WatchedSurface& surface, std::uint64_t upTo) {
  surface.advance(Slice::unlimited(), upTo);
}

void inShortestSlices(WatchedSurface& surface, std::uint64_t upTo) {
  surface.advance(shortestSlice(), upTo);
}

void oneByOne(WatchedSurface& surface, std::uint64_t upTo) {
  while (!surface.atRest() && surface.steps() < upTo) {
    surface.advance(shortestSlice(), surface.steps() + 1);
  }
}

void atRandom(WatchedSurface& surface, std::uint64_t upTo) {
  RandomSequence random(3);
  while (!surface.step(Slice::lasting(std::chrono::microseconds(random.nextBits(4))), upTo)) {
  }
}

void note(Outcome& outcome, WatchedSurface& surface) {
  outcome.heights.push_back(surface.heights());
  outcome.steps.push_back(surface.steps());
  outcome.past.push_back(surface.past());
}

/// Stamp n is followed by 2 n steps, the last one by rest.
Outcome run(const DeformTrial& trial, const DeformTask& task, const HeightMap& ground,
            const Advance& advance) {
  WatchedSurface surface(trial, task.region, ground.view());
  Outcome outcome;
  for (std::size_t n = 0; n < task.stamps.size(); ++n) {
    surface.apply(task.stamps[n]);
    advance(surface, surface.steps() + 2 * n);
    note(outcome, surface);
  }
  advance(surface, kToRest);
  note(outcome, surface);
  return outcome;
}

/// Stamps after so many slices that are over from the start, and after how many steps they then came.
std::pair<Outcome, std::vector<std::uint64_t>> interrupted(const DeformTrial& trial, const DeformTask& task,
                                                           const HeightMap& ground, int slices) {
  WatchedSurface surface(trial, task.region, ground.view());
  std::vector<std::uint64_t> steps;
  for (const TriedStamp& tried : task.stamps) {
    surface.apply(tried);
    steps.push_back(surface.steps());
    for (int slice = 0; slice < slices; ++slice) surface.step(shortestSlice(), kToRest);
  }
  surface.advance(Slice::unlimited(), kToRest);
  Outcome outcome;
  note(outcome, surface);
  return {std::move(outcome), std::move(steps)};
}

/// The same stamps after whole steps, as a journal would replay them.
Outcome replayed(const DeformTrial& trial, const DeformTask& task, const HeightMap& ground,
                 const std::vector<std::uint64_t>& steps) {
  WatchedSurface surface(trial, task.region, ground.view());
  for (std::size_t n = 0; n < task.stamps.size(); ++n) {
    surface.advance(Slice::unlimited(), steps[n]);
    surface.apply(task.stamps[n]);
  }
  surface.advance(Slice::unlimited(), kToRest);
  Outcome outcome;
  note(outcome, surface);
  return outcome;
}

void compare(const Outcome& whole, const Outcome& sliced, const std::string& slices) {
  for (std::size_t n = 0; n < whole.heights.size(); ++n) {
    if (whole.steps[n] != sliced.steps[n]) {
      throw Counterexample{whole.past[n] + ": it is at step " + std::to_string(whole.steps[n]) +
                           " in one step but at " + std::to_string(sliced.steps[n]) + " " + slices};
    }
    expectSame(whole.heights[n].view(), "in one step", sliced.heights[n].view(), slices, whole.past[n]);
  }
}

class StepSlicing final : public Property {
 public:
  std::string_view name() const noexcept override { return "slicing"; }
  std::string_view demand() const noexcept override {
    return "What becomes of the ground depends on the stamps and after how many steps each came, not on how "
           "the steps were sliced or asked for; a stamp in the middle of a step comes after it.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    const DeformTrial trial(subject);
    int programs = 0;
    for (const DeformTask& task : trial.tasks()) {
      const HeightMap ground = DeformTrial::hills(task.region);
      const Outcome whole = run(trial, task, ground, inOneStep);
      compare(whole, run(trial, task, ground, inShortestSlices), "in slices that are over from the start");
      compare(whole, run(trial, task, ground, oneByOne), "asked for step by step");
      compare(whole, run(trial, task, ground, atRandom), "in slices of 0 to 15 us");
      programs += 3;
      for (int slices = 1; slices <= 24; slices = 2 * slices + 1, ++programs) {
        const auto [within, steps] = interrupted(trial, task, ground, slices);
        compare(replayed(trial, task, ground, steps), within,
                "with stamps after " + std::to_string(slices) + " slices each, in the middle of steps");
      }
    }
    return std::to_string(programs) + " programs of stamps and steps, each also in one step";
  }
};

}  // namespace

PropertyPointer makeStepSlicing() {
  return std::make_unique<StepSlicing>();
}

}  // namespace teren::check
