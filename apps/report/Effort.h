// How much is measured: a minute's worth, or as much as a report that is kept deserves.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace teren {

/// Asked between pieces of work of at most about a second; false: the work ends with an Error.
using GoOn = std::function<bool()>;

struct Effort {
  bool quick = false;
  std::size_t repetitions = 41;  ///< of each timing; of one, median, p99 and spread are told

  int blendingPatches = 64;  ///< patches along the side of the square that the kernels are looked at on
  int creasePlaces = 8;      ///< places on each lattice line of a patch
  int residualMaps = 128;    ///< maps of each generator and level
  std::size_t detailPlaces = 8000;  ///< places of each view, half by distance and half by area
  std::size_t placesAround = 16;    ///< points looked at in the patch of each
  std::vector<double> detailDistances{20'000, 14'000, 10'000, 7'000, 5'000, 3'500, 2'500, 1'750, 1'250, 875};
  std::size_t detailCap = std::size_t{512} << 20U;  ///< [bytes] as the engine has without being told
  double schedulingDistance = 10'000.0;             ///< [m]
  double schedulingPixelError = 4.0;                ///< [px]
  double schedulingSeconds = 20.0;                  ///< of flight
  int mostWorkers = 4;         ///< as many as there are processors, but no more than these
  int groundIntervals = 1024;  ///< along the side of the ground that is approximated

  static Effort full() { return {}; }
  static Effort ofAMinute();
};

}  // namespace teren
