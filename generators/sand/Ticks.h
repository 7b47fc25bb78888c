// The units of sand: heights as whole ticks, volumes as whole numbers, so that none is ever lost.
#pragma once

#include <cassert>
#include <cmath>
#include <cstdint>

#include "generators/tin/LatticePoint.h"

namespace teren {

/// A height or a thickness is a whole number of ticks of 2^-38 m (4 picometres). Within +-2^52 ticks (16 km)
/// doubles hold it exactly.
inline constexpr double kTicksPerMetre = 0x1p38;
inline constexpr double kMetresPerTick = 0x1p-38;
inline constexpr std::int64_t kHighestTick = std::int64_t{1} << 52;

/// Loose material this thin (1 micrometre) counts as none: a vertex that bears no more cannot fall.
inline constexpr std::int64_t kBareTicks = std::int64_t{1} << 18;

/// The tick nearest to a height [m], halves upwards; what lies beyond +-16384 m becomes that, NaN becomes 0.
inline std::int64_t ticksFromMetres(double metres) noexcept {
  const double ticks = metres * kTicksPerMetre;
  if (!(ticks > static_cast<double>(-kHighestTick))) return ticks == ticks ? -kHighestTick : 0;
  if (ticks >= static_cast<double>(kHighestTick)) return kHighestTick;
  return static_cast<std::int64_t>(std::floor(ticks + 0.5));
}
constexpr double metresFromTicks(std::int64_t ticks) noexcept {
  return static_cast<double>(ticks) * kMetresPerTick;
}

/// Six times a volume [ticks steps^2]: the sum over all triangles of twice the area times the sum of the
/// three heights. With 28 bits a coordinate it stays below 2^112.
using SixfoldVolume = WideInteger;

/// A wide integer as a double, rounded to nearest.
constexpr double asDouble(WideInteger number) noexcept {
  const std::int64_t narrow = static_cast<std::int64_t>(number);
  return narrow == number ? static_cast<double>(narrow) : static_cast<double>(number);
}

/// number / divisor rounded down; divisor > 0.
constexpr WideInteger dividedDown(WideInteger number, WideInteger divisor) noexcept {
  const WideInteger quotient = number / divisor;
  return quotient * divisor > number ? quotient - 1 : quotient;
}

/// A number of ticks by which a height is to change. What lies beyond +-2^53 becomes that: no height within
/// its range can change by more.
constexpr std::int64_t asTicks(WideInteger number) noexcept {
  constexpr std::int64_t kMost = 2 * kHighestTick;
  return number < -kMost ? -kMost : number > kMost ? kMost : static_cast<std::int64_t>(number);
}

}  // namespace teren
