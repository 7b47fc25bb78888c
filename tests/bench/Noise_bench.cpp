// Gradient noise on 1024 x 1024: its three paths, and libnoise's Perlin noise where libnoise-dev is installed
// (nothing else of Teren links it). Repetitions are interleaved at random; nanoseconds a sample and the
// ratios of the medians come last.
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "teren/HeightMap.h"

#include "generators/noise/Noise.h"
#include "tests/bench/MedianReporter.h"
#include "tests/support/SlicedWork.h"

#ifdef TEREN_BENCH_LIBNOISE
#include <libnoise/noise.h>
#endif

namespace teren {
namespace {

constexpr int kSide = 1024;
constexpr int kSides[] = {65, 129, 257, 1025};
constexpr double kFrequency = 1.0 / 128.0;  // [1/m], with samples 1 m apart

struct Path {
  NoisePath path;
  const char* name;
};
constexpr Path kPaths[] = {
    {NoisePath::plain, "plain"}, {NoisePath::avx2, "avx2"}, {NoisePath::avx512, "avx512"}};

struct Variant {
  const char* name;
  NoiseSettings settings;
};

/// Eight octaves each.
const std::vector<Variant>& variants() {
  const auto of = [](NoiseKind kind, NoiseFractal fractal, double warp) {
    return NoiseSettings{.kind = kind, .fractal = fractal, .frequency = kFrequency, .warp = warp};
  };
  static const std::vector<Variant> all = {
      {"perlin", of(NoiseKind::perlin, NoiseFractal::fbm, 0.0)},
      {"simplex", of(NoiseKind::simplex, NoiseFractal::fbm, 0.0)},
      {"ridged-perlin", of(NoiseKind::perlin, NoiseFractal::ridged, 0.0)},
      {"billow-perlin", of(NoiseKind::perlin, NoiseFractal::billow, 0.0)},
      {"warped-perlin", of(NoiseKind::perlin, NoiseFractal::fbm, 60.0)},
      {"warped-simplex", of(NoiseKind::simplex, NoiseFractal::fbm, 60.0)},
  };
  return all;
}

FieldRequest requestOf(int side, std::uint64_t seed) {
  return {.seed = seed, .spacing = 1.0, .columns = side, .rows = side};
}

void noise(benchmark::State& state, const NoiseSettings& settings, NoisePath path, int side) {
  const Noise noise(settings);
  HeightMap map(side, side);
  std::uint64_t seed = 0;
  for (auto _ : state) {
    noise.begin(requestOf(side, ++seed), map.view(), path)->step(Slice::unlimited());
    benchmark::ClobberMemory();
  }
}

#ifdef TEREN_BENCH_LIBNOISE
/// The same place, spacing, frequency and octaves; three dimensions with z = 0.
void libnoise(benchmark::State& state, int side) {
  ::noise::module::Perlin perlin;
  perlin.SetOctaveCount(8);
  HeightMap map(side, side);
  for (auto _ : state) {
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column) {
        map(column, row) = static_cast<float>(perlin.GetValue(column * kFrequency, row * kFrequency, 0.0));
      }
    }
    benchmark::ClobberMemory();
  }
}
#endif

bool pathsAgree() {
  for (const Variant& variant : variants()) {
    const Noise noise(variant.settings);
    HeightMap plain(200, 200), other(200, 200);
    noise.begin(requestOf(200, 3), plain.view(), NoisePath::plain)->step(Slice::unlimited());
    for (const Path& path : kPaths) {
      if (!Noise::runs(path.path)) continue;
      noise.begin(requestOf(200, 3), other.view(), path.path)->step(Slice::unlimited());
      if (!test::sameBits(plain.view(), other.view())) return false;
    }
  }
  return true;
}

std::string named(const char* variant, const char* path) {
  return std::string(variant) + "/" + path;
}
std::string named(const char* variant, const char* path, int side) {
  return named(variant, path) + "/" + std::to_string(side);
}

/// Names with a side are what tests/bench/table reads.
void registerAll() {
  const auto add = [](const std::string& name, auto... arguments) {
    benchmark::RegisterBenchmark(name.c_str(), arguments...)->Unit(benchmark::kMicrosecond);
  };
  for (const Variant& variant : variants()) {
    for (const Path& path : kPaths) {
      if (Noise::runs(path.path))
        add(named(variant.name, path.name), noise, variant.settings, path.path, kSide);
    }
  }
  for (const Variant& variant : {variants()[0], variants()[1]}) {
    for (const int side : kSides) {
      add(named(variant.name, "fast", side), noise, variant.settings, Noise::fastestPath(), side);
      add(named(variant.name, "plain", side), noise, variant.settings, NoisePath::plain, side);
#ifdef TEREN_BENCH_LIBNOISE
      add(named(variant.name, "rival", side), libnoise, side);
#endif
    }
    add(named(variant.name, "one-sample"), noise, variant.settings, Noise::fastestPath(), 1);
  }
#ifdef TEREN_BENCH_LIBNOISE
  add("libnoise/perlin", libnoise, kSide);
#endif
}

void printPerSample(const MedianReporter& reporter, const std::string& name, int side) {
  const double microseconds = reporter.median(name);
  if (microseconds > 0.0)
    std::printf("%-28s %7.2f ns per sample\n", name.c_str(), 1e3 * microseconds / (side * side));
}

int runAll(int argc, char** argv) {
  if (!initializeRepeated(argc, argv)) return 2;
  if (!pathsAgree()) {
    std::fprintf(stderr, "the paths of noise disagree\n");
    return 1;
  }
  registerAll();
  MedianReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  for (const Variant& variant : variants()) {
    for (const Path& path : kPaths) printPerSample(reporter, named(variant.name, path.name), kSide);
    for (const int side : kSides) printPerSample(reporter, named(variant.name, "fast", side), side);
    printPerSample(reporter, named(variant.name, "one-sample"), 1);
  }
  printPerSample(reporter, "libnoise/perlin", kSide);
  // Recorded elsewhere (8 octaves, this side): the best library with SIMD known.
  std::printf(
      "recorded of the best SIMD library: Perlin 11.4 (AVX-512), 33 (AVX2), 55 (SSE4.1); simplex 14.7, "
      "38, 60 ns per sample\n");
  const std::pair<const char*, double> wanted[] = {{"plain", 0.0}, {"avx2", 12.0}, {"avx512", 30.0}};
  for (const auto& [path, ratio] : wanted) {
    reporter.printRatio("libnoise/perlin", named("perlin", path).c_str(), ratio);
    reporter.printRatio("libnoise/perlin", named("simplex", path).c_str(), 0.0);
  }
  return 0;
}

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  return teren::runAll(argc, argv);
}
