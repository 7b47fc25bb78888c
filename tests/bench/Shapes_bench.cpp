// Circles beside their plain version, at four sides; linked into bench-generators.
#include <benchmark/benchmark.h>

#include "teren/HeightMap.h"

#include "generators/circles/Circles.h"
#include "generators/circles/CirclesReference.h"

namespace teren {

// generators/circles/CirclesReference.cpp, compiled under another name (tests/bench/CMakeLists.txt).
void circlesReferenceAvx2(const Circles& circles, const MapRequest& request, HeightView out);

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

}  // namespace
}  // namespace teren
