// Generators and filters against their plain versions, which for some are compiled once for the scalar unit
// and once for AVX2, at four sides. Repetitions are interleaved at random; the ratios of the medians come
// last. A benchmark's name is WHAT/VERSION/SIDE, which tests/bench/table reads.
#include <cstdio>
#include <map>
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

const FaultFormation kFormation(150, 4.0);
const BandFilter kFilter(0.9, 5);

void faultFast(const FaultFormation& formation, const MapRequest& request, HeightView out) {
  formation.begin(request, out)->step(Slice::unlimited());
}

using MakeFaults = void (*)(const FaultFormation&, const MapRequest&, HeightView);

/// Every benchmark makes or changes maps of as many samples a side as its argument says.
int sideOf(const benchmark::State& state) {
  return static_cast<int>(state.range(0));
}

void faults(benchmark::State& state, MakeFaults make) {
  HeightMap map(sideOf(state), sideOf(state));
  MapRequest request{.samples = sideOf(state)};
  for (auto _ : state) {
    ++request.seed;
    make(kFormation, request, map.view());
    benchmark::DoNotOptimize(map.view().data());
    benchmark::ClobberMemory();
  }
}

HeightMap source(const benchmark::State& state) {
  HeightMap map(sideOf(state), sideOf(state));
  faultFast(kFormation, {.samples = sideOf(state)}, map.view());
  return map;
}

void band(benchmark::State& state, bool fast) {
  HeightMap map = source(state);
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
  HeightMap map = source(state);
  for (auto _ : state) {
    if (fast) {
      filter.begin(map.view())->step(Slice::unlimited());
    } else {
      matrixReference(filter, map.view());
    }
    benchmark::ClobberMemory();
  }
}

void midpoint(benchmark::State& state, bool fast) {
  static const MidpointDisplacement displacement{MidpointSettings{}};
  HeightMap map(sideOf(state), sideOf(state));
  MapRequest request{.samples = sideOf(state)};
  for (auto _ : state) {
    ++request.seed;
    if (fast) {
      displacement.begin(request, map.view())->step(Slice::unlimited());
    } else {
      midpointReference(displacement, request, map.view());
    }
    benchmark::ClobberMemory();
  }
}

/// Ratios mean something only between programs that do the same.
bool allAgree() {
  constexpr int kSamples = 257;
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

template <class Work, class... Arguments>
void addAtAllSides(const std::string& name, Work work, Arguments... arguments) {
  benchmark::internal::Benchmark* added = benchmark::RegisterBenchmark(name.c_str(), work, arguments...);
  for (const int side : {65, 129, 257, 1025}) added->Arg(side);
  added->Unit(benchmark::kMicrosecond);
}

void addAll() {
  addAtAllSides("faults/fast", faults, faultFast);
  addAtAllSides("faults/plain", faults, faultReferenceScalar);
  if (__builtin_cpu_supports("avx2")) addAtAllSides("faults/plain-avx2", faults, faultReferenceAvx2);
  addAtAllSides("midpoint/fast", midpoint, true);
  addAtAllSides("midpoint/plain", midpoint, false);
  addAtAllSides("band/fast", band, true);
  addAtAllSides("band/plain", band, false);
  for (const int side : {3, 5, 31}) {
    const std::string name = "matrix" + std::to_string(side);
    addAtAllSides(name + "/fast", matrix, side, true);
    addAtAllSides(name + "/plain", matrix, side, false);
  }
}

/// What the plain version must cost at least, in parts of ours; 0: nothing is wanted.
double wantedRatio(const std::string& plain) {
  static const std::map<std::string, double> wanted = {
      {"faults/plain/257", 40.0}, {"faults/plain-avx2/257", 15.0}, {"midpoint/plain/257", 5.0}};
  const auto found = wanted.find(plain);
  return found == wanted.end() ? 0.0 : found->second;
}

int runAll(int argc, char** argv) {
  if (!initializeRepeated(argc, argv)) return 2;
  if (!allAgree()) {
    std::fprintf(stderr, "the versions of fault formation disagree\n");
    return 1;
  }
  addAll();
  MedianReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  for (const std::string what : {"constant", "slope", "steps", "faults", "midpoint", "circles", "band",
                                 "matrix3", "matrix5", "matrix31", "thermal"}) {
    for (const std::string side : {"/65", "/129", "/257", "/1025"}) {
      for (const std::string& plain : {what + "/plain", what + "/plain-avx2"}) {
        reporter.printRatio(plain.c_str(), (what + "/fast").c_str(), wantedRatio(plain + side), side.c_str());
      }
    }
  }
  return 0;
}

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  return teren::runAll(argc, argv);
}
