#include "stream/Turn.h"

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>

namespace teren {

UnitVector turned(double turns) noexcept {
  if (!(std::fabs(turns) < 0x1p50)) return {};
  const double quarters = std::floor(4.0 * turns + 0.5);
  const double angle = (turns - 0.25 * quarters) * (2.0 * std::numbers::pi);  // |angle| <= pi / 4
  const double square = angle * angle;
  // Taylor's series; the first terms left out are below 5e-17 and 3e-18.
  double sine = -1.0 / 1307674368000.0;
  for (const double term :
       {1.0 / 6227020800.0, -1.0 / 39916800.0, 1.0 / 362880.0, -1.0 / 5040.0, 1.0 / 120.0, -1.0 / 6.0}) {
    sine = std::fma(sine, square, term);
  }
  sine = std::fma(sine * square, angle, angle);
  double cosine = 1.0 / 20922789888000.0;
  for (const double term : {-1.0 / 87178291200.0, 1.0 / 479001600.0, -1.0 / 3628800.0, 1.0 / 40320.0,
                            -1.0 / 720.0, 1.0 / 24.0, -0.5}) {
    cosine = std::fma(cosine, square, term);
  }
  cosine = std::fma(cosine, square, 1.0);
  switch (static_cast<std::int64_t>(quarters) & 3) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

}  // namespace teren
