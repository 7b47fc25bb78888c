// Directions from angles without libm: the same bits on every machine.
#pragma once

namespace teren {

/// The point of the unit circle at an angle.
struct UnitVector {
  double cosine = 1.0, sine = 0.0;
};

/// Cosine and sine of 2 pi `turns`; exact at whole quarters. Both within kTurnedError of the true values, the
/// sine of angles below an eighth of a turn relatively so. Beyond 2^50 turns, and of NaN, it is (1, 0).
UnitVector turned(double turns) noexcept;
inline constexpr double kTurnedError = 6e-16;

}  // namespace teren
