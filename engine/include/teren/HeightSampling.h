// Heights between the samples of a height map, normals at them, and maps of another size.
//
// Places are counted in samples from the south-west one, x to the east and y to the north; a place outside
// the rectangle is taken to be the nearest on its rim. Along an axis of one sample nothing changes. At a
// sample every kind of sampling gives that sample's height exactly. The answer is NaN for a place that is NaN
// and for an empty rectangle; a height that is not finite may spoil the answers at places up to one sample
// away from it (bicubic: two). All cost O(1) and allocate nothing unless they say otherwise; any thread may
// call them.
#pragma once

#include <array>

#include "teren/HeightMap.h"

namespace teren {

/// Every sampled height lies within this, times the largest size of the heights it is made of, of exact
/// arithmetic; `resample` adds the rounding to float.
inline constexpr double kSamplingError = 0x1p-46;

/// The drawn surface: two flat triangles a square, split from south-west to north-east. Continuous.
double triangleHeight(ConstHeightView heights, double x, double y) noexcept;

/// Weighted by distance along both axes. Continuous, beyond the four heights around only by rounding, creased
/// along the lines of samples.
double bilinearHeight(ConstHeightView heights, double x, double y) noexcept;

/// The landscape's own interpolant between the samples of a base map: Catmull-Rom splines (Keys 1981,
/// a = -1/2), continued linearly beyond the rims. Its slope is continuous; it overshoots by at most 9/32 of
/// the range of the sixteen heights around.
double bicubicHeight(ConstHeightView heights, double x, double y) noexcept;

enum class Interpolation { triangles, bilinear, bicubic };

/// Fills `target` with heights of `source`, corner on corner: target sample k of an axis of m samples lies at
/// k (s - 1) / (m - 1) of the source's s; the only sample of an axis of one lies in the middle. From 2^k + 1
/// samples to fewer this is exactly every 2^l-th sample: nothing is averaged, so what is finer than the
/// target's spacing is not smoothed away (filter the map before where that is unwanted). O(samples of the
/// target), allocates O(its columns). An empty target stays so; an empty source makes it NaN; both must not
/// overlap (assert).
void resample(ConstHeightView source, HeightView target, Interpolation interpolation);

/// Every component of `normalAt` lies within this of exact arithmetic.
inline constexpr double kNormalError = 0x1p-49;

/// The unit normal (east, north, up) at a sample, `spacing` > 0 [m] from its neighbours: of the slopes of
/// central differences, as drawn meshes have them, on the rim of the difference to the one neighbour. Samples
/// outside are a broken contract (assert). NaN if a neighbour is.
std::array<double, 3> normalAt(ConstHeightView heights, int column, int row, double spacing) noexcept;

}  // namespace teren
