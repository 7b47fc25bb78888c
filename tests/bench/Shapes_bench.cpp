// Circles and thermal erosion beside their plain versions, and terraces, at four sides; linked into
// bench-generators.
#include <benchmark/benchmark.h>

#include "teren/HeightMap.h"

#include "generators/circles/Circles.h"
#include "generators/circles/CirclesReference.h"
#include "generators/fault/FaultFormation.h"
#include "generators/filter/ThermalFilter.h"
#include "generators/filter/ThermalReference.h"
#include "generators/steps/Staircase.h"

namespace teren {

// generators/circles/CirclesReference.cpp, compiled under another name (tests/bench/CMakeLists.txt).
void circlesReferenceAvx2(const Circles& circles, const MapRequest& request, HeightView out);
// generators/filter/ThermalReference.cpp, likewise.
void thermalReferenceO2(const ThermalFilter& filter, double spacing, HeightView inOut);
void thermalReferenceAvx2(const ThermalFilter& filter, double spacing, HeightView inOut);

namespace {

void circlesFast(const Circles& circles, const MapRequest& request, HeightView out) {
  circles.begin(request, out)->step(Slice::unlimited());
}

template <auto make, bool avx2 = false>
void circles(benchmark::State& state) {
  if (avx2 && !__builtin_cpu_supports("avx2")) return state.SkipWithError("this processor has no AVX2");
  const auto samples = static_cast<int>(state.range(0));
  const Circles circles(1000, 4.0, 0.5, 0.1);
  HeightMap map(samples, samples);
  MapRequest request{.samples = samples};
  for (auto _ : state) {
    ++request.seed;
    make(circles, request, map.view());
    benchmark::DoNotOptimize(map.view().data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * samples * samples);
}

BENCHMARK(circles<circlesFast>)->Name("circles/fast")->Arg(65)->Arg(129)->Arg(257)->Arg(1025);
BENCHMARK(circles<circlesReference>)->Name("circles/plain")->Arg(65)->Arg(129)->Arg(257);
BENCHMARK(circles<circlesReferenceAvx2, true>)->Name("circles/plain-avx2")->Arg(65)->Arg(129)->Arg(257);

void steps(benchmark::State& state) {
  const auto samples = static_cast<int>(state.range(0));
  HeightMap map(samples, samples);
  MapRequest request{.samples = samples};
  for (auto _ : state) {
    ++request.seed;
    Staircase(2.0, 3, 12).begin(request, map.view())->step(Slice::unlimited());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * samples * samples);
}

BENCHMARK(steps)->Name("steps/fast")->Arg(65)->Arg(129)->Arg(257)->Arg(1025);

void thermalFast(const ThermalFilter& filter, double spacing, HeightView inOut) {
  filter.begin(spacing, inOut)->step(Slice::unlimited());
}

/// One sweep over steep ground, the same each time.
template <auto sweep, bool avx2 = false>
void thermal(benchmark::State& state) {
  if (avx2 && !__builtin_cpu_supports("avx2")) return state.SkipWithError("this processor has no AVX2");
  const auto samples = static_cast<int>(state.range(0));
  const ThermalFilter filter(33.0, 1);
  HeightMap source(samples, samples);
  FaultFormation(150, 40.0).begin({.samples = samples}, source.view())->step(Slice::unlimited());
  HeightMap map = source;
  for (auto _ : state) {
    state.PauseTiming();
    map = source;
    state.ResumeTiming();
    sweep(filter, 128.0 / (samples - 1), map.view());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * samples * samples);
}

BENCHMARK(thermal<thermalFast>)->Name("thermal/fast")->Arg(65)->Arg(129)->Arg(257)->Arg(1025);
BENCHMARK(thermal<thermalReferenceO2>)->Name("thermal/plain-o2")->Arg(65)->Arg(129)->Arg(257)->Arg(1025);
BENCHMARK(thermal<thermalReferenceAvx2, true>)
    ->Name("thermal/plain-avx2")
    ->Arg(65)
    ->Arg(129)
    ->Arg(257)
    ->Arg(1025);

}  // namespace
}  // namespace teren
