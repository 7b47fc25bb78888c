// Spectral synthesis: the inverse transform against FFTW's (where libfftw3-dev is installed; nothing else of
// Teren links it), and whole maps against the direct sum. First the errors, then the interleaved times, then
// the ratios of the medians.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "teren/Hash.h"
#include "teren/HeightMap.h"

#include "generators/numbers/RandomNumber.h"
#include "generators/spectral/InverseTransform.h"
#include "generators/spectral/SpectralReference.h"
#include "generators/spectral/SpectralSynthesis.h"
#include "tests/bench/MedianReporter.h"

#ifdef TEREN_BENCH_FFTW
#include <fftw3.h>
#endif

namespace teren {
namespace {

constexpr int kSides[] = {64, 128, 256, 1024};
constexpr int kHarmonics[] = {4, 8, 16, 32, 64, 128};

/// As many random harmonics as a side holds.
class DenseHarmonics final : public HarmonicSource {
 public:
  explicit DenseHarmonics(int side) : largest_(side / 2 - 1) {
    RandomSequence words(static_cast<std::uint64_t>(side));
    rows_.resize(static_cast<std::size_t>((largest_ + 1) * (2 * largest_ + 1)));
    for (Harmonic& harmonic : rows_) {
      harmonic.re = static_cast<float>(uniformAroundZero(words.next()));
      harmonic.im = static_cast<float>(uniformAroundZero(words.next()));
    }
  }
  int largest() const noexcept override { return largest_; }
  void row(int l, Harmonic* row) const noexcept override { std::copy_n(rowAt(l), 2 * largest_ + 1, row); }
  const Harmonic* rowAt(int l) const noexcept { return rows_.data() + l * (2 * largest_ + 1); }

 private:
  int largest_;
  std::vector<Harmonic> rows_;
};

void transform(benchmark::State& state, int side) {
  const DenseHarmonics harmonics(side);
  HeightMap map(side, side);
  for (auto _ : state) {
    InverseTransform(harmonics, side, 1.0f, map.view()).step(Slice::unlimited());
    benchmark::ClobberMemory();
  }
}

#ifdef TEREN_BENCH_FFTW
/// FFTW's plan for a square, made by measuring, on one thread. Its half plane is the one of x.
class Fftw {
 public:
  explicit Fftw(int side)
      : side_(side),
        harmonics_(fftwf_alloc_complex(static_cast<std::size_t>(side) * (side / 2 + 1))),
        heights_(fftwf_alloc_real(static_cast<std::size_t>(side) * side)),
        plan_(fftwf_plan_dft_c2r_2d(side, side, harmonics_, heights_, FFTW_MEASURE)) {
    clear();
  }
  ~Fftw() {
    fftwf_destroy_plan(plan_);
    fftwf_free(heights_);
    fftwf_free(harmonics_);
  }
  Fftw(const Fftw&) = delete;
  Fftw& operator=(const Fftw&) = delete;

  void clear() {
    for (int n = 0; n < side_ * (side_ / 2 + 1); ++n) harmonics_[n][0] = harmonics_[n][1] = 0.0f;
  }
  /// x and y change places, so that the half plane of y becomes the one of x.
  void set(const DenseHarmonics& source) {
    clear();
    const int largest = source.largest();
    for (int l = 0; l <= largest; ++l) {
      for (int k = -largest; k <= largest; ++k) {
        // At l = 0 both a wave and its opposite are stored.
        const Harmonic a = source.rowAt(l)[largest + k];
        const Harmonic b = l == 0 ? source.rowAt(0)[largest - k] : Harmonic{};
        fftwf_complex& to = harmonics_[(k & (side_ - 1)) * (side_ / 2 + 1) + l];
        to[0] = 0.5f * (a.re + b.re);
        to[1] = 0.5f * (a.im - b.im);
      }
    }
  }
  void run() { fftwf_execute(plan_); }
  float at(int x, int y) const { return heights_[x * side_ + y]; }

 private:
  int side_;
  fftwf_complex* harmonics_;
  float* heights_;
  fftwf_plan plan_;
};

/// A plan may destroy what it reads; zeros stay zeros and cost what numbers cost.
void fftw(benchmark::State& state, int side) {
  Fftw plan(side);
  for (auto _ : state) {
    plan.run();
    benchmark::ClobberMemory();
  }
}

bool agreesWithFftw(int side) {
  const DenseHarmonics harmonics(side);
  HeightMap map(side, side);
  InverseTransform(harmonics, side, 1.0f, map.view()).step(Slice::unlimited());
  Fftw plan(side);
  plan.set(harmonics);
  plan.run();
  double square = 0.0, difference = 0.0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      square += map(x, y) * map(x, y);
      difference += (map(x, y) - plan.at(x, y)) * (map(x, y) - plan.at(x, y));
    }
  }
  const double relative = std::sqrt(difference / square);
  std::printf("transform%d: RMS difference from FFTW, single precision: %.1e of the RMS height\n", side,
              relative);
  return relative < 1e-6;
}
#endif

