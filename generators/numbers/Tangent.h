// The tangent without a C library, whose last bits depend on the processor (law 1).
#pragma once

namespace teren {

/// How far tangentOfDegrees may lie from the tangent, in parts of it.
inline constexpr double kTangentError = 4e-15;

/// The tangent of an angle [degree], 0 <= angle < 90.
double tangentOfDegrees(double angle) noexcept;

}  // namespace teren
