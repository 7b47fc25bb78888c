#include "generators/numbers/Tangent.h"

#include <cassert>

namespace teren {
namespace {

/// Lambert's continued fraction x / (1 - x^2 / (3 - x^2 / (5 - ...))) for 0 <= x <= pi / 4, where ten terms
/// leave less than 1e-20.
double tangent(double x) noexcept {
  double fraction = 19.0;
  for (double odd = 17.0; odd >= 1.0; odd -= 2.0) fraction = odd - x * x / fraction;
  return x / fraction;
}

}  // namespace

double tangentOfDegrees(double angle) noexcept {
  assert(0.0 <= angle && angle < 90.0);
  constexpr double kRadians = 3.141592653589793 / 180.0;
  return angle <= 45.0 ? tangent(angle * kRadians) : 1.0 / tangent((90.0 - angle) * kRadians);
}

}  // namespace teren
