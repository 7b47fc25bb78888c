// The two blending kernels of law 3, one axis at a time: the weights of the four base maps that meet over a
// lattice cell are the products of one pair per axis.
#pragma once

#include "teren/World.h"

namespace teren {

/// Weights of the lower and the upper lattice point's map at a place between them.
struct AxisWeights {
  double low = 1.0, high = 0.0;
  /// low^2 + high^2. The sum of the four squared weights is the product of both axes' squares.
  double squares() const noexcept { return low * low + high * high; }
};

/// The four products of two pairs are >= 0 and sum to 1 within this much: the pairs themselves sum exactly.
inline constexpr double kPartitionError = 4 * 0x1p-52;

/// The quintic 6 t^5 - 15 t^4 + 10 t^3 (Perlin 2002): 0 at 0, 1/2 at 1/2, first and second derivative 0 at 0.
inline double quintic(double t) noexcept {
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

/// The pair at t in [0, 1], exactly (1, 0) at 0 and (0, 1) at 1, both >= 0, low + high == 1 exactly, and
/// mirrored bit for bit: the pair at 1 - t is the pair at t swapped, wherever 1 - t is exact.
/// `linear`: as published, a tent a axis (thesis A, 2005). `smooth`: the quintic, computed on [0, 1/2] and
/// completed by 1 - w, so that nothing is lost to cancellation near 1.
inline AxisWeights blendWeights(BlendKernel kernel, double t) noexcept {
  const bool nearLow = t <= 0.5;
  const double distance = nearLow ? t : 1.0 - t;  // exact: 1 - t for t in [1/2, 1] is (Sterbenz)
  const double far = kernel == BlendKernel::smooth ? quintic(distance) : distance;
  const double near = 1.0 - far;
  return nearLow ? AxisWeights{near, far} : AxisWeights{far, near};
}

}  // namespace teren
