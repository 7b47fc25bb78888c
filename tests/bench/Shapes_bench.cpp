// Circles and thermal erosion beside their plain versions, and the small generators beside what bounds them,
// at four sides; linked into bench-generators.
#include <algorithm>
#include <cstddef>

#include <benchmark/benchmark.h>

#include "teren/HeightMap.h"
#include "teren/PluginRegistry.h"

#include "generators/circles/Circles.h"
#include "generators/circles/CirclesReference.h"
#include "generators/fault/FaultFormation.h"
#include "generators/filter/ThermalFilter.h"
#include "generators/filter/ThermalReference.h"

namespace teren {

// generators/circles/CirclesReference.cpp, compiled under another name (tests/bench/CMakeLists.txt).
void circlesReferenceAvx2(const Circles& circles, const MapRequest& request, HeightView out);
// generators/filter/ThermalReference.cpp, likewise.
void thermalReferenceO2(const ThermalFilter& filter, double spacing, HeightView inOut);
void thermalReferenceAvx2(const ThermalFilter& filter, double spacing, HeightView inOut);

namespace {

void allSides(benchmark::internal::Benchmark* benchmark) {
  for (const int side : {65, 129, 257, 1025}) benchmark->Arg(side);
  benchmark->Unit(benchmark::kMicrosecond);
}

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
}

BENCHMARK(circles<circlesFast>)->Name("circles/fast")->Apply(allSides);
BENCHMARK(circles<circlesReference>)->Name("circles/plain")->Apply(allSides);
BENCHMARK(circles<circlesReferenceAvx2, true>)->Name("circles/plain-avx2")->Apply(allSides);

/// A generator that is a plugin and little else, with its defaults.
void small(benchmark::State& state, const char* id) {
  const auto samples = static_cast<int>(state.range(0));
  const auto generator = PluginRegistry::standard()->makeGenerator(id, {});
  if (!generator) return state.SkipWithError(generator.error().message.c_str());
  HeightMap map(samples, samples);
  MapRequest request{.samples = samples};
  for (auto _ : state) {
    ++request.seed;
    (*generator)->begin(request, map.view())->step(Slice::unlimited());
    benchmark::ClobberMemory();
  }
}

/// What bounds them: writing a map.
void fill(benchmark::State& state) {
  const auto samples = static_cast<int>(state.range(0));
  HeightMap map(samples, samples);
  float height = 0.0f;
  for (auto _ : state) {
    height += 1.0f;
    std::fill_n(map.view().data(), static_cast<std::size_t>(samples) * static_cast<std::size_t>(samples),
                height);
    benchmark::ClobberMemory();
  }
}

BENCHMARK_CAPTURE(small, constant, "constant")->Name("constant/fast")->Apply(allSides);
BENCHMARK(fill)->Name("constant/plain")->Apply(allSides);
BENCHMARK_CAPTURE(small, slope, "slope")->Name("slope/fast")->Apply(allSides);
BENCHMARK(fill)->Name("slope/plain")->Apply(allSides);
BENCHMARK_CAPTURE(small, steps, "steps")->Name("steps/fast")->Apply(allSides);
BENCHMARK(fill)->Name("steps/plain")->Apply(allSides);

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
}

BENCHMARK(thermal<thermalFast>)->Name("thermal/fast")->Apply(allSides);
BENCHMARK(thermal<thermalReferenceO2>)->Name("thermal/plain")->Apply(allSides);
BENCHMARK(thermal<thermalReferenceAvx2, true>)->Name("thermal/plain-avx2")->Apply(allSides);

}  // namespace
}  // namespace teren
