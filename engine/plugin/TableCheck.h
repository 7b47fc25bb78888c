// Checks a plugin's parameter table before anything relies on it.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "teren/Parameter.h"
#include "teren/Result.h"

namespace teren {

/// More parameters than this are taken for a mistake.
inline constexpr std::size_t kMostParameters = 1000;
/// More choices of one parameter, too.
inline constexpr std::size_t kMostChoices = 100;
/// The longest name, unit or choice, and the longest line of documentation.
inline constexpr std::size_t kNameBytes = 64, kDocBytes = 400;

/// No parameter's text may be longer.
inline constexpr double kMostTextBytes = 65536.0;

/// At most maxBytes, none of them a control character.
bool isPlainText(std::string_view text, double maxBytes) noexcept;

/// Refuses null pointers that claim a length, names, units and documentation that are not one readable line,
/// empty, odd or repeated names (letters, digits, '-', '_'; a letter first), unknown types, ranges that are
/// empty or not finite, integers that are not whole or beyond +-2^53, choices without choices, texts that may
/// be nothing or without end, and defaults outside their range. The sentence names the parameter and the
/// value.
Result<void> checkTable(std::span<const Parameter> table);

}  // namespace teren
