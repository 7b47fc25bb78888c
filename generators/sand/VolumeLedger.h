// What the surface owes: the part of a volume that whole ticks could not express yet.
#pragma once

#include "generators/sand/Ticks.h"

namespace teren {

/// One exact account for a whole surface. Whoever changes heights or triangles enters what that took from the
/// surface; volume + owed() is the same number for ever. Slides round so that the account stays next to zero:
/// after any number of them |owed| is at most half the largest weight moved, if it was so before. So drift
/// never accumulates: it is owed(), exactly.
class VolumeLedger {
 public:
  /// What the surface has too little; negative where it has too much [ticks steps^2, sixfold].
  SixfoldVolume owed() const noexcept { return owed_; }
  /// The surface's volume changed by this much.
  void enter(SixfoldVolume change) noexcept { owed_ -= change; }

  /// How many ticks a vertex of this weight should rise so that, with the change of `others` beside it, the
  /// account comes as near to zero as whole ticks allow, at most one tick from what balances `others` alone.
  std::int64_t balance(SixfoldVolume others, std::int64_t weight) const noexcept {
    const WideInteger lower = dividedDown(-others, weight);
    const WideInteger afterLower = owed_ - others - lower * weight;
    const WideInteger afterUpper = afterLower - weight;
    const bool up = (afterUpper < 0 ? -afterUpper : afterUpper) < (afterLower < 0 ? -afterLower : afterLower);
    return static_cast<std::int64_t>(up ? lower + 1 : lower);
  }

 private:
  SixfoldVolume owed_ = 0;
};

}  // namespace teren
