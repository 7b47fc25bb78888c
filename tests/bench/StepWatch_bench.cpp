// What watching a plugin's steps costs: steps of 20 us and of nothing at all, watched and not.
#include <chrono>
#include <memory>

#include <benchmark/benchmark.h>

#include "teren/Slice.h"

#include "world/StepWatch.h"

namespace teren {
namespace {

/// A step of `state.range(0)` microseconds; 0: the slice is over when it begins.
void step(benchmark::State& state, bool watched) {
  StepWatch watch;
  for (auto _ : state) {
    const Slice slice = Slice::lasting(std::chrono::microseconds(state.range(0)));
    const StepWatch::Start start = watched ? StepWatch::start(slice) : StepWatch::Start();
    while (!slice.over()) {
    }
    if (watched) benchmark::DoNotOptimize(watch.finish(slice, start));
  }
}
BENCHMARK_CAPTURE(step, plain, false)->Arg(0)->Arg(20);
BENCHMARK_CAPTURE(step, watched, true)->Arg(0)->Arg(20);

}  // namespace
}  // namespace teren

BENCHMARK_MAIN();