MapRequest requestOf(int samples) {
  return {.seed = 1, .samples = samples, .finestIntervals = samples - 1};
}

void synthesis(benchmark::State& state, int samples, SpectralRule rule, int harmonics) {
  const SpectralSynthesis synthesis(rule, 0.8, 1.0, harmonics);
  HeightMap map(samples, samples);
  MapRequest request = requestOf(samples);
  for (auto _ : state) {
    ++request.seed;
    synthesis.begin(request, map.view())->step(Slice::unlimited());
    benchmark::ClobberMemory();
  }
}

void directSum(benchmark::State& state, int samples, int harmonics) {
  const SpectralSynthesis synthesis(SpectralRule::isotropic, 0.8, 1.0, harmonics);
  HeightMap map(samples, samples);
  MapRequest request = requestOf(samples);
  for (auto _ : state) {
    ++request.seed;
    spectralDirectSum(synthesis, request, map.view());
    benchmark::ClobberMemory();
  }
}

/// Errors against the direct sum in double, as a part of the deviation. False if they are not roundings.
bool agreesWithDirectSum(int samples, int harmonics) {
  const SpectralSynthesis synthesis(SpectralRule::isotropic, 0.8, 1.0, harmonics);
  const MapRequest request = requestOf(samples);
  HeightMap map(samples, samples);
  synthesis.begin(request, map.view())->step(Slice::unlimited());
  const std::vector<double> exact = spectralReference(synthesis, request);
  double square = 0.0, largest = 0.0;
  for (std::size_t n = 0; n < exact.size(); ++n) {
    const double error = std::fabs(map.samples()[n] - exact[n]);
    square += error * error;
    largest = std::max(largest, error);
  }
  const double rms = std::sqrt(square / static_cast<double>(exact.size()));
  std::printf("spectral%d, %3d harmonics: error RMS %.1e, largest %.1e of the deviation\n", samples,
              harmonics, rms, largest);
  return rms < 3e-7 && largest < 2e-6;
}

void printPerSample(const MedianReporter& reporter, const std::string& name, int samples) {
  const double microseconds = reporter.median(name);
  if (microseconds > 0.0)
    std::printf("%s: %.2f ns per sample\n", name.c_str(), 1e3 * microseconds / (samples * samples));
}

std::string named(const char* name, int number) {
  return std::string(name) + "/" + std::to_string(number);
}

bool allAgree() {
  bool agree = true;
  for (const int harmonics : kHarmonics) agree = agreesWithDirectSum(257, harmonics) && agree;
#ifdef TEREN_BENCH_FFTW
  for (const int side : kSides) agree = agreesWithFftw(side) && agree;
#else
  std::printf("without FFTW: libfftw3-dev was not found when this was configured\n");
#endif
  return agree;
}

void registerAll() {
  const auto add = [](const std::string& name, auto... arguments) {
    return benchmark::RegisterBenchmark(name.c_str(), arguments...)->Unit(benchmark::kMicrosecond);
  };
  for (const int side : kSides) {
    add(named("transform/fast", side), transform, side);
#ifdef TEREN_BENCH_FFTW
    add(named("transform/rival", side), fftw, side);
#endif
    const auto rule = SpectralRule::isotropic;
    add(named("spectral/fast", side + 1), synthesis, side + 1, rule, 32);
    add(named("spectral/plain", side + 1), directSum, side + 1, 32)->Iterations(1);
    add(named("spectral-published/fast", side + 1), synthesis, side + 1, SpectralRule::published, 32);
  }
  for (const int harmonics : kHarmonics) {
    add(named("harmonics/fast", harmonics), synthesis, 257, SpectralRule::isotropic, harmonics);
    add(named("harmonics/plain", harmonics), directSum, 257, harmonics)->Iterations(1);
  }
}

int runAll(int argc, char** argv) {
  if (!initializeRepeated(argc, argv)) return 2;
  if (!allAgree()) {
    std::fprintf(stderr, "the versions of spectral synthesis disagree\n");
    return 1;
  }
  registerAll();
  MedianReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  for (const int side : kSides) {
    printPerSample(reporter, named("spectral/fast", side + 1), side + 1);
    printPerSample(reporter, named("spectral-published/fast", side + 1), side + 1);
  }
  for (const int harmonics : kHarmonics) {
    reporter.printRatio(named("harmonics/plain", harmonics).c_str(),
                        named("harmonics/fast", harmonics).c_str(), 0.0);
  }
  for (const int side : kSides) {
    const double mine = reporter.median(named("transform/fast", side)),
                 rival = reporter.median(named("transform/rival", side));
    if (rival <= 0.0) continue;
    std::printf("transform/fast/%d / transform/rival/%d = %.2f%s\n", side, side, mine / rival,
                side == 256 ? " (wanted: at most 2)" : "");
  }
  return 0;
}

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  return teren::runAll(argc, argv);
}
