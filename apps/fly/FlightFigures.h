// The figures of the flight as the head-up display words them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "teren/Object.h"
#include "teren/PixelError.h"

namespace teren {

/// Where something flies and how fast.
struct FlightFigures {
  Position position = {};
  double pitch = 64.0;                           ///< [m] of the world
  double height = 0.0;                           ///< [m]
  std::optional<double> heightAboveGround = {};  ///< [m]
  double speed = 0.0;                            ///< [m/s]
  double heading = 0.0;                          ///< [rad]
};

/// What it costs the program.
struct CostFigures {
  double frameMilliseconds = 0.0;
  double engineMilliseconds = 0.0;
  std::size_t nodes = 0, triangles = 0, bytes = 0;
  std::size_t pending = 0;  ///< nodes still to be made
  PixelError pixelError = {};
};

/// One line per figure. Metres are exact to the digit shown as far out as the world goes; the patch and the
/// offset in it say the same place without any rounding.
std::vector<DisplayLine> flightLines(const FlightFigures& figures);
std::vector<DisplayLine> costLines(const CostFigures& figures);

/// "12 345.6", with a thin grouping that can be read in flight; `decimals` 0 ... 3.
std::string groupedNumber(long double value, int decimals);

}  // namespace teren
