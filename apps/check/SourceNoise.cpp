#include "apps/check/SourceNoise.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "teren/Hash.h"
#include "teren/RowTask.h"

namespace teren::check {
namespace {

constexpr int kMostGrids = 13;

/// Mean over all shifts of the squared weights with which a point lies between two numbers `cell` samples
/// apart.
double weightOf(int cell) {
  double sum = 0.0;
  for (int shift = 0; shift < cell; ++shift) {
    const double t = static_cast<double>(shift) / cell;
    sum += t * t + (1.0 - t) * (1.0 - t);
  }
  return sum / cell;
}

/// By what numbers in [-1, 1) are multiplied in each grid of a map of so many finest intervals.
std::vector<double> amplitudes(int intervals) {
  std::vector<double> heights;
  double variance = 0.0, height = 1.0;
  for (int cell = intervals; cell >= 1; cell /= 2, height *= std::sqrt(0.5)) {
    heights.push_back(height);
    variance += height * height * weightOf(cell) * weightOf(cell) / 3.0;
  }
  for (double& amplitude : heights) amplitude *= SourceNoise::kDeviation / std::sqrt(variance);
  return heights;
}

double sumOf(const std::vector<double>& numbers) {
  double sum = 0.0;
  for (const double number : numbers) sum += number;
  return sum;
}

class Grids {
 public:
  explicit Grids(const MapRequest& request)
      : seed_(request.seed), intervals_(request.finestIntervals), heights_(amplitudes(intervals_)) {}

  /// At a sample of the finest map.
  double height(int x, int y) const {
    double sum = 0.0;
    for (std::size_t grid = 0; grid < heights_.size(); ++grid) {
      const int cell = intervals_ >> grid;
      const std::uint64_t seed = hashWith(seed_, grid);
      const int atX = x + static_cast<int>(mixBits(seed) % static_cast<std::uint64_t>(cell));
      const int atY = y + static_cast<int>(mixBits(~seed) % static_cast<std::uint64_t>(cell));
      const double u = static_cast<double>(atX % cell) / cell, v = static_cast<double>(atY % cell) / cell;
      const int column = atX / cell, row = atY / cell;
      const double south = (1.0 - u) * number(seed, column, row) + u * number(seed, column + 1, row);
      const double north = (1.0 - u) * number(seed, column, row + 1) + u * number(seed, column + 1, row + 1);
      sum += heights_[grid] * ((1.0 - v) * south + v * north);
    }
    return sum;
  }

 private:
  static double number(std::uint64_t seed, int column, int row) {
    const std::uint64_t hash =
        hashWith(hashWith(seed, static_cast<std::uint64_t>(column)), static_cast<std::uint64_t>(row));
    return static_cast<double>(static_cast<std::int64_t>(hash)) * 0x1p-63;
  }

  std::uint64_t seed_;
  int intervals_;
  std::vector<double> heights_;
};

}  // namespace

HeightRange SourceNoise::range() const {
  double most = 0.0;
  for (int grids = 1; grids <= kMostGrids; ++grids) {
    most = std::max(most, sumOf(amplitudes(1 << (grids - 1))));
  }
  most *= 1.0 + 0x1p-20;  // rounding
  return {.mean = 0.0, .deviation = kDeviation, .min = -most, .max = most};
}

double SourceNoise::residual(int level, int, double) const {
  return level == 0 ? 0.0 : 1.5 * kDeviation;
}

std::unique_ptr<GenerationTask> SourceNoise::begin(const MapRequest& request, HeightView out) const {
  const auto finest = [request](int sample) {
    return request.samples == 1 ? request.finestIntervals / 2 : sample << request.level;
  };
  return makeRowTask(out, [out, finest, grids = Grids(request)](int row) {
    for (int column = 0; column < out.columns(); ++column) {
      out(column, row) = static_cast<float>(grids.height(finest(column), finest(row)));
    }
  });
}

}  // namespace teren::check
