#include "generators/midpoint/LatticeCovariance.h"

namespace teren {
namespace {

struct Tap {
  int x = 0, y = 0;
  double weight = 0.0;
};

/// A point of the lattice after a stage as a sum of points before it and of centres' displacements.
struct Sum {
  std::array<Tap, 14> points;
  std::array<Tap, 3> centres;  // displacement of the square whose south-west corner this is
  int pointCount = 0, centreCount = 0;

  void addPoint(int x, int y, double weight) noexcept {
    points[static_cast<std::size_t>(pointCount++)] = {x, y, weight};
  }
  void addCentre(int x, int y, double weight, const MidpointStage& stage) noexcept {
    centres[static_cast<std::size_t>(centreCount++)] = {x, y, weight};
    for (int corner = 0; corner < 4; ++corner) {
      addPoint(x + corner % 2, y + corner / 2, weight * stage.centre[static_cast<std::size_t>(corner)]);
    }
  }
};

Sum oldPoint() noexcept {
  Sum sum;
  sum.addPoint(0, 0, 1.0);
  return sum;
}

Sum centre(const MidpointStage& stage) noexcept {
  Sum sum;
  sum.addCentre(0, 0, 1.0, stage);
  return sum;
}

/// The edge point east of the point (0, 0), or north of it.
Sum edge(const MidpointStage& stage, bool east) noexcept {
  Sum sum;
  sum.addPoint(0, 0, stage.ends);
  sum.addPoint(east ? 1 : 0, east ? 0 : 1, stage.ends);
  sum.addCentre(east ? 0 : -1, east ? -1 : 0, stage.firstCentre, stage);
  sum.addCentre(0, 0, stage.secondCentre, stage);
  return sum;
}

/// Covariance of the sum a with the sum b moved by (x, y).
double covariance(const LatticeCovariance& window, double centreVariance, const Sum& a, const Sum& b, int x,
                  int y) noexcept {
  double result = 0.0;
  for (int i = 0; i < a.pointCount; ++i) {
    const Tap& p = a.points[static_cast<std::size_t>(i)];
    for (int j = 0; j < b.pointCount; ++j) {
      const Tap& q = b.points[static_cast<std::size_t>(j)];
      result += p.weight * q.weight * window.at(q.x + x - p.x, q.y + y - p.y);
    }
  }
  for (int i = 0; i < a.centreCount; ++i) {
    const Tap& p = a.centres[static_cast<std::size_t>(i)];
    for (int j = 0; j < b.centreCount; ++j) {
      const Tap& q = b.centres[static_cast<std::size_t>(j)];
      if (p.x == q.x + x && p.y == q.y + y) result += p.weight * q.weight * centreVariance;
    }
  }
  return result;
}

/// Half of n, rounded down.
constexpr int half(int n) noexcept {
  return n >= 0 ? n / 2 : -((1 - n) / 2);
}

}  // namespace

double LatticeCovariance::varianceOfCentre(const MidpointStage& stage) const noexcept {
  return covariance(*this, 0.0, centre(stage), centre(stage), 0, 0);
}

double LatticeCovariance::centreWithCorners(const MidpointStage& stage) const noexcept {
  double sum = 0.0;
  for (int corner = 0; corner < 4; ++corner) {
    sum += covariance(*this, 0.0, centre(stage), oldPoint(), corner % 2, corner / 2);
  }
  return sum / 4.0;
}

double LatticeCovariance::varianceOfEdge(const MidpointStage& stage, double centreVariance) const noexcept {
  double sum = 0.0;
  for (const bool east : {false, true}) {
    sum += covariance(*this, centreVariance, edge(stage, east), edge(stage, east), 0, 0);
  }
  return sum / 2.0;
}

double LatticeCovariance::errorOfTriangles(const MidpointStage& stage, double centreVariance,
                                           double edgeVariance) const noexcept {
  Sum errors[] = {centre(stage), edge(stage, true), edge(stage, false)};
  const Tap ends[] = {{1, 1, -0.5}, {1, 0, -0.5}, {0, 1, -0.5}};
  double sum = 2.0 * edgeVariance;
  for (int n = 0; n < 3; ++n) {
    errors[n].addPoint(0, 0, -0.5);
    errors[n].addPoint(ends[n].x, ends[n].y, -0.5);
    sum += covariance(*this, centreVariance, errors[n], errors[n], 0, 0);
  }
  return sum / 4.0;
}

double LatticeCovariance::edgeWithCentre(const MidpointStage& stage, double centreVariance,
                                         double edgeVariance) const noexcept {
  double sum = 2.0 * edgeVariance;
  for (const bool east : {false, true}) {
    Sum difference = edge(stage, east);
    difference.addCentre(east ? 0 : -1, east ? -1 : 0, -1.0, stage);
    sum += covariance(*this, centreVariance, difference, difference, 0, 0);
  }
  return sum / 2.0;
}

LatticeCovariance LatticeCovariance::after(const MidpointStage& stage, double centreVariance,
                                           double edgeVariance) const noexcept {
  // By the parity of its column, then of its row.
  const Sum kinds[2][2] = {{oldPoint(), edge(stage, false)}, {edge(stage, true), centre(stage)}};
  LatticeCovariance result;
  for (int y = -kReach; y <= kReach; ++y) {
    for (int x = -kReach; x <= kReach; ++x) {
      double sum = 0.0;
      for (int column = 0; column < 2; ++column) {
        for (int row = 0; row < 2; ++row) {
          sum += covariance(*this, centreVariance, kinds[column][row], kinds[(column + x) & 1][(row + y) & 1],
                            half(column + x), half(row + y));
        }
      }
      if (x == 0 && y == 0) sum += 2.0 * edgeVariance;
      result.at(x, y) = sum / 4.0;
    }
  }
  return result;
}

}  // namespace teren
