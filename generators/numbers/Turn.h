// Sine and cosine of angles in turns, the same bits on every processor: what sin and cos of the C library do
// not promise (law 1).
#pragma once

namespace teren {

struct SineCosine {
  double sine = 0.0, cosine = 1.0;
};

/// The largest absolute error of sineCosineOfTurn.
inline constexpr double kTurnError = 2.3e-16;

/// Sine and cosine of 2 pi `turns`, each within kTurnError of the true value. |turns| <= 2^51; anything else
/// (NaN too) is a broken contract. The symmetries are exact: a change of sign, a quarter turn and an eighth
/// (where sine and cosine change places) change no bit of the sizes, and whole quarters give 0 and +-1. Only
/// additions, multiplications and floor; about 6 ns.
SineCosine sineCosineOfTurn(double turns) noexcept;

}  // namespace teren
