#include "teren/HeightMapOperations.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

#include "height/Overlap.h"

namespace teren {

namespace {

/// target = operation(target, source) for every sample. Where both overlap, the target lies a constant
/// distance behind or ahead of the source; sweeping away from it reads every sample before it is written.
template <class Operation>
void combine(ConstHeightView source, HeightView target, Operation operation) noexcept {
  assert(source.columns() == target.columns() && source.rows() == target.rows());
  assert(source.stride() == target.stride() || !overlapping(source, target));
  const int columns = target.columns(), rows = target.rows();
  if (std::less<const float*>()(source.data(), target.data())) {
    for (int y = rows; y-- > 0;) {
      const float* const from = source.row(y);
      float* const to = target.row(y);
      for (int x = columns; x-- > 0;) to[x] = operation(to[x], from[x]);
    }
  } else {
    for (int y = 0; y < rows; ++y) {
      const float* const from = source.row(y);
      float* const to = target.row(y);
      for (int x = 0; x < columns; ++x) to[x] = operation(to[x], from[x]);
    }
  }
}

template <class Operation>
void change(HeightView target, Operation operation) noexcept {
  for (int y = 0; y < target.rows(); ++y) {
    float* const row = target.row(y);
    for (int x = 0; x < target.columns(); ++x) row[x] = operation(row[x]);
  }
}

/// As std::min and std::max, but NaN if either is: comparisons with NaN are false, and it differs from
/// itself.
template <class Number>
Number lower(Number a, Number b) noexcept {
  return b < a || b != b ? b : a;
}
template <class Number>
Number higher(Number a, Number b) noexcept {
  return a < b || b != b ? b : a;
}

/// What remains of [from, from + count) in [0, sourceCount) when its start is laid on `to` of
/// [0, targetCount).
struct MatchedRange {
  int from = 0, to = 0, count = 0;
};
MatchedRange match(std::int64_t from, std::int64_t count, int sourceCount, std::int64_t to,
                   int targetCount) noexcept {
  const std::int64_t cut = std::max({std::int64_t{0}, -from, -to});
  const std::int64_t left = std::min({count, sourceCount - from, targetCount - to}) - cut;
  if (left <= 0) return {};
  return {static_cast<int>(from + cut), static_cast<int>(to + cut), static_cast<int>(left)};
}

}  // namespace

MatchedParts matchedParts(ConstHeightView source, const HeightRectangle& from, HeightView target, int column,
                          int row) noexcept {
  const MatchedRange x = match(from.column, from.columns, source.columns(), column, target.columns());
  const MatchedRange y = match(from.row, from.rows, source.rows(), row, target.rows());
  if (x.count == 0 || y.count == 0) return {};
  return {source.part(x.from, y.from, x.count, y.count), target.part(x.to, y.to, x.count, y.count)};
}

MatchedParts matchedParts(ConstHeightView source, HeightView target, int column, int row) noexcept {
  return matchedParts(source, {0, 0, source.columns(), source.rows()}, target, column, row);
}

void copyHeights(ConstHeightView source, HeightView target) noexcept {
  combine(source, target, [](float, float from) { return from; });
}

void addHeights(ConstHeightView source, HeightView target) noexcept {
  combine(source, target, [](float to, float from) { return to + from; });
}

void subtractHeights(ConstHeightView source, HeightView target) noexcept {
  combine(source, target, [](float to, float from) { return to - from; });
}

void multiplyHeights(ConstHeightView source, HeightView target) noexcept {
  combine(source, target, [](float to, float from) { return to * from; });
}

void minHeights(ConstHeightView source, HeightView target) noexcept {
  combine(source, target, [](float to, float from) { return lower(to, from); });
}

void maxHeights(ConstHeightView source, HeightView target) noexcept {
  combine(source, target, [](float to, float from) { return higher(to, from); });
}

void lerpHeights(ConstHeightView source, double t, HeightView target) noexcept {
  const double rest = 1.0 - t;
  combine(source, target, [=](float to, float from) {
    return static_cast<float>(rest * static_cast<double>(to) + t * static_cast<double>(from));
  });
}

void fillHeights(HeightView target, float height) noexcept {
  change(target, [=](float) { return height; });
}

void shiftHeights(HeightView target, double metres) noexcept {
  change(target, [=](float height) { return static_cast<float>(static_cast<double>(height) + metres); });
}

void scaleHeights(HeightView target, double factor) noexcept {
  change(target, [=](float height) { return static_cast<float>(factor * static_cast<double>(height)); });
}

void weightedSum(std::span<const WeightedHeights> terms, HeightView target) noexcept {
  assert(terms.size() <= kMostTerms);
  for (const WeightedHeights& term : terms) {
    assert(term.heights.columns() == target.columns() && term.heights.rows() == target.rows());
    const bool same = term.heights.data() == target.data() && term.heights.stride() == target.stride();
    assert(same || !overlapping(term.heights, target));
    static_cast<void>(same);
  }
  for (int y = 0; y < target.rows(); ++y) {
    float* const row = target.row(y);
    for (int x = 0; x < target.columns(); ++x) {
      double sum = 0.0;
      for (const WeightedHeights& term : terms)
        sum += term.weight * static_cast<double>(term.heights.row(y)[x]);
      row[x] = static_cast<float>(sum);
    }
  }
}

HeightStatistics statistics(ConstHeightView heights) noexcept {
  if (heights.empty()) return {};
  const double count = static_cast<double>(heights.columns()) * heights.rows();
  HeightStatistics result{heights(0, 0), heights(0, 0), 0.0, 0.0};
  double sum = 0.0;
  for (int y = 0; y < heights.rows(); ++y) {
    double rowSum = 0.0;
    for (int x = 0; x < heights.columns(); ++x) {
      const double height = heights(x, y);
      result.min = lower(result.min, height);
      result.max = higher(result.max, height);
      rowSum += height;
    }
    sum += rowSum;
  }
  result.mean = sum / count;
  double squares = 0.0;
  for (int y = 0; y < heights.rows(); ++y) {
    double rowSquares = 0.0;
    for (int x = 0; x < heights.columns(); ++x) {
      const double deviation = heights(x, y) - result.mean;
      rowSquares += deviation * deviation;
    }
    squares += rowSquares;
  }
  result.deviation = std::sqrt(squares / count);
  return result;
}

}  // namespace teren
