// Binary logarithms, the same bits on every processor: what log and log2 of the C library do not promise
// (law 1).
#pragma once

namespace teren {

/// The largest error of binaryLogarithm, as a part of the larger of 1 and the size of the result.
inline constexpr double kBinaryLogarithmError = 4e-16;

/// log2 x; exact where x is a power of two. x: a normal positive number; anything else (NaN too) is a broken
/// contract. Only additions, multiplications and divisions; about 10 ns.
double binaryLogarithm(double x) noexcept;

}  // namespace teren
