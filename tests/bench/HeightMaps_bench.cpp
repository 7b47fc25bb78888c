// The height-map library against what bounds it: copying and adding against memcpy, resampling against
// sampling every place on its own. Repetitions are interleaved at random; the ratios of the medians come
// last.
#include <cstring>
#include <functional>

#include <benchmark/benchmark.h>

#include "teren/Hash.h"
#include "teren/HeightMapOperations.h"
#include "teren/HeightSampling.h"

#include "tests/bench/MedianReporter.h"

namespace teren {
namespace {

constexpr int kSamples = 2049;  // 16 MiB a map: more than the caches hold

HeightMap randomMap(int samples) {
  HeightMap map(samples, samples);
  RandomSequence random(1);
  for (int y = 0; y < samples; ++y) {
    for (int x = 0; x < samples; ++x) map(x, y) = static_cast<float>(random.nextBits(20));
  }
  return map;
}

/// Something done again and again to a target with a source, both of so many samples a side.
void work(benchmark::State& state, int samples,
          const std::function<void(ConstHeightView, HeightView)>& apply) {
  const HeightMap source = randomMap(samples);
  HeightMap target = source;
  for (auto _ : state) {
    apply(source.view(), target.view());
    benchmark::DoNotOptimize(target.view().data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * samples * samples);
}

void copyMemory(ConstHeightView source, HeightView target) {
  std::memcpy(target.data(), source.data(),
              sizeof(float) * static_cast<std::size_t>(source.columns() * source.rows()));
}

void measure(ConstHeightView source, HeightView) {
  benchmark::DoNotOptimize(statistics(source));
}

void sampleEach(ConstHeightView source, HeightView target) {
  const double step = static_cast<double>(source.columns() - 1) / (target.columns() - 1);
  for (int y = 0; y < target.rows(); ++y) {
    for (int x = 0; x < target.columns(); ++x) {
      target(x, y) = static_cast<float>(bicubicHeight(source, x * step, y * step));
    }
  }
}

int runAll(int argc, char** argv) {
  if (!initializeRepeated(argc, argv)) return 2;
  using View = ConstHeightView;
  const auto add = [](const char* name, int samples, std::function<void(View, HeightView)> apply) {
    benchmark::RegisterBenchmark(name, work, samples, std::move(apply))->Unit(benchmark::kMicrosecond);
  };
  add("memcpy", kSamples, copyMemory);
  add("copy", kSamples, copyHeights);
  add("add", kSamples, addHeights);
  add("lerp", kSamples, [](View from, HeightView to) { lerpHeights(from, 0.25, to); });
  add("statistics", kSamples, measure);
  add("bicubic/resample", 257,
      [](View from, HeightView to) { resample(from.part(0, 0, 129, 129), to, Interpolation::bicubic); });
  add("bicubic/each", 257, [](View from, HeightView to) { sampleEach(from.part(0, 0, 129, 129), to); });
  MedianReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.printRatio("copy", "memcpy", 0.0);
  reporter.printRatio("add", "memcpy", 0.0);
  reporter.printRatio("lerp", "memcpy", 0.0);
  reporter.printRatio("statistics", "memcpy", 0.0);
  reporter.printRatio("bicubic/each", "bicubic/resample", 0.0);
  return 0;
}

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  return teren::runAll(argc, argv);
}
