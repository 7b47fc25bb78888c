// The shape of a simple impact crater: a bowl, a raised rim and a blanket of ejecta.
#pragma once

#include <array>
#include <cstdint>

namespace teren {

/// Height of the rim of fresh simple craters over the ground before, in parts of the depth of their floor
/// below it, 0.036 / (0.196 - 0.036): the rim is 0.036 diameters above the ground and 0.196 above the floor
/// (Pike 1977, Moon, below 15 km; his exponents 1.014 and 1.010 are taken for 1).
inline constexpr double kCraterRim = 0.225;

/// With r = distance / radius, h the rim's height and d the depth of the floor: inside, a paraboloid of
/// revolution, -d + (d + h) r^2; outside, ejecta that thin out as r^-3 (McGetchin, Settle and Head 1973),
/// lowered so that they end at r = kCraterBlanket: h (r^-3 - b) / (1 - b), b = kCraterBlanket^-3.
/// Structural uplift of the rim is counted as ejecta. Deviation: a seed varies the radius with the azimuth by
/// waves of 2 to 5 periods around, of at most `irregularity` parts, since no crater is a circle. Only sqrt
/// beyond additions, multiplications and divisions: the same bits everywhere.
class CraterShape {
 public:
  static constexpr double kCraterBlanket = 4.0;  ///< [radii] where the blanket ends
  static constexpr double kMostIrregular = 0.25;

  /// radius [m] > 0; depth [m], and where it is negative all is turned over: a mound with a moat; rim >= 0
  /// in parts of the depth; irregularity 0 ... kMostIrregular.
  CraterShape(double radius, double depth, double rim, double irregularity, std::uint64_t seed) noexcept;

  /// [m] from the middle where all of it has ended, whatever the seed.
  static double reach(double radius, double rim, double irregularity) noexcept {
    return (rim > 0.0 ? kCraterBlanket : 1.0) * (1.0 + irregularity) * radius;
  }

  /// What the crater adds to the ground [m] at an offset from its middle [m]. Between -depth and rim * depth
  /// (the other way round where the depth is negative).
  double height(double east, double north) const noexcept;

 private:
  static constexpr int kWaves = 4;  // of 2, 3, 4 and 5 periods
  struct Wave {
    double cosine = 0.0, sine = 0.0;
  };

  double radius_, depth_, rim_;
  std::array<Wave, kWaves> waves_;  // of the radius, in parts of it
};

}  // namespace teren
