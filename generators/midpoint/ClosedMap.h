// The exact variances of a whole small map, rims and corners included, which an endless lattice does not see.
#pragma once

#include <span>

#include "generators/midpoint/MidpointPlan.h"

namespace teren {

/// Mean over all samples of the variance of a map of the published rule, made by these stages (a few: work
/// and memory grow as 16^stages, 0.2 ms for 4). The moves are of sources as they are; corners have move 1.
double meanVarianceOfMap(const MidpointSettings& settings, std::span<const MidpointStage> stages);

}  // namespace teren
