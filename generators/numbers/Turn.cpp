#include "generators/numbers/Turn.h"

#include <cassert>
#include <cmath>

namespace teren {
namespace {

/// Taylor's series, enough for |x| <= pi / 4: the terms left out are below 5e-17 and 3e-18.
double sineOf(double x) noexcept {
  const double y = x * x;
  double sum = -1.0 / 1307674368000.0;
  sum = sum * y + 1.0 / 6227020800.0;
  sum = sum * y - 1.0 / 39916800.0;
  sum = sum * y + 1.0 / 362880.0;
  sum = sum * y - 1.0 / 5040.0;
  sum = sum * y + 1.0 / 120.0;
  sum = sum * y - 1.0 / 6.0;
  return x + x * (y * sum);
}

double cosineOf(double x) noexcept {
  const double y = x * x;
  double sum = 1.0 / 20922789888000.0;
  sum = sum * y - 1.0 / 87178291200.0;
  sum = sum * y + 1.0 / 479001600.0;
  sum = sum * y - 1.0 / 3628800.0;
  sum = sum * y + 1.0 / 40320.0;
  sum = sum * y - 1.0 / 720.0;
  sum = sum * y + 1.0 / 24.0;
  return (1.0 - 0.5 * y) + y * y * sum;
}

}  // namespace

SineCosine sineCosineOfTurn(double turns) noexcept {
  assert(std::fabs(turns) <= 0x1p51);
  constexpr double kTwoPi = 6.283185307179586;
  const double size = std::fabs(turns);
  const double quarters = std::floor(4.0 * size);
  double rest = size - 0.25 * quarters;  // [0, 1/4), exact
  const bool reflected = rest > 0.125;
  if (reflected) rest = 0.25 - rest;  // exact
  double sine = sineOf(kTwoPi * rest), cosine = cosineOf(kTwoPi * rest);
  if (rest == 0.125) cosine = sine;
  double s = reflected ? cosine : sine;
  double c = reflected ? sine : cosine;
  switch (static_cast<int>(quarters - 4.0 * std::floor(0.25 * quarters))) {
    case 1:
      sine = c, cosine = 0.0 - s;
      break;
    case 2:
      sine = 0.0 - s, cosine = 0.0 - c;
      break;
    case 3:
      sine = 0.0 - c, cosine = s;
      break;
    default:
      sine = s, cosine = c;
  }
  return {turns < 0.0 ? 0.0 - sine : sine, cosine};
}

}  // namespace teren
