// Heights as a net of triangles in text: .obj for modelling programs, .iv for Open Inventor.
#pragma once

#include <cstdint>
#include <cstdio>

#include "teren/HeightMap.h"
#include "teren/Result.h"

#include "apps/files/RowWriter.h"

namespace teren {

/// Where a rectangle of heights lies in its world: its south-west sample is the south-west corner of a patch.
struct GroundPlace {
  std::int64_t i = 0, j = 0;  ///< the patch
  double pitch = 64.0;        ///< [m] of the world
  double spacing = 2.0;       ///< [m] between the heights
};

/// Vertices in metres east and north of the south-west corner and above zero, z up; the corner's place in the
/// world stands in a comment. Every quad is split by its south-west to north-east diagonal and seen
/// anticlockwise from above, as the engine draws it. A vertex's normal is the central difference of its
/// neighbours' heights, one-sided at the rim, to four decimals. Heights have as many digits as give the same
/// float32 back when read (-0 as 0). At least 2 x 2 heights (assert), all finite. Memory: one row of text.
/// Errors: the disk's, or "interrupted".
Result<void> writeObj(ConstHeightView heights, const GroundPlace& place, std::FILE* stream,
                      const RowProgress& progress);
/// The same as one Separator that SoDB::readAll reads, of indexed triangle strips, one a row of quads.
Result<void> writeInventor(ConstHeightView heights, const GroundPlace& place, std::FILE* stream,
                           const RowProgress& progress);

}  // namespace teren
