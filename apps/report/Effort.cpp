#include "apps/report/Effort.h"

namespace teren {

Effort Effort::ofAMinute() {
  Effort effort;
  effort.quick = true;
  effort.repetitions = 11;
  effort.blendingPatches = 24;
  effort.creasePlaces = 4;
  effort.residualMaps = 16;
  effort.detailPlaces = 800;
  effort.detailCap = std::size_t{256} << 20U;
  effort.schedulingDistance = 3'000.0;
  effort.schedulingPixelError = 4.0;
  effort.schedulingSeconds = 3.0;
  effort.mostWorkers = 1;
  effort.groundIntervals = 512;
  return effort;
}

}  // namespace teren
