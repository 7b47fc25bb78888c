#include "generators/noise/Noise.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "generators/noise/NoiseConstants.h"
#include "generators/noise/NoiseTask.h"

namespace teren {
namespace {

NoiseRowKernel kernelOf(NoisePath path, NoiseVariant variant) noexcept {
#ifdef TEREN_NOISE_X86
  if (path == NoisePath::avx512) return noiseKernelAvx512(variant);
  if (path == NoisePath::avx2) return noiseKernelAvx2(variant);
#endif
  assert(path == NoisePath::plain);
  return noiseKernelPlain(variant);
}

}  // namespace

bool Noise::runs([[maybe_unused]] NoisePath path) noexcept {
#ifdef TEREN_NOISE_X86
  if (path == NoisePath::avx512) {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  }
  if (path == NoisePath::avx2) return __builtin_cpu_supports("avx2");
#endif
  return path == NoisePath::plain;
}

NoisePath Noise::fastestPath() noexcept {
  static const NoisePath fastest = runs(NoisePath::avx512) ? NoisePath::avx512
                                   : runs(NoisePath::avx2) ? NoisePath::avx2
                                                           : NoisePath::plain;
  return fastest;
}

int Noise::kept(int level, double spacing) const noexcept {
  if (level == 0) return settings_.octaves;
  int kept = 0;
  while (kept < settings_.octaves && plan_.frequency(kept) * spacing <= 0.5) ++kept;
  return kept;
}

HeightRange Noise::range() const noexcept {
  const double mean = plan_.mean(), largest = plan_.largest(), rounding = 1e-5 * largest;
  const double least = settings_.fractal == NoiseFractal::fbm ? -largest : 0.0;
  return {.mean = 0.0,
          .deviation = settings_.deviation,
          .min = least - mean - rounding,
          .max = largest - mean + rounding};
}

std::unique_ptr<SlicedTask> Noise::begin(const FieldRequest& request, HeightView out, NoisePath path) const {
  assert(runs(path));
  const bool warped = settings_.warp > 0.0 && kept(request.level, request.spacing) > 0;
  const NoiseVariant variant{settings_.kind, settings_.fractal, warped};
  return beginNoise(*this, request, out, kernelOf(path, variant), path == NoisePath::plain ? 32 : 128);
}

}  // namespace teren
