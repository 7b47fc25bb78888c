// The covariances of midpoint displacement on an endless lattice, carried exactly from stage to stage: what
// the plan of a map is solved with.
#pragma once

#include <array>
#include <cstddef>

#include "generators/midpoint/MidpointPlan.h"

namespace teren {

/// Covariances of two points of a stage's lattice by their distance in intervals, averaged over all places.
/// A stage is linear in the heights it finds and does the same everywhere, so the averages before it decide
/// the averages after it. A window of distances up to 3 is enough, because two points at a distance of 3
/// after a stage depend on points at most 3 of the twice as long intervals apart before it. Rims are not
/// seen: what that costs shows in the deviation by point, which tests/generators/midpoint bounds.
class LatticeCovariance {
 public:
  static constexpr int kReach = 3;

  double& at(int x, int y) noexcept { return values_[index(x, y)]; }
  double at(int x, int y) const noexcept { return values_[index(x, y)]; }

  /// Averages over the two axes and over the two diagonals.
  double alongAxes() const noexcept { return 0.5 * (at(1, 0) + at(0, 1)); }
  double alongDiagonals() const noexcept { return 0.5 * (at(1, 1) + at(1, -1)); }

  /// Variance of the centre's weighted mean, without its displacement.
  double varianceOfCentre(const MidpointStage& stage) const noexcept;
  /// Covariance of a centre with its corners, the average of the four.
  double centreWithCorners(const MidpointStage& stage) const noexcept;
  /// Variance of an edge point's weighted mean, without its displacement, the average of the two
  /// directions; centreVariance is what the centres' displacements add to their own variance.
  double varianceOfEdge(const MidpointStage& stage, double centreVariance) const noexcept;

  /// Mean squared differences between the points a stage makes and the triangles through the points it finds,
  /// quads split from south-west to north-east; points that stay count as 0.
  double errorOfTriangles(const MidpointStage& stage, double centreVariance,
                          double edgeVariance) const noexcept;
  /// Mean squared difference of an edge point and a centre it is made from.
  double edgeWithCentre(const MidpointStage& stage, double centreVariance,
                        double edgeVariance) const noexcept;

  /// The window after a stage. The variances are those of the displacements.
  LatticeCovariance after(const MidpointStage& stage, double centreVariance,
                          double edgeVariance) const noexcept;

 private:
  static constexpr int kSide = 2 * kReach + 1;
  static constexpr std::size_t index(int x, int y) noexcept {
    return static_cast<std::size_t>((y + kReach) * kSide + x + kReach);
  }
  std::array<double, static_cast<std::size_t>(kSide) * kSide> values_{};
};

}  // namespace teren
