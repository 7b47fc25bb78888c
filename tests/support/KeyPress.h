// Presses keys in the windows of another program.
#pragma once

#include <string>

namespace teren::test {

/// Sends the press and the release of a key ("F5", as X calls it) to every window that the display shows.
/// Returns how many there are; 0 where the display cannot be opened.
int pressKey(const std::string& display, const std::string& key);

}  // namespace teren::test
