// Fault formation against its plain version, compiled once for the scalar unit and once for AVX2, and the
// band and matrix filters and midpoint displacement against their own. Repetitions are interleaved at random;
// the ratios of the medians come last.
#include <cstdio>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "teren/HeightMap.h"

#include "generators/fault/FaultFormation.h"
#include "generators/filter/BandFilter.h"
#include "generators/filter/BandReference.h"
#include "generators/filter/MatrixFilter.h"
#include "generators/filter/MatrixReference.h"
#include "generators/midpoint/MidpointDisplacement.h"
#include "generators/midpoint/MidpointReference.h"
#include "tests/bench/MedianReporter.h"
#include "tests/support/SlicedWork.h"

namespace teren {

// generators/fault/FaultReference.cpp, compiled under two names (tests/bench/CMakeLists.txt).
void faultReferenceScalar(const FaultFormation& formation, const MapRequest& request, HeightView out);
void faultReferenceAvx2(const FaultFormation& formation, const MapRequest& request, HeightView out);

namespace {

constexpr int kSamples = 257;
const FaultFormation kFormation(150, 4.0);
const BandFilter kFilter(0.9, 5);

void faultFast(const FaultFormation& formation, const MapRequest& request, HeightView out) {
  formation.begin(request, out)->step(Slice::unlimited());
}

using MakeFaults = void (*)(const FaultFormation&, const MapRequest&, HeightView);

void faults(benchmark::State& state, MakeFaults make) {
  HeightMap map(kSamples, kSamples);
  MapRequest request{.samples = kSamples};
  for (auto _ : state) {
    ++request.seed;
    make(kFormation, request, map.view());
    benchmark::DoNotOptimize(map.view().data());
    benchmark::ClobberMemory();
  }
}

HeightMap source() {
  HeightMap map(kSamples, kSamples);
  faultFast(kFormation, {.samples = kSamples}, map.view());
  return map;
}

void band(benchmark::State& state, bool fast) {
  HeightMap map = source();
  for (auto _ : state) {
    if (fast) {
      kFilter.begin(map.view())->step(Slice::unlimited());
    } else {
      bandReference(kFilter, map.view());
    }
    benchmark::ClobberMemory();
  }
}

/// Passes over a map with a matrix of so many rows, all ones.
void matrix(benchmark::State& state, int side, bool fast) {
  const auto elements = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  const MatrixFilter filter =
      MatrixFilter::make(FilterMatrix::make(side, std::vector<double>(elements, 1.0)).value(), 1).value();
  HeightMap map = source();
  for (auto _ : state) {
    if (fast) {
      filter.begin(map.view())->step(Slice::unlimited());
    } else {
      matrixReference(filter, map.view());
    }
    benchmark::ClobberMemory();
  }
}

/// Midpoint displacement of maps of as many samples a side as the argument says.
void midpoint(benchmark::State& state, bool fast) {
  const auto samples = static_cast<int>(state.range(0));
  static const MidpointDisplacement displacement{MidpointSettings{}};
  HeightMap map(samples, samples);
  MapRequest request{.samples = samples};
  for (auto _ : state) {
    ++request.seed;
    if (fast) {
      displacement.begin(request, map.view())->step(Slice::unlimited());
    } else {
      midpointReference(displacement, request, map.view());
    }
    benchmark::ClobberMemory();
  }
  const double perSample = 1e-9 * samples * samples;
  state.counters["ns/sample"] = benchmark::Counter(
      perSample, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Ratios mean something only between programs that do the same.
bool allAgree() {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const MapRequest request{.seed = seed, .samples = kSamples};
    HeightMap fast(kSamples, kSamples), scalar(kSamples, kSamples), avx2(kSamples, kSamples);
    faultFast(kFormation, request, fast.view());
    faultReferenceScalar(kFormation, request, scalar.view());
    if (__builtin_cpu_supports("avx2")) {
      faultReferenceAvx2(kFormation, request, avx2.view());
    } else {
      avx2 = scalar;
    }
    if (!test::sameBits(fast.view(), scalar.view()) || !test::sameBits(fast.view(), avx2.view()))
      return false;
  }
  return true;
}

int runAll(int argc, char** argv) {
  if (!initializeRepeated(argc, argv)) return 2;
  if (!allAgree()) {
    std::fprintf(stderr, "the versions of fault formation disagree\n");
    return 1;
  }
  const auto microseconds = benchmark::kMicrosecond;
  benchmark::RegisterBenchmark("faults/fast", faults, faultFast)->Unit(microseconds);
  benchmark::RegisterBenchmark("faults/plain-scalar", faults, faultReferenceScalar)->Unit(microseconds);
  if (__builtin_cpu_supports("avx2")) {
    benchmark::RegisterBenchmark("faults/plain-avx2", faults, faultReferenceAvx2)->Unit(microseconds);
  }
  benchmark::RegisterBenchmark("band/fast", band, true)->Unit(microseconds);
  benchmark::RegisterBenchmark("band/plain", band, false)->Unit(microseconds);
  for (const int side : {3, 5, 31}) {
    const std::string name = "matrix" + std::to_string(side);
    benchmark::RegisterBenchmark((name + "/fast").c_str(), matrix, side, true)->Unit(microseconds);
    benchmark::RegisterBenchmark((name + "/plain").c_str(), matrix, side, false)->Unit(microseconds);
  }
  for (const int side : {65, 129, 257, 1025}) {
    benchmark::RegisterBenchmark("midpoint/fast", midpoint, true)->Arg(side)->Unit(microseconds);
    benchmark::RegisterBenchmark("midpoint/plain", midpoint, false)->Arg(side)->Unit(microseconds);
  }
  MedianReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.printRatio("faults/plain-scalar", "faults/fast", 40.0);
  reporter.printRatio("faults/plain-avx2", "faults/fast", 15.0);
  for (const char* const side : {"/65", "/129", "/257"}) {
    reporter.printRatio("circles/plain", "circles/fast", 0.0, side);
    reporter.printRatio("circles/plain-avx2", "circles/fast", 0.0, side);
  }
  for (const char* const side : {"/65", "/129", "/257", "/1025"}) {
    reporter.printRatio("thermal/plain-o2", "thermal/fast", 0.0, side);
    reporter.printRatio("thermal/plain-avx2", "thermal/fast", 0.0, side);
  }
  reporter.printRatio("band/plain", "band/fast", 0.0);
  reporter.printRatio("matrix3/plain", "matrix3/fast", 0.0);
  reporter.printRatio("matrix5/plain", "matrix5/fast", 0.0);
  reporter.printRatio("matrix31/plain", "matrix31/fast", 0.0);
  for (const char* const side : {"/65", "/129", "/257", "/1025"}) {
    reporter.printRatio("midpoint/plain", "midpoint/fast", side == std::string("/257") ? 5.0 : 0.0, side);
  }
  return 0;
}

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  return teren::runAll(argc, argv);
}
