// The slope of the triangles through a map's samples.
#pragma once

#include "teren/HeightMap.h"

namespace teren {

/// The root mean square, over the area of a map's square on the ground, of the slope of its triangles (two a
/// square, split from south-west to north-east), whose samples are `spacing` [m] apart. At least 2 x 2
/// samples (assert).
double slopeOfTriangles(ConstHeightView heights, double spacing);

}  // namespace teren
