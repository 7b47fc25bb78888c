// What blending costs and what it does to the land, of each kernel.
#pragma once

#include <span>

#include "teren/PluginRegistry.h"
#include "teren/Result.h"

#include "apps/report/Effort.h"
#include "apps/report/Plot.h"
#include "apps/report/Table.h"

namespace teren {

/// A row a generator and a kernel with and without preserved variance; the second table has the places.
struct BlendingFigures {
  Table table, places;
};

/// Worlds of one layer each: 64 m, 65 samples, default parameters, of those of `generators` that the registry
/// has. An error: "interrupted", or a world that cannot be made.
Result<BlendingFigures> measureBlending(const PluginRegistry& registry,
                                        std::span<const char* const> generators, const Effort& effort,
                                        const GoOn& goOn);

std::vector<Plot> plotsOfBlending(const BlendingFigures& figures);

}  // namespace teren
