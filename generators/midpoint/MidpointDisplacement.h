// Midpoint displacement (diamond-square): ground made by halving squares, each new point the mean of its
// neighbours moved by a random height that falls from stage to stage.
#pragma once

#include <array>
#include <memory>

#include "teren/Generator.h"

#include "generators/midpoint/MidpointPlan.h"

namespace teren {

/// Two rules.
///
/// Published (theses of Brno 2005 and 2008): corners are random, stage i = 0, 1 ... makes of every square its
/// centre, the weighted mean of the four corners, and its edge points (A + B + E) / 3 with the centre E of
/// one square (the southern, the western), each moved by its source times d 2^(-H (i + 1)); d is such that
/// the deviation over the finest map is the one asked for. Its roughness is biased: asked for H = 0.2, 0.5,
/// 0.8 it gives about 0.24, 0.44, 0.69. Its deviation differs with the place: at H = 0.8 it is 1.31 times the
/// one asked for at the corners, 1.12 in the middles of the rims, and at least 0.89.
///
/// Corrected (the default). An edge point uses both neighbouring centres (on the rim the only one), so no
/// square sees its own border. A new point is c times the (weighted) mean of its parents plus a displacement,
/// c and its variance chosen at every stage so that the point has the deviation asked for and the wanted
/// covariance with its parents (as in conditionalised random midpoint displacement: Norros, Mannersalo, Wang
/// 1999, for lines); all other covariances are carried exactly from stage to stage (LatticeCovariance.h).
/// The mean squared difference of two heights at distance r then follows r^(2H), at all powers of two, along
/// axes and diagonals, and the deviation is the same at every point within 2 % (at hurst = 1 within 3.5 %).
/// Points half a map's side apart are independent. Above hurst = 0.9 displacements would need negative
/// variances: they are left out, and the deviation is kept; how rough the ground is there is not promised.
///
/// Corner weights all equal are the plain mean; other weights stretch the land along a diagonal and keep the
/// deviation over the map, but at single points it differs (by 10 % where one corner in four counts nothing).
/// Corners all 0: centres are random alone. In the corrected rule every source is scaled to variance 1, so
/// randR and randN give the same law there. An inner edge point takes its source from the square in the south
/// (its north) or in the west (its east); south and west hold on the map's rims only.
///
/// A coarse level is the first stages of the same map: cost side^2, about 2 ns a sample. A task asks whether
/// its slice is over after every row of new points, at most 5 us at a side of 1025. Immutable; any number of
/// tasks may run at once, on any threads.
class MidpointDisplacement {
 public:
  explicit MidpointDisplacement(const MidpointSettings& settings);

  const MidpointSettings& settings() const noexcept { return settings_; }
  /// The plan of maps whose finest level has 2^stages intervals a side; stages: 1 ... kMostMidpointStages.
  const MidpointPlan& plan(int stages) const noexcept;
  /// How many stages the finest map of a request has.
  static int stagesOf(const MapRequest& request) noexcept;

  /// Mean 0, the deviation asked for, and bounds that hold for every seed: all sources at their largest.
  HeightRange range() const noexcept;

  /// Generator::residual, derived in the source file. Within a factor 1.5 of what is measured while the level
  /// has 3 samples a side or more; beyond, it only says how far the map lies from its centre.
  double residual(int level, int samples) const noexcept;

  /// Begins a map; Generator::begin. The finest map has at most 2^kMostMidpointStages + 1 samples a side.
  /// The task never allocates.
  std::unique_ptr<SlicedTask> begin(const MapRequest& request, HeightView out) const;

 private:
  MidpointSettings settings_;
  std::array<MidpointPlan, kMostMidpointStages> plans_;
};

}  // namespace teren
