#include "teren/Position.h"

#include <cmath>
#include <string>

#include "teren/Parameter.h"

namespace teren {

namespace {

struct Axis {
  std::int64_t index = 0;
  double fraction = 0.0;
};

/// Carries whole pitches from the fraction into the index. `index` is within +-2^53, so nothing overflows.
Result<Axis> carried(std::int64_t index, double fraction, const char* name) {
  const double whole = std::floor(fraction);
  if (!(std::fabs(whole) <= 2.0 * static_cast<double>(kMaxPatch))) {
    return Error{std::string(name) + " lies beyond the world, which ends at +-2^52 pitches"};
  }
  Axis axis{index + static_cast<std::int64_t>(whole), fraction - whole};
  if (axis.fraction >= 1.0) {  // a tiny negative fraction rounds up to one
    axis.fraction = 0.0;
    ++axis.index;
  }
  if (axis.index < -kMaxPatch || axis.index >= kMaxPatch) {
    return Error{std::string(name) + " lies beyond the world, which ends at +-2^52 pitches"};
  }
  return axis;
}

Result<Axis> axisFromMetres(double metres, double pitch, const char* name) {
  if (!std::isfinite(metres))
    return Error{std::string(name) + " is " + numberText(metres) + ", not a finite number"};
  const double whole = std::floor(metres / pitch);
  if (!(std::fabs(whole) <= static_cast<double>(kMaxPatch))) {
    return Error{std::string(name) + " = " + numberText(metres) +
                 " m lies beyond the world, which ends at +-2^52 pitches"};
  }
  // The remainder is exact (fma); metres / pitch may have rounded across a whole number: carried() mends it.
  return carried(static_cast<std::int64_t>(whole), std::fma(-whole, pitch, metres) / pitch, name);
}

}  // namespace

Result<Position> Position::fromMetres(double x, double y, double pitch) {
  const Result<Axis> east = axisFromMetres(x, pitch, "x");
  if (!east) return east.error();
  const Result<Axis> north = axisFromMetres(y, pitch, "y");
  if (!north) return north.error();
  return Position{east->index, north->index, east->fraction, north->fraction};
}

Result<Position> Position::movedBy(double dx, double dy, double pitch) const {
  const Result<Position> step = fromMetres(dx, dy, pitch);
  if (!step) return step.error();
  const Result<Axis> east = carried(i + step->i, u + step->u, "x");
  if (!east) return east.error();
  const Result<Axis> north = carried(j + step->j, v + step->v, "y");
  if (!north) return north.error();
  return Position{east->index, north->index, east->fraction, north->fraction};
}

Offset offset(const Position& from, const Position& to, double pitch) noexcept {
  return {(static_cast<double>(to.i - from.i) + (to.u - from.u)) * pitch,
          (static_cast<double>(to.j - from.j) + (to.v - from.v)) * pitch};
}

}  // namespace teren
