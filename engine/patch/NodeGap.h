// Distances between the drawn surfaces of nodes of different levels, and what a node's own samples say of
// them.
#pragma once

#include "teren/HeightMap.h"

namespace teren {

/// Which part of a node a finer node covers: the (column, row)-th of 2^down x 2^down, from the south-west.
struct NodePart {
  int down = 1;
  int column = 0, row = 0;
};

/// [m] The largest vertical distance between the triangles of a node and those of a node `part.down` levels
/// finer that covers a part of it; both (n + 1) x (n + 1) samples. Squares of all levels are split from
/// south-west to north-east, so every triangle of the finer node lies within one of the coarser, their
/// difference is linear there, and its largest value is at a sample of the finer node: this is the maximum
/// over the surface, exact but for rounding (of the order of 1e-16 of the heights). O(n^2), about 5 ns a
/// sample.
double largestGap(ConstHeightView coarse, ConstHeightView fine, const NodePart& part) noexcept;

/// [m] The largest second difference |a - 2 b + c| of three neighbouring samples along a row, a column or
/// the diagonal that squares are split by. Where the land is smooth at a node's spacing an eighth of it is
/// the node's error; where it is rough, nodes of a level differ little. 0 where there are fewer than three
/// samples. O(n^2), about 2 ns a sample.
double largestBend(ConstHeightView heights) noexcept;

}  // namespace teren
