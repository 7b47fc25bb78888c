#include "teren/Position.h"

#include <cmath>
#include <optional>
#include <string>

#include "teren/Parameter.h"

namespace teren {

namespace {

struct Axis {
  std::int64_t index = 0;
  double fraction = 0.0;
};

/// Carries whole pitches from the fraction into the index; nothing where the place lies beyond the world.
/// `index` is within +-2^53, so nothing overflows.
std::optional<Axis> carried(std::int64_t index, double fraction) {
  const double whole = std::floor(fraction);
  if (!(std::fabs(whole) <= 2.0 * static_cast<double>(kMaxPatch))) return std::nullopt;
  Axis axis{index + static_cast<std::int64_t>(whole), fraction - whole};
  if (axis.fraction >= 1.0) {  // a tiny negative fraction rounds up to one
    axis.fraction = 0.0;
    ++axis.index;
  }
  if (axis.index < -kMaxPatch || axis.index >= kMaxPatch) return std::nullopt;
  return axis;
}

std::optional<Axis> axisFromMetres(double metres, double pitch) {
  const double whole = std::floor(metres / pitch);
  if (!(std::fabs(whole) <= static_cast<double>(kMaxPatch))) return std::nullopt;  // NaN and infinity too
  // The remainder is exact (fma); metres / pitch may have rounded across a whole number: carried() mends it.
  return carried(static_cast<std::int64_t>(whole), std::fma(-whole, pitch, metres) / pitch);
}

Error notInTheWorld(const char* name, double metres, const char* doing) {
  const std::string value = std::string(name) + " = " + numberText(metres) + " m";
  if (!std::isfinite(metres)) return {value + " is not finite"};
  return {value + doing + " beyond the world, which ends at +-2^52 pitches"};
}

bool validAxis(std::int64_t index, double fraction) noexcept {
  return index >= -kMaxPatch && index < kMaxPatch && fraction >= 0.0 && fraction < 1.0;  // false for NaN
}

}  // namespace

bool Position::valid() const noexcept {
  return validAxis(i, u) && validAxis(j, v);
}

Result<Position> Position::fromMetres(double x, double y, double pitch) {
  const std::optional<Axis> east = axisFromMetres(x, pitch), north = axisFromMetres(y, pitch);
  if (!east) return notInTheWorld("x", x, " lies");
  if (!north) return notInTheWorld("y", y, " lies");
  return Position{east->index, north->index, east->fraction, north->fraction};
}

Result<Position> Position::movedBy(double dx, double dy, double pitch) const {
  if (!valid()) return Error{"the position to move from is not in the world"};
  const Result<Position> step = fromMetres(dx, dy, pitch);
  if (!step) return step.error();
  const std::optional<Axis> east = carried(i + step->i, u + step->u),
                            north = carried(j + step->j, v + step->v);
  if (!east) return notInTheWorld("x", dx, " leads");
  if (!north) return notInTheWorld("y", dy, " leads");
  return Position{east->index, north->index, east->fraction, north->fraction};
}

Offset offset(const Position& from, const Position& to, double pitch) noexcept {
  return {(static_cast<double>(to.i - from.i) + (to.u - from.u)) * pitch,
          (static_cast<double>(to.j - from.j) + (to.v - from.v)) * pitch};
}

}  // namespace teren
