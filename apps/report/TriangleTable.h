// How many triangles the same ground takes at the same measured error: a uniform grid, chosen nodes, and a
// greedy triangulation.
#pragma once

#include <cstddef>
#include <vector>

#include "teren/HeightMap.h"
#include "teren/Result.h"
#include "teren/World.h"

#include "apps/report/Effort.h"
#include "apps/report/Plot.h"
#include "apps/report/Table.h"

namespace teren {

/// [m] The largest vertical distance between the triangles through every 2^level-th sample's place, whose
/// heights are `coarse`, and the finest samples `finest` of a part of both: the square of `side` finest
/// intervals whose south-west sample is (column, row). All numbers are multiples of 2^level. Exact for the
/// triangles of both, as the finer ones lie within the coarser.
double largestGap(ConstHeightView finest, ConstHeightView coarse, int level, int column, int row, int side);

/// The fewest nodes of a quadtree of which none has an error above `most` [m]: triangles, and the largest
/// error among the nodes taken. Levels 0 ... coarse.size() - 1; coarse[L] has every 2^L-th place of
/// coarse[0], and a node of level L has `intervals` of its own a side. Seams are counted as if nodes of
/// different levels met without triangles of their own.
struct NodeCut {
  std::size_t nodes = 0, triangles = 0;
  double error = 0.0;
};
NodeCut coarsestCut(const std::vector<HeightMap>& coarse, int intervals, double most);

/// A row for the error of each coarser uniform grid, for some between those and some below them.
Result<Table> measureTriangles(const World& world, const Effort& effort, const GoOn& goOn);

std::vector<Plot> plotsOfTriangles(const Table& table);

}  // namespace teren
