// Random places around an eye with their level-0 heights, and how far drawn ground is from those.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "teren/PixelError.h"
#include "teren/Position.h"
#include "teren/Result.h"
#include "teren/SceneQuery.h"
#include "teren/World.h"

#include "apps/report/Effort.h"

namespace teren {

/// Half of the places are spread evenly over the logarithm of their distance, as a picture from low above the
/// ground spreads it, from kNearestPlace on; the other half evenly over the ground within the distance.
struct GroundSample {
  double distance = 0.0;         ///< [m] of the farthest place
  std::vector<Position> places;  ///< those by distance first
  std::vector<double> heights;   ///< [m] of the level-0 triangles
  std::size_t byDistance = 0;    ///< how many are the first
};
inline constexpr double kNearestPlace = 10.0;  ///< [m]

/// `places` patches are chosen, and `around` places in each. The same for the same numbers. Error:
/// "interrupted".
Result<GroundSample> sampleGround(const World& world, const Position& centre, double distance,
                                  std::size_t places, std::size_t around, const GoOn& goOn);

/// How far the ground that is drawn for an eye is from the sample, at the places where ground is drawn.
struct SurfaceErrors {
  std::vector<double> metres;  ///< [m] at places by area
  std::vector<double> pixels;  ///< [px] at places by distance: |difference| / distance from the eye * lens
  double maxMetres = 0.0, maxPixels = 0.0;  ///< at all places
  std::size_t places = 0;                   ///< with ground
  std::size_t finest = 0;         ///< of these, where level 0 is drawn, on its way to level 1 or not
  std::size_t beyondPromise = 0;  ///< places whose error is more than DrawnPoint::error says
};
/// As `eye` sees it: vertices are where the scene's Morph moves them for its distance.
SurfaceErrors errorsOf(const SceneQuery& query, const GroundSample& sample, const Eye& eye, double pitch);

}  // namespace teren
