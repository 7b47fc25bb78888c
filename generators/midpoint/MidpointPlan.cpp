#include "generators/midpoint/MidpointPlan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>

#include "generators/midpoint/ClosedMap.h"
#include "generators/midpoint/LatticeCovariance.h"
#include "generators/numbers/Gaussian.h"
#include "generators/numbers/PowerOfTwo.h"

namespace teren {
namespace {

double largestOf(MidpointSource source) noexcept {
  if (source == MidpointSource::randR) return 1.0;
  return source == MidpointSource::randN ? 0.5 : Gaussian::kCut;
}

/// By how much the corrected rule aims beside fractional Brownian motion: factors of the mean squared
/// difference between a new point and the points it is made from. Of all pairs at a distance only some are
/// made together, and the others differ less (with small exponents, more); and a map's last stages have none
/// after them. Solved by fixed-point iteration on the exact covariances of a map of 65 x 65, so that the mean
/// squared differences over all pairs follow the power law along the axes and along the diagonals;
/// MidpointPlan_test computes these covariances and finds all slopes within 0.03 of hurst, 0.06 at 0.9.
/// Row: hurst = 0, 0.1 ... 1.
struct Aim {
  double centre, edge;
};
constexpr Aim kLast[11] = {{1.00, 1.00}, {0.85, 1.18}, {0.82, 1.18}, {0.85, 1.06}, {0.89, 0.94}, {0.93, 0.86},
                           {0.96, 0.83}, {1.01, 0.84}, {1.06, 0.90}, {1.10, 0.99}, {1.10, 0.99}};
constexpr Aim kLastButOne[11] = {{1.00, 1.00}, {0.62, 0.70}, {0.82, 0.82}, {0.99, 0.96},
                                 {1.09, 1.04}, {1.15, 1.08}, {1.19, 1.11}, {1.22, 1.14},
                                 {1.25, 1.17}, {1.21, 1.16}, {1.21, 1.16}};
constexpr Aim kOthers[11] = {{1.00, 1.00}, {0.69, 0.63}, {0.91, 0.86}, {1.03, 1.01},
                             {1.10, 1.09}, {1.16, 1.14}, {1.22, 1.18}, {1.27, 1.22},
                             {1.32, 1.25}, {1.29, 1.23}, {1.29, 1.23}};

Aim interpolated(const Aim (&table)[11], double hurst) noexcept {
  const int row = std::min(9, static_cast<int>(10.0 * hurst));
  const double t = 10.0 * hurst - row;
  return {table[row].centre + t * (table[row + 1].centre - table[row].centre),
          table[row].edge + t * (table[row + 1].edge - table[row].edge)};
}

/// The two first stages have few pairs, all of them made together.
Aim aimOf(double hurst, int stage, int stages) noexcept {
  if (stage < 2) return {1.0, 1.0};
  if (stage == stages - 1) return interpolated(kLast, hurst);
  return stage == stages - 2 ? interpolated(kLastButOne, hurst) : interpolated(kOthers, hurst);
}

/// Makes a plan for deviation 1 (corrected) or first displacement 1 (published).
class Planner {
 public:
  Planner(const MidpointSettings& settings, int stages) : settings_(settings), stages_(stages) {
    double all = 0.0;
    for (double weight : settings.corners) all += weight;
    for (std::size_t n = 0; n < 4; ++n) weights_[n] = all > 0.0 ? settings.corners[n] / all : 0.0;
    const double corner = midpointVariance(settings.centre);
    plan_.cornerMove = settings.published ? 1.0 : 1.0 / std::sqrt(corner);
    window_.at(0, 0) = settings.published ? corner : 1.0;
    for (int stage = 0; stage < stages; ++stage) {
      plan_.stages.push_back(settings.published ? publishedStage(stage) : correctedStage(stage));
    }
  }

  /// The plan, scaled to the deviation asked for.
  MidpointPlan scaled() const {
    MidpointPlan plan = plan_;
    const double factor = settings_.deviation / std::sqrt(meanVariance());
    plan.cornerMove *= factor;
    for (MidpointStage& stage : plan.stages) {
      stage.centreMove *= factor;
      for (double& move : stage.moves) move *= factor;
      for (double& move : stage.rimMoves) move *= factor;
    }
    for (double& error : plan.squaredErrors) error *= factor * factor;
    plan.aroundCentre *= factor * factor;
    plan.bound = boundOf(plan);
    return plan;
  }

 private:
  /// Covariance of points at the distance side * 2^(log2Square / 2), the side being the map's; deviation 1.
  /// Points half a side or more apart are independent: a map that had a level of its own would show as a
  /// square in the landscape, whose maps are blended over that distance.
  double wanted(double log2Square, double aim = 1.0) const noexcept {
    return std::max(0.0, 1.0 - aim * powerOfTwo(settings_.hurst * (log2Square + 2.0)));
  }

  /// Over all samples. In the corrected rule the variance is the same everywhere. In the published one a map
  /// varies more than an endless lattice knows, because on the rims there is no other centre and nothing else
  /// to be independent of; that shows from the first stages on and changes little in the later ones.
  double meanVariance() const {
    const double endless = window_.at(0, 0);
    if (!settings_.published) return endless;
    const int counted = std::min(stages_, kClosedStages);
    const double closed =
        meanVarianceOfMap(settings_, std::span(plan_.stages).first(static_cast<std::size_t>(counted)));
    return endless * closed / varianceWhenCounted_;
  }

  static void setMoves(MidpointStage& stage, const MidpointSettings& settings, double move, double rimMove) {
    const MidpointSource sources[] = {settings.south, settings.west, settings.north, settings.east};
    for (std::size_t n = 0; n < 4; ++n) {
      const double unit = settings.published ? 1.0 : 1.0 / std::sqrt(midpointVariance(sources[n]));
      stage.moves[n] = move * unit;
      stage.rimMoves[n] = rimMove * unit;
    }
  }

