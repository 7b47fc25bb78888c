// What midpoint displacement does at every stage of a map: weights and displacements, solved once for all
// maps from the covariances that the stages before leave behind.
#pragma once

#include <array>
#include <vector>

namespace teren {

/// Where a point's random displacement comes from. Published names and ranges; randN is centred again,
/// because its mean would imprint the lattice on the land.
enum class MidpointSource {
  randR,  ///< uniform in (-1, 1)
  randN,  ///< uniform in [0, 1), minus 1/2
  randG,  ///< Gaussian, cut at 4 deviations
};

constexpr double midpointVariance(MidpointSource source) noexcept {
  if (source == MidpointSource::randR) return 1.0 / 3.0;
  return source == MidpointSource::randN ? 1.0 / 12.0 : 1.0;
}

/// A generator's settings. `rule`: published as in the thesis, corrected as in MidpointDisplacement.h.
struct MidpointSettings {
  double hurst = 0.8;      ///< 0 ... 1; greater is smoother
  double deviation = 4.0;  ///< [m] standard deviation of the result, >= 0
  bool published = false;
  std::array<double, 4> corners{1.0, 1.0, 1.0, 1.0};  ///< 0 ... 1, south-west, south-east, north-west, -east
  MidpointSource centre = MidpointSource::randG;
  MidpointSource south = MidpointSource::randG;
  MidpointSource west = MidpointSource::randG;
  MidpointSource north = MidpointSource::randG;
  MidpointSource east = MidpointSource::randG;
};

/// How one stage halves the squares. Every displacement is a number of its source times a `move` [m].
struct MidpointStage {
  std::array<double, 4> centre{};  ///< weights of a square's corners, in the order of MidpointSettings
  double centreMove = 0.0;
  /// An edge point between two squares: weight of both ends, of the centre in the south or west, and of the
  /// one in the north or east.
  double ends = 0.0, firstCentre = 0.0, secondCentre = 0.0;
  double rimEnds = 0.0, rimCentre = 0.0;  ///< an edge point on the map's rim, with one centre
  std::array<double, 4> moves{};          ///< of edge points by source: south, west, north, east
  std::array<double, 4> rimMoves{};       ///< likewise, on the rim
};

/// The stages of a map of 2^stages.size() intervals a side.
struct MidpointPlan {
  double cornerMove = 0.0;  ///< of each corner, times a number of the centres' source
  std::vector<MidpointStage> stages;
  double bound = 0.0;                 ///< [m] no height is further from 0
  std::vector<double> squaredErrors;  ///< [m^2] by stage: new points minus triangles through the old ones
  double aroundCentre = 0.0;          ///< [m^2] mean squared difference of the first edge points and centre
};

inline constexpr int kMostMidpointStages = 12;

/// The plan for maps of so many stages, 1 ... kMostMidpointStages. Under a millisecond.
MidpointPlan midpointPlan(const MidpointSettings& settings, int stages);

}  // namespace teren
