// What the engine gets done in a frame's budget, with and without workers.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "teren/Result.h"
#include "teren/World.h"

#include "apps/report/Effort.h"
#include "apps/report/Plot.h"
#include "apps/report/Table.h"

namespace teren {

/// A row a number of workers (0 ... n) and a budget [ms]: first a standing eye's view is filled from nothing,
/// then it flies at 300 m/s; updates are 1/60 s each. The world should be calibrated.
Result<Table> measureScheduling(const std::shared_ptr<const World>& world, std::span<const double> budgets,
                                const Effort& effort, const GoOn& goOn);

std::vector<Plot> plotsOfScheduling(const Table& table);

}  // namespace teren