  MidpointStage publishedStage(int number) {
    const double move = powerOfTwo(-settings_.hurst * (number + 1));
    MidpointStage stage{.centre = weights_, .centreMove = move};
    stage.ends = stage.firstCentre = stage.rimEnds = stage.rimCentre = 1.0 / 3.0;
    setMoves(stage, settings_, move, move);
    const double edges = 0.5 * (midpointVariance(settings_.north) + midpointVariance(settings_.east));
    finish(stage, move * move * midpointVariance(settings_.centre), move * move * edges);
    return stage;
  }

  /// The mean of the parents is multiplied and the displacement chosen so that the new point has variance 1
  /// and, with its parents, the covariance `aim`: what both have if all heights together are Gaussian and
  /// the new one is drawn given its parents. Where that asks for a negative variance (hurst near 1), there
  /// is no displacement and the deviation is kept.
  struct Drawn {
    double factor, variance;
  };
  static Drawn drawn(double varianceOfMean, double aim) noexcept {
    if (varianceOfMean <= 0.0) return {0.0, 1.0};
    const double variance = 1.0 - aim * aim / varianceOfMean;
    if (variance < 0.0) return {1.0 / std::sqrt(varianceOfMean), 0.0};
    return {aim / varianceOfMean, variance};
  }

  MidpointStage correctedStage(int number) {
    const Aim aim = aimOf(settings_.hurst, number, stages_);
    MidpointStage stage{.centre = weights_};
    const Drawn centre = drawn(window_.varianceOfCentre(stage), wanted(-2.0 * number - 1.0, aim.centre));
    for (double& weight : stage.centre) weight *= centre.factor;
    stage.centreMove = std::sqrt(centre.variance / midpointVariance(settings_.centre));

    const double edgeAim = wanted(-2.0 * number - 2.0, aim.edge);
    stage.ends = stage.firstCentre = stage.secondCentre = 0.25;
    const Drawn edge = drawn(window_.varianceOfEdge(stage, centre.variance), edgeAim);
    stage.ends = stage.firstCentre = stage.secondCentre = 0.25 * edge.factor;

    const double rimVariance = setRim(stage, edgeAim);
    setMoves(stage, settings_, std::sqrt(edge.variance), std::sqrt(rimVariance));
    finish(stage, centre.variance, edge.variance);
    return stage;
  }

  /// An edge point on the rim: the covariance `aim` with both ends and, as far as a variance is left for its
  /// displacement, with the centre too, as inside. Returns that variance.
  double setRim(MidpointStage& stage, double aim) const noexcept {
    const double ends = window_.alongAxes(), withCentre = window_.centreWithCorners(stage);
    const double determinant = 1.0 + ends - 2.0 * withCentre * withCentre;
    if (determinant > 1e-6) {
      stage.rimEnds = aim * (1.0 - withCentre) / determinant;
      stage.rimCentre = aim - 2.0 * stage.rimEnds * withCentre;
      const double variance = 1.0 - aim * (2.0 * stage.rimEnds + stage.rimCentre);
      if (variance >= 0.0 && stage.rimCentre >= 0.0) return variance;
    }
    const Drawn rim = drawn((3.0 + 2.0 * ends + 4.0 * withCentre) / 9.0, aim);
    stage.rimEnds = stage.rimCentre = rim.factor / 3.0;
    return rim.variance;
  }

  void finish(const MidpointStage& stage, double centreVariance, double edgeVariance) {
    plan_.squaredErrors.push_back(window_.errorOfTriangles(stage, centreVariance, edgeVariance));
    if (plan_.stages.empty()) {
      plan_.aroundCentre = window_.edgeWithCentre(stage, centreVariance, edgeVariance);
    }
    window_ = window_.after(stage, centreVariance, edgeVariance);
    if (plan_.squaredErrors.size() <= kClosedStages) varianceWhenCounted_ = window_.at(0, 0);
  }

  /// What sources at their largest give; a thousandth more than any rounding.
  double boundOf(const MidpointPlan& plan) const {
    double bound = plan.cornerMove * largestOf(settings_.centre);
    const MidpointSource sources[] = {settings_.south, settings_.west, settings_.north, settings_.east};
    for (const MidpointStage& stage : plan.stages) {
      double centre = stage.centreMove * largestOf(settings_.centre);
      for (double weight : stage.centre) centre += weight * bound;
      const double inner = 2.0 * stage.ends * bound + (stage.firstCentre + stage.secondCentre) * centre;
      const double rim = 2.0 * stage.rimEnds * bound + stage.rimCentre * centre;
      bound = std::max(bound, centre);
      for (std::size_t n = 0; n < 4; ++n) {
        bound = std::max({bound, inner + stage.moves[n] * largestOf(sources[n]),
                          rim + stage.rimMoves[n] * largestOf(sources[n])});
      }
    }
    return 1.001 * bound;
  }

  static constexpr int kClosedStages = 4;

  const MidpointSettings& settings_;
  int stages_;
  double varianceWhenCounted_ = 0.0;  // on the endless lattice, after kClosedStages or all stages
  std::array<double, 4> weights_{};
  LatticeCovariance window_;
  MidpointPlan plan_;
};

}  // namespace

MidpointPlan midpointPlan(const MidpointSettings& settings, int stages) {
  assert(1 <= stages && stages <= kMostMidpointStages);
  assert(0.0 <= settings.hurst && settings.hurst <= 1.0);
  assert(std::isfinite(settings.deviation) && settings.deviation >= 0.0);
  return Planner(settings, stages).scaled();
}

}  // namespace teren
