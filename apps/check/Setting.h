// The settings with which a plugin is tried, and how they are told to a person.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "teren/Parameter.h"

namespace teren::check {

/// What is set; parameters that are not named have their defaults.
using Setting = std::vector<Values::Entry>;

/// The defaults, then one parameter at a time: numbers at their least and greatest, every choice, both
/// truths. Texts stay as they are: only their plugin knows which it takes.
std::vector<Setting> settingsOf(std::span<const Parameter> table);

/// "defaults", or "a = 1, b = \"text\"".
std::string textOf(const Setting& setting);

}  // namespace teren::check
