#include "generators/crater/CraterShape.h"

#include <cmath>
#include <utility>

#include "teren/Hash.h"

#include "generators/numbers/RandomNumber.h"

namespace teren {

/// Each wave's size is at most sqrt 2 / (2 kWaves) of the irregularity, so all together 0.71 of it.
CraterShape::CraterShape(double radius, double depth, double rim, double irregularity,
                         std::uint64_t seed) noexcept
    : radius_(radius), depth_(depth), rim_(rim * depth) {
  RandomSequence random(seed);
  for (Wave& wave : waves_) {
    wave.cosine = irregularity / (2 * kWaves) * uniformAroundZero(random.next());
    wave.sine = irregularity / (2 * kWaves) * uniformAroundZero(random.next());
  }
}

double CraterShape::height(double east, double north) const noexcept {
  const double distance = std::sqrt(east * east + north * north);
  if (distance == 0.0) return -depth_;
  // Cosine and sine of the azimuth's multiples, each from the two before (Chebyshev).
  const double cosine = east / distance, sine = north / distance;
  double lowerCosine = 1.0, lowerSine = 0.0, turnedCosine = cosine, turnedSine = sine;
  double part = 1.0;
  for (const Wave& wave : waves_) {
    lowerCosine = std::exchange(turnedCosine, 2.0 * cosine * turnedCosine - lowerCosine);
    lowerSine = std::exchange(turnedSine, 2.0 * cosine * turnedSine - lowerSine);
    part += wave.cosine * turnedCosine + wave.sine * turnedSine;
  }
  const double r = distance / (radius_ * part);
  if (r <= 1.0) return -depth_ + (depth_ + rim_) * (r * r);
  if (r >= kCraterBlanket || rim_ == 0.0) return 0.0;
  constexpr double kEnd = 1.0 / (kCraterBlanket * kCraterBlanket * kCraterBlanket);
  return rim_ * ((1.0 / (r * r * r) - kEnd) / (1.0 - kEnd));
}

}  // namespace teren
