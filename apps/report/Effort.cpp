#include "apps/report/Effort.h"

namespace teren {

Effort Effort::ofAMinute() {
  Effort effort;
  effort.quick = true;
  effort.repetitions = kLeastForP99;
  effort.blendingPatches = 24;
  effort.creasePlaces = 4;
  effort.residualMaps = kLeastForP99;
  effort.detailPlaces = 800;
  effort.schedulingSeconds = 3.0;
  effort.mostWorkers = 1;
  effort.meshedNodes = 1;
  effort.groundIntervals = 512;
  return effort;
}

}  // namespace teren
