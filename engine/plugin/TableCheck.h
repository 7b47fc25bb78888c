// Checks a plugin's parameter table before anything relies on it.
#pragma once

#include <span>

#include "teren/Parameter.h"
#include "teren/Result.h"

namespace teren {

/// More parameters than this are taken for a mistake.
inline constexpr std::size_t kMostParameters = 1000;

/// Refuses empty, odd or repeated names (letters, digits, '-', '_'; a letter first), unknown types, ranges
/// that are empty or not finite, integers that are not whole or beyond +-2^53, choices without choices, and
/// defaults outside their range. The sentence names the parameter and the value.
Result<void> checkTable(std::span<const Parameter> table);

}  // namespace teren
