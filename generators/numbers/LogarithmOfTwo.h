// Logarithms to base two, the same bits on every processor (law 1): the inverse of powerOfTwo.
#pragma once

namespace teren {

/// The largest error of logarithmOfTwo, absolute for |log2 x| <= 1 and relative beyond.
inline constexpr double kLogarithmOfTwoError = 4.5e-16;

/// log2(x), within kLogarithmOfTwoError; exact where x is a power of two. x: normal, positive and finite,
/// anything else is a broken contract. Only additions, multiplications and two divisions.
double logarithmOfTwo(double x) noexcept;

}  // namespace teren
