#include "generators/filter/MatrixFilter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace teren {
namespace {

/// Columns that are summed side by side: their sums stay in the first-level cache.
constexpr int kBlock = 256;
/// Products of a unit, about 3 us.
constexpr int kProductsPerUnit = 8192;
constexpr int kMaxRadius = FilterMatrix::kMaxSide / 2;

/// sums[x] += weights[0] heights[x] + ... + weights[side - 1] heights[x + side - 1], added in this order.
/// Bound by arithmetic: a sum is loaded and stored once.
template <int side>
void addRow(const double* weights, const double* heights, int count, double* sums) {
  for (int x = 0; x < count; ++x) {
    double sum = sums[x];
    for (int n = 0; n < side; ++n) sum += weights[n] * heights[x + n];
    sums[x] = sum;
  }
}

/// The same for any side, weight by weight: bound by the first-level cache.
void addRow(int side, const double* weights, const double* heights, int count, double* sums) {
  for (int n = 0; n < side; ++n) {
    const double weight = weights[n];
    for (int x = 0; x < count; ++x) sums[x] += weight * heights[x + n];
  }
}

class MatrixTask final : public SlicedTask {
 public:
  MatrixTask(const FilterMatrix& matrix, int passes, HeightView map)
      : matrix_(matrix),
        passes_(map.empty() ? 0 : passes),
        map_(map),
        before_(static_cast<std::size_t>(matrix.radius() + 1) * static_cast<std::size_t>(map.columns())),
        scale_(static_cast<std::size_t>(map.columns())) {}

  bool step(const Slice& slice) override {
    do {
      if (pass_ < passes_) unit();
      if (pass_ == passes_) return true;
    } while (!slice.over());
    return false;
  }

 private:
  void unit() {
    if (block_ == 0 && nextElements_ < 0) beginRow();
    if (nextElements_ < 0) beginBlock();
    const int count = std::min(kBlock, map_.columns() - block_);
    for (int products = 0; products < kProductsPerUnit && nextElements_ < endElements_; ++nextElements_) {
      addElements(count);
      products += matrix_.side() * count;
    }
    if (nextElements_ == endElements_) endBlock(count);
  }

  /// Keeps the row as it is; those before it, as far as the matrix reaches, are kept already.
  void beginRow() {
    std::copy_n(map_.row(row_), map_.columns(), kept(row_));
    const int radius = matrix_.radius();
    firstElements_ = std::max(0, radius - (map_.rows() - 1 - row_));
    endElements_ = std::min(matrix_.side(), radius + row_ + 1);
    const std::pair used(firstElements_, endElements_);
    if (used == scaled_) return;
    scaled_ = used;
    measureScale();
  }

  void beginBlock() {
    nextElements_ = firstElements_;
    sums_.fill(0.0);
  }

  void endBlock(int count) {
    float* const heights = map_.row(row_) + block_;
    const double* const scale = scale_.data() + block_;
    for (int x = 0; x < count; ++x) {
      heights[x] = static_cast<float>(sums_[static_cast<std::size_t>(x)] * scale[x]);
    }
    nextElements_ = -1;
    block_ += count;
    if (block_ < map_.columns()) return;
    block_ = 0;
    if (++row_ < map_.rows()) return;
    row_ = 0;
    ++pass_;
  }

  /// The reciprocals of the used elements' sums, for the rows in use.
  void measureScale() {
    const int side = matrix_.side(), radius = matrix_.radius(), columns = map_.columns();
    std::array<double, FilterMatrix::kMaxSide> columnSums{};
    for (int column = 0; column < side; ++column) {
      for (int row = firstElements_; row < endElements_; ++row)
        columnSums[static_cast<std::size_t>(column)] += matrix_(row, column);
    }
    for (int x = 0; x < columns; ++x) {
      const int first = std::max(0, radius - x), end = std::min(side, radius + columns - x);
      if (first == 0 && end == side && x > radius) {
        scale_[static_cast<std::size_t>(x)] = scale_[static_cast<std::size_t>(x - 1)];
        continue;
      }
      double sum = 0.0;
      for (int column = first; column < end; ++column) sum += columnSums[static_cast<std::size_t>(column)];
      scale_[static_cast<std::size_t>(x)] = 1.0 / sum;
    }
  }

