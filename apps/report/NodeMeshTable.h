// What a view takes if its nodes are the regular grids that are drawn, and if they were error-bounded meshes
// of finer data, at the same pixel error.
#pragma once

#include <span>
#include <vector>

#include "teren/HeightMap.h"
#include "teren/Result.h"
#include "teren/World.h"

#include "apps/report/Effort.h"
#include "apps/report/Plot.h"
#include "apps/report/Table.h"

namespace teren {

/// How nodes are made into triangles.
struct NodeWay {
  /// The level's own samples, two triangles between each four, as the engine draws them.
  bool regular = true;
  /// Else greedy insertion into a Delaunay triangulation, with all of the border's samples for vertices so
  /// that neighbours of the level meet without a crack, of data so many levels finer (of level 0 at most) ...
  int finer = 0;
  /// ... until none of those is farther than this share of the level's mean regular error.
  double tolerance = 0.0;
};
/// Of level 0 a node is regular in every way: it is what errors are measured against.
std::vector<NodeWay> nodeWays();

/// What the nodes of one level come to, the means over some of them.
struct NodeFigures {
  double error = 0.0;  ///< [m] largest distance from the samples kTruthLevels finer (of level 0 at most)
  double triangles = 0.0, bytes = 0.0;
  double samplesTime = 0.0, meshingTime = 0.0;  ///< [s]
};
inline constexpr int kTruthLevels = 4;

/// By way and level. Error: "interrupted".
Result<std::vector<std::vector<NodeFigures>>> measureNodes(const World& world, std::span<const NodeWay> ways,
                                                           const Effort& effort, const GoOn& goOn);

/// A row for each pixel error and way: a view of kFlownDistance, flown over at 300 m/s, with `budget` [ms]
/// for each of 60 updates a second.
Result<Table> measureNodeMeshes(const World& world, std::span<const double> pixelErrors, double budget,
                                const Effort& effort, const GoOn& goOn);
inline constexpr double kFlownDistance = 20'000.0;  ///< [m]

std::vector<Plot> plotsOfNodeMeshes(const Table& table);

}  // namespace teren
