// From a height grid to the few triangles that follow it within a promised error, and back.
#pragma once

#include "teren/HeightMap.h"
#include "teren/Result.h"

#include "generators/tin/Triangulation.h"

namespace teren {

/// Which samples on a grid's border become vertices: as few as the error allows, or all of them, so that
/// meshes of neighbouring grids meet without a crack.
enum class GridBorder { asNeeded, all };

/// Triangles through some of a grid's samples that lie nowhere farther than maxError [m] from any sample,
/// vertically: greedy insertion (Garland, Heckbert 1995) with the data-independent Delaunay triangulation. It
/// begins with the grid's corners, or all of its border, and adds the sample that is worst, until none is
/// worse than maxError.
///
/// Sample (c, r) lies at the lattice point (c s, r s); s = frame.width / (columns - 1) = frame.height / (rows
/// - 1) must be a power of two, so that grids of one world share their lattice. The error holds for the
/// surface in exact arithmetic; a maxError below 2^-48 of the largest height means that much. Heights at
/// vertices are the samples.
///
/// An error: a grid of fewer than 2 x 2 or more than 32769 samples a side, a height that is not finite, a
/// maxError that is negative or not finite, a frame that does not fit. Expected time O((n + m) log m) for n
/// samples and m vertices; memory beside the mesh: 32 bytes a vertex or less, and a queue of 8 bytes a
/// triangle waiting in it.
Result<Triangulation> approximateGrid(ConstHeightView grid, const LatticeFrame& frame, double maxError,
                                      GridBorder border = GridBorder::asNeeded);

/// The surface's heights at the places of a grid's samples, as above, rounded to float once. The sides must
/// fit as above (assert). O(samples).
void sampleGrid(const Triangulation& mesh, HeightView out);

/// The largest vertical distance [m] between a mesh and a grid's samples. O(samples).
double worstErrorAtSamples(const Triangulation& mesh, ConstHeightView grid);

}  // namespace teren
