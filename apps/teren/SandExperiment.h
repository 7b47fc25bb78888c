// The published experiment with sand: a groove along the diagonal of a square metre, on meshes of any size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "teren/Result.h"

#include "generators/sand/Stamper.h"

namespace teren {

struct SandExperiment {
  int vertices = 1000;           // 4 ... 4,000,000
  double trace = 80.0;           // [%] of the diagonal that the tool can travel, 5 ... 100
  double radius = 0.04;          // [m] of the tool, 0.005 ... 0.2
  double depth = 0.1;            // [m] 0.001 ... 1
  int points = 12;               // of its outline, 3 ... 256
  double repose = 30.0;          // [degree] 1 ... 60
  std::uint64_t steps = 20'000;  // of slides after each stamp
  bool grid = true;              // the same on a regular grid beside it
};

/// One line of the table. Times are the calling thread's processor time.
struct SandResult {
  int stamps = 0;
  StampTimes stampTimes;                                     // [s] sums
  double slideTime = 0.0, cleanTime = 0.0;                   // [s] sums
  double medianIteration = 0.0;                              // [s]
  std::size_t mostVertices = 0;                              // at any time between two iterations
  std::size_t vertices = 0, triangles = 0, constraints = 0;  // afterwards
  std::uint64_t removedByTool = 0, removedByCleanUp = 0, divided = 0;
  std::uint64_t slideSteps = 0, sweeps = 0;
  bool atRest = false;
  double moved = 0.0;                                // [m^3] raised by stamps, slides and settling
  double drift = 0.0;                                // of that, lost
  std::size_t bytes = 0;                             // afterwards; never fewer than before
  int gridSide = 0;                                  // 0: no grid
  double gridTime = 0.0, gridMedianIteration = 0.0;  // [s]
  std::size_t gridBytes = 0;
};

/// Random points (the seed is the number of vertices) in level sand a metre deep; stamps half a radius apart
/// along the diagonal. The grid is as fine as the finest of the mesh: the thickness of the tool's walls, or
/// the distance of as many vertices spread evenly, whichever is less.
/// Stops early, with an error, where `interrupted` says so, which is asked every few milliseconds once the
/// mesh stands (1 us a vertex) and never changes what is computed.
Result<SandResult> runSandExperiment(const SandExperiment& experiment,
                                     const std::function<bool()>& interrupted);

/// An experiment and what came of it.
struct SandRun {
  SandExperiment experiment;
  SandResult result;
};

/// A table: a line of names, then a line a run; comma-separated, every line ended.
std::string sandTable(std::span<const SandRun> runs);

}  // namespace teren
