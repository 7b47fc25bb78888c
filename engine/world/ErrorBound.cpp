#include "world/ErrorBound.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace teren {

namespace {

/// Bounds on a weight along one axis and on its first two derivatives.
struct WeightBound {
  double value = 0.0, first = 0.0, second = 0.0;
};

double quinticFirst(double t) {
  return 30.0 * t * t * (1.0 - t) * (1.0 - t);
}
double quinticSecond(double t) {
  return 60.0 * t * (1.0 - t) * (1.0 - 2.0 * t);
}

/// The kernel's derivatives on [a, b]: monotone between the named extrema, so ends and extrema decide.
WeightBound kernelBound(BlendKernel kernel, double a, double b) {
  WeightBound bound;
  if (kernel == BlendKernel::linear) return {0.0, 1.0, 0.0};
  bound.first = std::max(quinticFirst(a), quinticFirst(b));
  if (a <= 0.5 && 0.5 <= b) bound.first = quinticFirst(0.5);
  bound.second = std::max(std::fabs(quinticSecond(a)), std::fabs(quinticSecond(b)));
  constexpr double kExtremum = 0.21132486540518713;  // (3 - sqrt 3) / 6, and its mirror image
  if ((a <= kExtremum && kExtremum <= b) || (a <= 1.0 - kExtremum && 1.0 - kExtremum <= b)) {
    bound.second = std::fabs(quinticSecond(kExtremum));
  }
  return bound;
}

/// u = w, or w / sqrt(w^2 + (1 - w)^2).
std::array<WeightBound, 2> weightBounds(const Layer& layer, double a, double b) {
  const WeightBound kernel = kernelBound(layer.kernel(), a, b);
  const AxisWeights atA = blendWeights(layer.kernel(), a), atB = blendWeights(layer.kernel(), b);
  WeightBound low, high;
  low.value = std::max(atA.low, atB.low);
  high.value = std::max(atA.high, atB.high);
  low.first = high.first = kernel.first;
  low.second = high.second = kernel.second;
  if (layer.preserveVariance()) {
    const auto normalised = [](double w) { return w / std::sqrt(w * w + (1.0 - w) * (1.0 - w)); };
    low.value = normalised(low.value);
    high.value = normalised(high.value);
    low.first = high.first = kNormalisedFirst * kernel.first;
    low.second = high.second =
        kNormalisedSecond * kernel.first * kernel.first + kNormalisedFirst * kernel.second;
  }
  return {low, high};
}

/// Bounds on a map's deviation from the mean and on its derivatives, by pitches of the layer.
struct PieceBound {
  double value = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
};

using Four = std::array<double, 4>;
using Square = std::array<Four, 4>;

/// Catmull-Rom taps as Bernstein coefficients of the same cubic.
Four bernstein(const Four& p) {
  return {p[1], p[1] + (p[2] - p[0]) / 6.0, p[2] - (p[3] - p[1]) / 6.0, p[2]};
}

/// The sample at (x, y), continued linearly by one beyond the rims as cubicTaps does.
double continued(ConstHeightView map, int x, int y) {
  const int last = map.columns() - 1;
  if (x < 0) return 2.0 * continued(map, 0, y) - continued(map, 1, y);
  if (x > last) return 2.0 * continued(map, last, y) - continued(map, last - 1, y);
  if (y < 0) return 2.0 * map(x, 0) - map(x, 1);
  if (y > last) return 2.0 * map(x, last) - map(x, last - 1);
  return map(x, y);
}

Square pieceCoefficients(ConstHeightView map, int column, int row, double mean) {
  Square acrossRows;
  for (int y = 0; y < 4; ++y) {
    Four taps;
    for (int x = 0; x < 4; ++x) {
      taps[static_cast<std::size_t>(x)] = continued(map, column - 1 + x, row - 1 + y) - mean;
    }
    acrossRows[static_cast<std::size_t>(y)] = bernstein(taps);
  }
  Square coefficients;
  for (std::size_t x = 0; x < 4; ++x) {
    const Four column4 = bernstein({acrossRows[0][x], acrossRows[1][x], acrossRows[2][x], acrossRows[3][x]});
    for (std::size_t y = 0; y < 4; ++y) coefficients[y][x] = column4[y];
  }
  return coefficients;
}

/// Derivative coefficients of a bicubic are differences of its own; each bounds the derivative by its hull.
void widen(PieceBound& bound, const Square& c, double intervals) {
  const auto raise = [](double& most, double value) { most = std::max(most, std::fabs(value)); };
  const double first = 3.0 * intervals, second = 6.0 * intervals * intervals;
  for (std::size_t y = 0; y < 4; ++y) {
    for (std::size_t x = 0; x < 4; ++x) {
      raise(bound.value, c[y][x]);
      if (x < 3) raise(bound.x, first * (c[y][x + 1] - c[y][x]));
      if (y < 3) raise(bound.y, first * (c[y + 1][x] - c[y][x]));
      if (x < 2) raise(bound.xx, second * (c[y][x + 2] - 2.0 * c[y][x + 1] + c[y][x]));
      if (y < 2) raise(bound.yy, second * (c[y + 2][x] - 2.0 * c[y + 1][x] + c[y][x]));
      if (x < 3 && y < 3)
        raise(bound.xy, first * first * (c[y + 1][x + 1] - c[y + 1][x] - c[y][x + 1] + c[y][x]));
    }
  }
}

/// Over all bicubic pieces the square touches; (t, s) across the map's own quarter, from its south-west end.
PieceBound pieceBound(ConstHeightView map, double mean, double t, double s, double side) {
  const int intervals = (map.columns() - 1) / 2;
  const auto firstPiece = [&](double place) { return static_cast<int>(std::floor(place * intervals)); };
  const auto lastPiece = [&](double place) {
    return std::min(-static_cast<int>(std::floor(-(place + side) * intervals)) - 1, 2 * intervals - 1);
  };
  PieceBound bound;
  for (int row = firstPiece(s); row <= std::max(firstPiece(s), lastPiece(s)); ++row) {
    for (int column = firstPiece(t); column <= std::max(firstPiece(t), lastPiece(t)); ++column) {
      widen(bound, pieceCoefficients(map, column, row, mean), intervals);
    }
  }
  return bound;
}

}  // namespace

double triangleError(const Layer& layer, const CellMaps& maps, double t, double s, double side) {
  const std::array<WeightBound, 2> columns = weightBounds(layer, t, std::min(1.0, t + side));
  const std::array<WeightBound, 2> rows = weightBounds(layer, s, std::min(1.0, s + side));
  double deviation = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t map = 0; map < 4; ++map) {
    const bool east = (map & 1) != 0, north = (map & 2) != 0;
    const WeightBound& u = columns[east ? 1 : 0];
    const WeightBound& v = rows[north ? 1 : 0];
    const PieceBound p = pieceBound(std::as_const(*maps[map]).view(), layer.range().mean,
                                    t + (east ? 0.0 : 1.0), s + (north ? 0.0 : 1.0), side);
    deviation += u.value * v.value * p.value;
    xx += v.value * (u.second * p.value + 2.0 * u.first * p.x + u.value * p.xx);
    yy += u.value * (v.second * p.value + 2.0 * v.first * p.y + v.value * p.yy);
    xy += u.first * v.first * p.value + u.first * v.value * p.y + u.value * v.first * p.x +
          u.value * v.value * p.xy;
  }
  return std::min((xx + 2.0 * xy + yy) * side * side / 8.0, 2.0 * deviation);
}

}  // namespace teren
