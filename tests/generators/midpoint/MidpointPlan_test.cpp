// The table of aims in MidpointPlan.cpp has no formula: here its maps' second moments are computed exactly,
// without a random number, and compared with the power law they were solved for.
#include "generators/midpoint/MidpointPlan.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace teren {
namespace {

constexpr int kStages = 6;
constexpr int kLast = 1 << kStages;  // the map has 65 x 65 points
constexpr int kSide = kLast + 1;
constexpr std::size_t kPoints = static_cast<std::size_t>(kSide) * kSide;

/// Every height of a map as a linear combination of independent numbers of variance 1, one a point.
class LinearMap {
 public:
  explicit LinearMap(const MidpointPlan& plan) : coefficients_(kPoints * kPoints) {
    for (int y : {0, kLast}) {
      for (int x : {0, kLast}) own(x, y) = plan.cornerMove;
    }
    for (int number = 0; number < kStages; ++number) {
      const MidpointStage& stage = plan.stages[static_cast<std::size_t>(number)];
      const int h = kLast >> (number + 1);
      for (int y = h; y < kSide; y += 2 * h) {
        for (int x = h; x < kSide; x += 2 * h) makeCentre(stage, x, y, h);
      }
      for (int y = 0; y < kSide; y += h) {
        for (int x = (y / h) % 2 == 0 ? h : 0; x < kSide; x += 2 * h) makeEdge(stage, x, y, h);
      }
    }
  }

  /// Mean squared difference of two heights (dx, dy) apart.
  double meanSquaredDifference(int dx, int dy) const {
    double sum = 0.0;
    for (int y = 0; y + dy < kSide; ++y) {
      for (int x = 0; x + dx < kSide; ++x) sum += squaredDifference(row(x, y), row(x + dx, y + dy));
    }
    return sum / (static_cast<double>(kSide - dx) * (kSide - dy));
  }

 private:
  static std::size_t point(int x, int y) { return static_cast<std::size_t>(y) * kSide + x; }
  const double* row(int x, int y) const { return &coefficients_[point(x, y) * kPoints]; }
  double& own(int x, int y) { return coefficients_[point(x, y) * kPoints + point(x, y)]; }

  void add(int x, int y, double weight, int fromX, int fromY) {
    double* to = &coefficients_[point(x, y) * kPoints];
    const double* from = row(fromX, fromY);
    for (std::size_t n = 0; n < kPoints; ++n) to[n] += weight * from[n];
  }

  void makeCentre(const MidpointStage& stage, int x, int y, int h) {
    for (int corner = 0; corner < 4; ++corner) {
      add(x, y, stage.centre[static_cast<std::size_t>(corner)], (corner & 1) != 0 ? x + h : x - h,
          (corner & 2) != 0 ? y + h : y - h);
    }
    own(x, y) = stage.centreMove;
  }

  /// An edge point lies on a row of squares' corners, between two of them, or on a column of them.
  void makeEdge(const MidpointStage& stage, int x, int y, int h) {
    const bool alongRow = (x / h) % 2 != 0;
    const int endX = alongRow ? h : 0, endY = h - endX;
    const int across = alongRow ? y : x;
    const bool rim = across == 0 || across == kLast;
    for (int side : {-1, 1}) {
      add(x, y, rim ? stage.rimEnds : stage.ends, x + side * endX, y + side * endY);
      const int place = across + side * h;
      if (place < 0 || place > kLast) continue;
      const double inner = side < 0 ? stage.firstCentre : stage.secondCentre;
      add(x, y, rim ? stage.rimCentre : inner, x + side * endY, y + side * endX);
    }
    const std::size_t source = (alongRow ? 0 : 1) + (across == 0 ? 0 : 2);
    own(x, y) = rim ? stage.rimMoves[source] : stage.moves[source];
  }

  static double squaredDifference(const double* a, const double* b) {
    double sum = 0.0;
    for (std::size_t n = 0; n < kPoints; ++n) sum += (a[n] - b[n]) * (a[n] - b[n]);
    return sum;
  }

  std::vector<double> coefficients_;
};

MidpointPlan planOf(double hurst) {
  MidpointSettings settings;
  settings.hurst = hurst;
  settings.deviation = 1.0;
  return midpointPlan(settings, kStages);
}

class MidpointAim : public testing::TestWithParam<double> {};

TEST_P(MidpointAim, GivesThePowerLawExactlyAlongAxesAndDiagonals) {
  const double hurst = GetParam();
  const LinearMap map(planOf(hurst));
  double before = 0.0, worst = 0.0, worstAcross = 0.0;
  // Lags up to an eighth of the side: half a side apart, heights are independent, as they shall be.
  for (int lag = 1; lag <= kLast / 8; lag *= 2) {
    const double along = 0.5 * (map.meanSquaredDifference(lag, 0) + map.meanSquaredDifference(0, lag));
    const double across = map.meanSquaredDifference(lag, lag);
    if (before > 0.0) worst = std::max(worst, std::fabs(0.5 * std::log2(along / before) - hurst));
    worstAcross = std::max(worstAcross, std::fabs(0.5 * std::log2(across / along) - 0.5 * hurst));
    before = along;
  }
  RecordProperty("worst_slope", std::to_string(worst));
  RecordProperty("worst_diagonal", std::to_string(worstAcross));
  const double bound = hurst < 0.85 ? 0.03 : 0.06;
  EXPECT_LT(worst, bound);
  EXPECT_LT(worstAcross, bound);
}

INSTANTIATE_TEST_SUITE_P(Rows, MidpointAim, testing::Values(0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9));

}  // namespace
}  // namespace teren
