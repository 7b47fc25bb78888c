// Where the eye of a TerrainWidget is and where it looks.
#pragma once

#include "teren/Position.h"
#include "teren/Result.h"

namespace teren {

/// The eye stays at its height above the ground that is drawn, or above the water where that is higher.
struct Viewer {
  Position position;
  double heightAboveGround = 100.0;  ///< [m] kLowest ... kHighest
  double heading = 0.0;              ///< [rad] clockwise from north; finite
  double pitch = -0.2;               ///< [rad] upwards, -pi/2 ... pi/2

  static constexpr double kLowest = 0.5, kHighest = 1e5;  // [m]

  friend bool operator==(const Viewer&, const Viewer&) = default;
};

/// Errors name the member, its value and what was expected.
Result<void> check(const Viewer& viewer);

}  // namespace teren
