// How long it takes to approximate a grid of 1025 x 1025 samples by triangles, and with how many, at four
// errors.
//   bench-grid-tin [ROUNDS]       the thread's own time, medians; the true error at all samples beside the
//   promise bench-grid-tin --write FILE   the grid, as little-endian floats, for tests/bench/compare-delatin
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "teren/Hash.h"

#include "generators/numbers/RandomNumber.h"
#include "generators/tin/GridApproximation.h"
#include "tests/bench/Timing.h"

namespace teren {
namespace {

constexpr int kSide = 1025;

/// Midpoint displacement whose amplitude falls by 0.55 a level, scaled to [0, 1].
HeightMap terrain() {
  HeightMap map(kSide, kSide);
  RandomSequence random(1);
  float amplitude = 1.0f;
  for (int step = kSide - 1; step > 1; step /= 2) {
    const int half = step / 2;
    const auto displaced = [&](int x, int y, int dx, int dy) {
      float sum = 0.0f;
      int count = 0;
      for (const auto& [u, v] : {std::pair(x - dx, y - dy), std::pair(x + dx, y + dy),
                                 std::pair(x - dy, y + dx), std::pair(x + dy, y - dx)}) {
        if (u < 0 || v < 0 || u >= kSide || v >= kSide) continue;
        sum += map(u, v);
        ++count;
      }
      return sum / static_cast<float>(count) +
             amplitude * static_cast<float>(uniformAroundZero(random.next()));
    };
    for (int y = half; y < kSide; y += step) {
      for (int x = half; x < kSide; x += step) map(x, y) = displaced(x, y, half, half);
    }
    for (int y = 0; y < kSide; y += half) {
      for (int x = y / half % 2 == 0 ? half : 0; x < kSide; x += step) map(x, y) = displaced(x, y, half, 0);
    }
    amplitude *= 0.55f;
  }
  const auto [lowest, highest] = std::minmax_element(map.samples().begin(), map.samples().end());
  const float base = *lowest, scale = 1.0f / (*highest - *lowest);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) map(x, y) = (map(x, y) - base) * scale;
  }
  return map;
}

int measure(int rounds) {
  const HeightMap map = terrain();
  const LatticeFrame frame{.step = 1.0, .width = kSide - 1, .height = kSide - 1};
  std::printf("%-10s %10s %10s %12s\n", "error", "triangles", "seconds", "true error");
  for (const double error : {0.02, 0.01, 0.005, 0.002, 0.001}) {
    std::vector<double> seconds;
    std::size_t triangles = 0;
    double worst = 0.0;
    for (int round = 0; round < rounds; ++round) {
      const double start = processorSeconds();
      const Result<Triangulation> mesh = approximateGrid(map.view(), frame, error);
      seconds.push_back(processorSeconds() - start);
      triangles = mesh->triangleCount();
      worst = worstErrorAtSamples(*mesh, map.view());
    }
    std::sort(seconds.begin(), seconds.end());
    std::printf("%-10g %10zu %10.4f %12.8f\n", error, triangles, seconds[seconds.size() / 2], worst);
  }
  return 0;
}

int write(const char* name) {
  const HeightMap map = terrain();
  std::FILE* file = std::fopen(name, "wb");
  if (file == nullptr) return 1;
  const std::size_t written = std::fwrite(map.samples().data(), sizeof(float), map.samples().size(), file);
  return std::fclose(file) == 0 && written == map.samples().size() ? 0 : 1;
}

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  if (argc == 3 && std::strcmp(argv[1], "--write") == 0) return teren::write(argv[2]);
  return teren::measure(argc > 1 ? std::max(1, std::atoi(argv[1])) : 3);
}