  /// Adds one row of the matrix. Samples that are not there count as 0, which changes no sum.
  void addElements(int count) {
    const int side = matrix_.side(), radius = matrix_.radius(), columns = map_.columns();
    const int from = row_ + radius - nextElements_;
    const float* const source = from > row_ ? map_.row(from) : kept(from);
    const int first = std::max(0, block_ - radius), end = std::min(columns, block_ + count + radius);
    double* const heights = heights_.data() + (first - (block_ - radius));
    std::fill(heights_.data(), heights, 0.0);
    for (int x = 0; x < end - first; ++x) heights[x] = source[first + x];
    std::fill(heights + (end - first), heights_.data() + count + 2 * radius, 0.0);
    const double* const weights = matrix_.row(nextElements_);
    if (side == 3) {
      addRow<3>(weights, heights_.data(), count, sums_.data());
    } else if (side == 5) {
      addRow<5>(weights, heights_.data(), count, sums_.data());
    } else {
      addRow(side, weights, heights_.data(), count, sums_.data());
    }
  }

  float* kept(int row) {
    const int slot = row % (matrix_.radius() + 1);
    return before_.data() + static_cast<std::ptrdiff_t>(slot) * map_.columns();
  }

  const FilterMatrix matrix_;
  int passes_;
  HeightView map_;
  std::vector<float> before_;  // the current row and those south of it, before this pass
  std::vector<double> scale_;
  std::pair<int, int> scaled_{0, 0};
  std::array<double, kBlock> sums_{};
  std::array<double, kBlock + 2 * kMaxRadius> heights_{};
  int pass_ = 0, row_ = 0, block_ = 0;
  int firstElements_ = 0, endElements_ = 0;  // rows of the matrix that have samples
  int nextElements_ = -1;                    // -1: no block begun
};

double power(double base, int exponent) {
  double result = 1.0;
  for (int n = 0; n < exponent; ++n) result *= base;
  return result;
}

}  // namespace

Result<MatrixFilter> MatrixFilter::make(FilterMatrix matrix, int passes) {
  if (passes < 1 || passes > kMaxPasses) {
    return Error{"passes is " + std::to_string(passes) + ", expected 1 to " + std::to_string(kMaxPasses)};
  }
  const double gain = power(matrix.gain(), passes);
  if (!(gain <= kMaxTotalGain)) {
    return Error{"its matrix would magnify heights more than a million times in " + std::to_string(passes) +
                 " passes"};
  }
  return MatrixFilter(std::move(matrix), passes, gain);
}

/// Exactly 2^-24 of a height for rounding to float; of the at most 961 products and sums in double, each
/// within 2^-53 of sizes up to the gain, a thousandth of that is left.
double MatrixFilter::roundingBound() const noexcept {
  return 1.001 * 0x1p-24 * passes_ * totalGain_;
}

/// A pass of gain g widens [min, max] by (g - 1) / 2 of its width on either side, and its width to g times
/// itself; passes add up to (g^passes - 1) / 2.
HeightRange MatrixFilter::range(const HeightRange& before) const noexcept {
  const double widening = (totalGain_ - 1.0) / 2.0 * (before.max - before.min);
  const double rounding = roundingBound() * std::max(std::fabs(before.min), std::fabs(before.max)) + 0x1p-140;
  return {.mean = before.mean,
          .deviation = totalGain_ * before.deviation,
          .min = before.min - widening - rounding,
          .max = before.max + widening + rounding};
}

/// Let the map's heights differ by c d in the mean square over a distance of d samples, as those of faults
/// do, let s = 2^level, and let w be the weights of all passes together. The filtered fine map minus the
/// triangles through the filtered coarse one is a sum over the matrix's places k: w_k times (the fine map at
/// x + k minus the triangles at x + s k). With g the sum of the |w|, the mean square of the sum is at most g
/// times that of its terms, weighted with |w|; and by the triangle inequality of c d the mean square of a
/// term is at most the residual's square before plus c (s - 1) |k|. The residual's square is c s / 4.7 at
/// level 1, c s / 4.3 beyond (FaultFormation.cpp), and the mean of |k| at most the root of the mean of its
/// square, which over several passes adds up as in a random walk: passes times the variance, passes^2 times
/// the shift's square. For rougher maps, where heights differ as d^2H with H < 1/2, the same holds with a
/// smaller factor.
double MatrixFilter::residual(double before, int level) const noexcept {
  constexpr double kSquaresPerResidual = 4.7;
  const double shift = passes_ * passes_ * matrix_.squaredShift();
  const double reach = std::sqrt(passes_ * (matrix_.squaredReach() - matrix_.squaredShift()) + shift);
  const double away = 1.0 - 1.0 / static_cast<double>(std::int64_t{1} << std::clamp(level, 0, 62));
  return before * totalGain_ * std::sqrt(1.0 + kSquaresPerResidual * away * reach / totalGain_);
}

std::unique_ptr<SlicedTask> MatrixFilter::begin(HeightView inOut) const {
  return std::make_unique<MatrixTask>(matrix_, passes_, inOut);
}

}  // namespace teren
