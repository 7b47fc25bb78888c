// What the maps of every generator cost at every level, and what the coarser ones are off by.
#pragma once

#include <vector>

#include "teren/Generator.h"
#include "teren/PluginRegistry.h"
#include "teren/Result.h"

#include "apps/report/Effort.h"
#include "apps/report/Plot.h"
#include "apps/report/Table.h"

namespace teren {

/// What the maps of one level of a generator are.
struct LevelResidual {
  double promised = 0.0;       ///< [m] Generator::residual
  std::vector<double> ofMaps;  ///< [m] of each map: its root mean square
  double slope = 0.0;          ///< root mean square slope of the triangles, over all maps
};

/// [m] Over `maps` maps with 65 samples a side and a pitch of 64 m at their finest: the finest map minus the
/// triangles through the level's. An error: "interrupted", asked for after each map.
Result<LevelResidual> residualOf(const Generator& generator, int level, int maps, const GoOn& goOn);

/// Levels that have triangles.
inline constexpr int kResidualLevels = 6;

/// A row a generator of the registry and level 0 ... kResidualLevels - 1, with default parameters. An error:
/// "interrupted", or a generator that cannot be made.
Result<Table> measureGenerators(const PluginRegistry& registry, const Effort& effort, const GoOn& goOn);

std::vector<Plot> plotsOfGenerators(const Table& table);

}  // namespace teren
