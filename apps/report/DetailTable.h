// What a view to the horizon costs at each pixel error, and how wrong it is.
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

/// Has the world's node errors measured, as an engine does when it has nothing else to do: once a world.
Result<void> calibrate(const std::shared_ptr<const World>& world, const GoOn& goOn);

/// A row a pixel error, of a standing eye 100 m above the ground near the world's zero; each in a new engine
/// without workers, at the largest of the distances of `effort` at which the cap still holds it, and once
/// more at the usual distance where that is nearer. The world should be calibrated.
Result<Table> measureDetail(const std::shared_ptr<const World>& world, std::span<const double> pixelErrors,
                            const Effort& effort, const GoOn& goOn);

std::vector<Plot> plotsOfDetail(const Table& table);

}  // namespace teren
