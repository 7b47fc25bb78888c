// How much is measured: a minute's worth, or as much as a report that is kept deserves.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "teren/Engine.h"

namespace teren {

/// Asked between pieces of work of at most about a second; false: the work ends with an Error.
using GoOn = std::function<bool()>;

/// Of 99 values or fewer the 99th percentile by nearest rank is the largest. Odd, so that the median is one
/// of them.
inline constexpr int kLeastForP99 = 101;

struct Effort {
  bool quick = false;
  std::size_t repetitions = 201;  ///< of each timing; of one, median, p99 and spread are told

  int blendingPatches = 64;  ///< patches along the side of the square that the kernels are looked at on
  int creasePlaces = 8;      ///< places on each lattice line of a patch
  int residualMaps = 256;    ///< maps of each generator and level
  std::size_t detailPlaces = 8000;  ///< places of each view, half by distance and half by area
  std::size_t placesAround = 16;    ///< points looked at in the patch of each
  std::vector<double> detailDistances{20'000, 14'000, 10'000, 7'000, 5'000, 3'500, 2'500, 1'750, 1'250, 875};
  double usualDistance =
      DetailSettings{}.distance;  ///< [m] where every view that reaches farther is looked at, too
  std::size_t detailCap = EngineOptions{}.capBytes;           ///< [bytes]
  double schedulingDistance = DetailSettings{}.distance;      ///< [m]
  double schedulingPixelError = DetailSettings{}.pixelError;  ///< [px]
  double schedulingSeconds = 20.0;                            ///< of flight
  int mostWorkers = 4;         ///< as many as there are processors, but no more than these
  int meshedNodes = 4;         ///< along the side of the square of nodes that is triangulated, of each level
  int groundIntervals = 1024;  ///< along the side of the ground that is approximated

  static Effort full() { return {}; }
  static Effort ofAMinute();
};

}  // namespace teren
