// Pictures of the experiments with sand, drawn by gnuplot.
#pragma once

#include <filesystem>
#include <functional>
#include <span>

#include "teren/Result.h"

#include "apps/teren/SandExperiment.h"

namespace teren {

/// Draws .svg files into a folder that is there: where there are several sizes of mesh,
/// time-by-vertices (each part of the longest trace's runs) and bytes-by-vertices (mesh and grid); where
/// there are several traces, time-by-trace (of the largest mesh). Each file appears whole or not at all.
Result<void> plotSand(const std::filesystem::path& folder, std::span<const SandRun> runs);

}  // namespace teren
