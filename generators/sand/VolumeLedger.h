// What the surface owes: the part of a volume that whole ticks could not express yet.
#pragma once

#include "generators/sand/Ticks.h"

namespace teren {

/// One exact account for a whole surface. Whoever changes heights or triangles enters what that took from the
/// surface; volume + owed() is the same number for ever.
///
/// Part of what is owed is due: what operations changed that are still to be paid for. The rest is what whole
/// ticks could not express, an old debt. Everything is paid by vertices that round so that the account comes
/// next to zero, but at most one tick from what their own change asks for: old debts of huge faces never move
/// a tiny one far. So while nothing is due |owed| is at most half the largest weight that has ever rounded,
/// and drift never accumulates: it is owed(), exactly.
class VolumeLedger {
 public:
  /// What the surface has too little; negative where it has too much [ticks steps^2, sixfold].
  SixfoldVolume owed() const noexcept { return owed_; }
  /// Of that, what is to be paid next.
  SixfoldVolume due() const noexcept { return due_; }
  /// The surface's volume changed by this much, and has been balanced as far as ticks allow.
  void enter(SixfoldVolume change) noexcept { owed_ -= change; }
  /// The surface's volume changed by this much, which is to be paid for.
  void enterDue(SixfoldVolume change) noexcept {
    owed_ -= change;
    due_ -= change;
  }
  /// Nothing is due any more: what is left is an old debt.
  void settled() noexcept { due_ = 0; }

  /// How many ticks a vertex of this weight should rise so that, with the change of `others` beside it, which
  /// is not entered yet, the account comes as near to zero as whole ticks allow, at most one tick from what
  /// balances `others` alone.
  std::int64_t balance(SixfoldVolume others, std::int64_t weight) const noexcept {
    return nearest(-others, owed_ - others, weight);
  }
  /// The same for what is due.
  std::int64_t payment(std::int64_t weight) const noexcept { return nearest(due_, owed_, weight); }

 private:
  static std::int64_t nearest(SixfoldVolume wanted, SixfoldVolume owed, std::int64_t weight) noexcept {
    const WideInteger lower = dividedDown(wanted, weight);
    const WideInteger afterLower = owed - lower * weight;
    const WideInteger afterUpper = afterLower - weight;
    const bool up = (afterUpper < 0 ? -afterUpper : afterUpper) < (afterLower < 0 ? -afterLower : afterLower);
    return asTicks(up ? lower + 1 : lower);
  }

  SixfoldVolume owed_ = 0;
  SixfoldVolume due_ = 0;
};

}  // namespace teren
