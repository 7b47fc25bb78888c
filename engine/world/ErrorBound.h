// How far the drawn triangles of a grid square can be from the landscape's function: a proved bound per
// layer.
#pragma once

#include "world/LayerSampler.h"

namespace teren {

/// preserveVariance turns a weight w into w / sqrt(w^2 + (1 - w)^2); bounds on the size of that function's
/// first and second derivative by w on [0, 1] (the extrema are 1.6166 at w = 0.3596 and -3.9508 at w =
/// 0.6282).
inline constexpr double kNormalisedFirst = 1.62, kNormalisedSecond = 4.0;

/// [m] A bound on |f - triangles| over a grid square, where f is the layer's part of law 0 and the triangles
/// join its values at the corners. (t, s) is the square's south-west corner across the lattice cell whose
/// maps are given, `side` its side, in pitches of the layer; the square must not cross the cell's border.
///
/// Linear interpolation over a right triangle with legs h errs by at most h^2/8 (|f_xx| + 2 |f_xy| + |f_yy|).
/// Since the weights factor, f = mean + sum_ij u_i(x) u_j(y) (H_ij(x, y) - mean), the derivatives follow from
/// bounds on the kernels (exact extrema over the square) and on the bicubic pieces (Bernstein coefficients).
/// Where the layer is much finer than the grid a smaller bound holds: both surfaces lie within the same
/// deviation from the mean, so they differ by at most twice that. Never below the true error; in the standard
/// world about 9 times it in the median.
/// Cost: a few microseconds.
double triangleError(const Layer& layer, const CellMaps& maps, double t, double s, double side);

}  // namespace teren
