// After how many steps a task that is still not done counts as broken.
#pragma once

#include <algorithm>
#include <cstdint>

namespace teren {

/// How many steps a generator or filter may take for a rectangle of samples: 10,240 for each row (or column,
/// where those are more), 64 for each sample, and never fewer than 32,768. Counted, not timed: the landscape
/// must not depend on the machine's speed. Every plugin of Teren, at its dearest settings and in slices that
/// are over before they begin, needs less than a tenth of it: thermal erosion 1,000 steps a row, a matrix of
/// 31 x 31 in 100 passes 6 to 11 a sample, faults 2,048 for a single sample. A task that is never done is
/// found out after 10^6 steps for 65 samples a side and 8 * 10^7 for 1025.
constexpr std::int64_t stepLimit(int columns, int rows) noexcept {
  const std::int64_t samples = std::int64_t{columns} * rows;
  return std::max<std::int64_t>(32768, 10240 * std::int64_t{std::max(columns, rows)} + 64 * samples);
}

}  // namespace teren
