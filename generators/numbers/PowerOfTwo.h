// Powers of two with any real exponent, the same bits on every processor: what pow and exp2 of the C library
// do not promise (law 1).
#pragma once

namespace teren {

/// The largest relative error of powerOfTwo: twice the rounding error of a double.
inline constexpr double kPowerOfTwoError = 2.3e-16;

/// 2^x, within kPowerOfTwoError of the true value; exact where x is a whole number. x: -1022 ... 1023,
/// anything else (NaN too) is a broken contract. Only additions, multiplications and floor; about 10 ns.
double powerOfTwo(double x) noexcept;

}  // namespace teren
